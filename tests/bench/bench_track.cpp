// omma-bench track: the tracker over many frame sets, as it flies: turning at 10 degrees a second and at the
// limit, and ten minutes of the demo's rig with a card, planets and objects that cross. Dots with the noise
// of the demo's sensors (flown_sky.hpp).
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>

#include "components/attitude/attitude.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "components/pose/relative_pose.hpp"
#include "components/surveillance/surveillance.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/flown_sky.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;
constexpr int kWarmUp = 2;  // frame sets until the rate is known

/// What is to be seen, with the demo's rig and the demo's epoch.
struct Stage {
  Observer observer;
  Rig rig = read_rig_file(std::string(OMMA_SOURCE_DIR) + "/config/rigs/dissertation.toml");
  std::vector<TargetBody> bodies{
      read_target_file(std::string(OMMA_SOURCE_DIR) + "/config/targets/docking_card.tsv")};
  std::unique_ptr<StarCatalogue> catalogue;
  SolarSystem places;

  Stage() {
    observer.julian_date_utc = parse_utc("2026-04-02T02:00:00Z");
    double finest = 1;
    for (const RigCamera& camera : rig.cameras) finest = std::min(finest, camera.lens.pixel_angle());
    catalogue = std::make_unique<StarCatalogue>(observer, StarCatalogueParameters{6.5F, 2 * finest});
    places = solar_system(observer, 0);
  }
};

/// The components between dots and telemetry, wired as in the flight program.
class Chain {
 public:
  Chain(const Stage& stage, const TrackerParameters& parameters, std::span<const TargetBody> bodies)
      : tracker_(parameters, stage.rig, *stage.catalogue, bodies),
        attitude_({}),
        pose_({}),
        surveillance_({}, stage.rig, *stage.catalogue, parameters.floor_px) {
    tracker_.dots.bind(dots_);
    tracker_.attitude.bind(attitude_.estimate);
    tracker_.poses.bind(pose_.estimates);
    attitude_.pairings.bind(tracker_.pairings);
    pose_.pairings.bind(tracker_.pairings);
    surveillance_.dots.bind(dots_);
    surveillance_.pairings.bind(tracker_.pairings);
    surveillance_.attitude.bind(attitude_.estimate);
  }
  DotLists& dots() { return *dots_; }
  void step() {
    double tracking = 0;
    double surveillance = 0;
    {
      const RealTimeScope scope;
      tracking = microseconds([&] { tracker_.step(Tick{}); });
      attitude_.step(Tick{});
      pose_.step(Tick{});
      surveillance = microseconds([&] { surveillance_.step(Tick{}); });
    }
    tracking_us.push_back(tracking);
    surveillance_us.push_back(surveillance);
  }
  const Pairings& pairings() const { return *tracker_.pairings; }
  const AttitudeEstimate& attitude() const { return *attitude_.estimate; }
  const PoseEstimates& poses() const { return *pose_.estimates; }
  const UnknownObjects& objects() const { return *surveillance_.objects; }

  std::vector<double> tracking_us, surveillance_us;

 private:
  Out<DotLists> dots_;
  Tracker tracker_;
  Attitude attitude_;
  RelativePose pose_;
  Surveillance surveillance_;
};

/// What the truth says of the pairs of one frame set.
struct Verdict {
  int pairs = 0, wrong = 0, wrong_used = 0;

  void judge(const FlownSky& sky, const Pairing& pair, LightName name, bool used) {
    ++pairs;
    for (const LightName& true_name : sky.names(pair.camera, pair.dot))
      if (true_name == name) return;
    ++wrong;
    wrong_used += used ? 1 : 0;
  }
  void judge_stars(const FlownSky& sky, const Chain& chain) {
    const SkyPairings& found = chain.pairings().sky;
    for (std::size_t i = 0; i < found.pairs.size(); ++i) {
      const bool used = i < chain.attitude().used.size() && chain.attitude().used[i] != 0;
      judge(sky, found.pairs[i], {Light::kStar, found.pairs[i].entry}, used);
    }
  }
};

struct TurnResult {
  int frames = 0, tracked = 0, lost = 0;
  double stars = 0, dots = 0, squared_error = 0;
  Verdict stars_verdict;
  double microseconds = 0;
  bool holds() const { return frames > 0 && tracked == frames; }
};

TurnResult turn(const Stage& stage, FlownSkyOptions options, int frames) {
  TrackerParameters parameters;
  parameters.floor_px = 0.02;
  parameters.faintest_star = 5.5F;
  const auto chain = std::make_unique<Chain>(stage, parameters, std::span<const TargetBody>{});
  FlownSky sky(stage.rig, stage.catalogue->stars(), stage.places, stage.bodies[0], options);
  TurnResult result;
  for (int i = 0; i < frames + kWarmUp; ++i) {
    sky.next(chain->dots());
    chain->step();
    if (i < kWarmUp) continue;
    ++result.frames;
    const SkyPairings& found = chain->pairings().sky;
    result.tracked += found.state == TrackState::kTracking ? 1 : 0;
    result.lost += found.state == TrackState::kLost ? 1 : 0;
    result.stars += static_cast<double>(found.pairs.size()) / frames;
    result.dots += static_cast<double>(sky.stars_seen()) / frames;
    result.stars_verdict.judge_stars(sky, *chain);
    if (chain->attitude().valid) {
      const Eigen::Quaterniond& estimate = chain->attitude().solution.rig_from_j2000;
      result.squared_error +=
          rotation_log(sky.rig_from_j2000() * estimate.conjugate()).squaredNorm() / frames;
    }
  }
  result.microseconds = quantile(chain->tracking_us, 0.5);
  return result;
}

void print_turn(const char* name, const TurnResult& r) {
  std::printf("  %-28s %5.1f %%  %4d  %6.0f %6.0f  %9d %9d  %8.1f\"  %7.0f\n", name,
              100.0 * r.tracked / r.frames, r.lost, r.dots, r.stars, r.stars_verdict.wrong,
              r.stars_verdict.wrong_used, std::sqrt(r.squared_error) / kArcsecond, r.microseconds);
  std::fflush(stdout);
}

FlownSkyOptions at_rate(double degrees_per_second, double exposure) {
  FlownSkyOptions options;
  options.frame_rate = 20;
  options.exposure = exposure;
  options.rate = degrees_per_second * kDegree * Eigen::Vector3d(0.6, -0.5, 0.62).normalized();
  return options;
}

void bench_rates(const Stage& stage, double exposure, int frames) {
  std::printf("\nTurning evenly, 20 Hz, exposure %.0f ms, %d frame sets each\n", 1e3 * exposure, frames);
  std::printf(
      "  rate                       tracked  lost  dots of / paired    wrong  and used   attitude  "
      "us/step\n");
  std::printf(
      "                                            stars                                 error rms\n");
  double limit = 0;
  for (const double rate : {0.03, 1.0, 10.0, 20.0, 40.0, 80.0, 120.0, 160.0}) {
    const TurnResult result = turn(stage, at_rate(rate, exposure), frames);
    std::array<char, 64> name{};
    std::snprintf(name.data(), name.size(), "%6.2f deg/s", rate);
    print_turn(name.data(), result);
    if (result.holds()) limit = rate;
  }
  double above = 2 * limit;
  for (int i = 0; i < 4; ++i) {
    const double middle = 0.5 * (limit + above);
    (turn(stage, at_rate(middle, exposure), frames).holds() ? limit : above) = middle;
  }
  std::printf(
      "  the limit: %.0f deg/s (every frame set tracked; lost at %.0f). The dissertation: 0.03 deg/s\n",
      limit, above);
}

void bench_accelerations(const Stage& stage, int frames) {
  std::printf(
      "\n10 deg/s, 20 Hz, exposure 10 ms, the axis swinging: angular acceleration (unmodelled: 1.1 "
      "deg/s2)\n");
  for (const double acceleration : {1.0, 5.0, 20.0, 50.0, 100.0}) {
    FlownSkyOptions options = at_rate(10, 0.01);
    options.nutation_angle = 0.3;
    options.nutation_rate = acceleration / (10 * std::sin(0.3));
    std::array<char, 64> name{};
    std::snprintf(name.data(), name.size(), "%6.1f deg/s2", acceleration);
    print_turn(name.data(), turn(stage, options, frames));
  }
}

/// Which true light each object of ours was, from frame set to frame set.
struct ObjectIdentities {
  std::map<std::uint32_t, std::uint16_t> light_of;
  std::map<std::uint16_t, std::uint32_t> newest_number;
  int switches = 0, false_objects = 0, renumbered = 0;
  int seen = 0;

  void judge(const FlownSky& sky, const UnknownObjects& objects) {
    for (const UnknownObject& object : objects.objects) {
      if (!object.bearing.seen || object.motion != ObjectMotion::kMoving) continue;
      const LightName* light = nullptr;
      for (std::size_t c = 0; c < object.bearing.dot.size() && light == nullptr; ++c) {
        if (object.bearing.dot[c] < 0) continue;
        for (const LightName& name : sky.names(c, static_cast<std::size_t>(object.bearing.dot[c])))
          if (name.kind == Light::kObject) light = light == nullptr ? &name : light;
      }
      const auto known = light_of.find(object.number);
      if (light == nullptr) {
        false_objects += known == light_of.end() ? 1 : 0;
        continue;
      }
      ++seen;
      if (known == light_of.end()) {
        renumbered += newest_number.contains(light->entry) ? 1 : 0;
        light_of[object.number] = light->entry;
        newest_number[light->entry] = object.number;
      } else if (known->second != light->entry) {
        ++switches;
        known->second = light->entry;
      }
    }
  }
};

int bench_long_flight(const Stage& stage, int minutes) {
  TrackerParameters parameters;
  parameters.floor_px = 0.02;
  parameters.observer = stage.observer;
  parameters.observer_sigma = 0;
  FlownSkyOptions options;
  options.rate = kDegree * Eigen::Vector3d(0.9, -1.0, 0.7);
  options.card = options.planets = true;
  options.objects = 24;
  options.hot_pixels = 4;
  options.false_dots = 3;
  const auto chain = std::make_unique<Chain>(stage, parameters, stage.bodies);
  FlownSky sky(stage.rig, stage.catalogue->stars(), stage.places, stage.bodies[0], options);
  Verdict stars, targets, solar;
  ObjectIdentities objects;
  std::array<int, kSolarBodies> named{}, to_name{};
  int sky_tracked = 0, card_tracked = 0, hot_pixels = 0;
  const int frames = minutes * 600;
  const memory_guard::Violations before = memory_guard::violations();
  for (int i = 0; i < frames; ++i) {
    sky.next(chain->dots());
    chain->step();
    const Pairings& found = chain->pairings();
    sky_tracked += found.sky.state == TrackState::kTracking ? 1 : 0;
    card_tracked += found.bodies[0].state == TrackState::kTracking ? 1 : 0;
    stars.judge_stars(sky, *chain);
    for (std::size_t k = 0; k < found.bodies[0].pairs.size(); ++k)
      targets.judge(sky, found.bodies[0].pairs[k], {Light::kTarget, found.bodies[0].pairs[k].entry}, true);
    for (const Pairing& pair : found.sky.solar) {
      solar.judge(sky, pair, {Light::kSolar, pair.entry}, true);
      ++named[pair.entry];
    }
    for (std::size_t c = 0; c < chain->dots().cameras.size(); ++c)
      for (std::size_t d = 0; d < chain->dots().cameras[c].dots.size(); ++d)
        if (sky.names(c, d)[0].kind == Light::kSolar) ++to_name[sky.names(c, d)[0].entry];
    objects.judge(sky, chain->objects());
    for (const UnknownObject& object : chain->objects().objects)
      hot_pixels += object.motion == ObjectMotion::kWithTheRig ? 1 : 0;
  }
  const std::uint64_t touched = memory_guard::violations().total() - before.total();
  std::printf(
      "\n%d min of the demo's rig at 10 Hz, 1.5 deg/s: %d frame sets; card, planets, %d objects crossing, "
      "hot "
      "pixels, false dots\n",
      minutes, frames, options.objects);
  std::printf("  tracked in %.2f %% (sky), %.2f %% (card) of the frame sets\n", 100.0 * sky_tracked / frames,
              100.0 * card_tracked / frames);
  std::printf("  star pairs   %9d   wrong %d, and used in the attitude %d\n", stars.pairs, stars.wrong,
              stars.wrong_used);
  std::printf("  target pairs %9d   wrong %d\n", targets.pairs, targets.wrong);
  std::printf("  planet pairs %9d   wrong %d; named of the dots they made:", solar.pairs, solar.wrong);
  for (std::size_t b = 0; b < kSolarBodies; ++b) {
    if (to_name[b] > 0)
      std::printf(" %s %.1f %%", std::string(solar_body_name(static_cast<std::uint16_t>(b))).c_str(),
                  100.0 * named[b] / to_name[b]);
  }
  std::printf(
      "\n  objects      %9d sightings of moving ones, %d of none, identity switches %d, given another number "
      "after a gap %d; hot pixels told as such in %.1f a frame set\n",
      objects.seen, objects.false_objects, objects.switches, objects.renumbered,
      static_cast<double>(hot_pixels) / frames);
  std::printf(
      "  tracker med %.0f us, p99 %.0f; surveillance med %.0f us, p99 %.0f; memory touched in steps: "
      "%llu%s\n",
      quantile(chain->tracking_us, 0.5), quantile(chain->tracking_us, 0.99),
      quantile(chain->surveillance_us, 0.5), quantile(chain->surveillance_us, 0.99),
      static_cast<unsigned long long>(touched), memory_guard::installed() ? "" : " (not watched)");
  return stars.wrong_used + targets.wrong + solar.wrong + objects.switches;
}

}  // namespace

int bench_track(Options& options) {
  int minutes = 10;
  int frames = 100;
  options.add("--minutes", minutes, "of the long flight");
  options.add("--frames", frames, "frame sets at each rate", 10);
  options.read();
  const Stage stage;
  bench_rates(stage, 0.01, frames);
  bench_rates(stage, 0.05, frames);
  bench_accelerations(stage, frames);
  return bench_long_flight(stage, minutes) > 0 ? 1 : 0;
}

}  // namespace omma
