// What the dynamic-range experiment measures: stars found in a sequence, and what a lamp leaves of a card.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "components/extractor/classical/pipelines.hpp"
#include "components/extractor/dot_extractor.hpp"
#include "ground/experiment/dynamic_range.hpp"
#include "hal/recorded/image_file.hpp"
#include "sim/camera_renderer.hpp"

namespace omma::ground {
namespace {

constexpr double kGate = 1.5;            // a dot this near is the star's [px]
constexpr std::size_t kPersistence = 3;  // frames at one place, as the dissertation's tracker asks
constexpr double kBlend = 4;             // a brighter star within this hides it [px]
constexpr double kPedestal = 4096;  // added before grey levels less the black frame are made whole numbers
constexpr std::array<std::array<double, 2>, 4> kEmpty{{{7, 3}, {-3, 7}, {-7, -3}, {3, -7}}};  // [px]

using Places = std::vector<Eigen::Vector2d>;

bool holds(const Places& dots, const Eigen::Vector2d& place) {
  return std::any_of(dots.begin(), dots.end(),
                     [&](const Eigen::Vector2d& dot) { return (dot - place).norm() < kGate; });
}

// In at least so many of the frames.
bool seen(const std::vector<Places>& frames, const Eigen::Vector2d& place, std::size_t least) {
  const auto count =
      std::count_if(frames.begin(), frames.end(), [&](const Places& dots) { return holds(dots, place); });
  return count >= static_cast<std::ptrdiff_t>(least);
}

double dividing_magnitude(std::vector<std::pair<float, bool>> stars) {
  std::sort(stars.begin(), stars.end());
  long missed = 0;  // brighter than the divide
  long best = std::count_if(stars.begin(), stars.end(), [](const auto& s) { return s.second; });
  long found_beyond = best;
  double divide = stars.empty() ? 0 : stars.front().first;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    (stars[i].second ? found_beyond : missed) += stars[i].second ? -1 : 1;
    if (missed + found_beyond >= best) continue;
    best = missed + found_beyond;
    divide = i + 1 < stars.size() ? 0.5 * (stars[i].first + stars[i + 1].first) : stars[i].first;
  }
  return divide;
}

Limit limit_of(const std::string& name, const std::vector<Places>& frames, std::size_t least,
               const std::vector<WantedStar>& wanted) {
  Limit limit{name, -std::numeric_limits<double>::infinity(), 0, 0, 0};
  std::vector<std::pair<float, bool>> stars;
  int by_chance = 0;
  for (const WantedStar& star : wanted) {
    const bool found = seen(frames, star.pixel, least);
    stars.emplace_back(star.magnitude, found);
    for (const auto& off : kEmpty)
      by_chance += seen(frames, star.pixel + Eigen::Vector2d(off[0], off[1]), least) ? 1 : 0;
    if (!found) continue;
    ++limit.found;
    limit.dimmest = std::max<double>(limit.dimmest, star.magnitude);
  }
  limit.chance = wanted.empty() ? 0 : by_chance / (4.0 * double(wanted.size()));
  limit.half = dividing_magnitude(std::move(stars));
  return limit;
}

Image whole_levels(const GreyImage& grey, double white) {
  Image image;
  image.resize(grey.width, grey.height, PixelFormat::kGrey16);
  image.white_level = static_cast<std::uint16_t>(std::min(65535.0, white + kPedestal));
  auto* out = reinterpret_cast<std::uint16_t*>(image.pixels.data());
  for (std::size_t i = 0; i < grey.value.size(); ++i)
    out[i] = static_cast<std::uint16_t>(
        std::clamp<double>(std::lround(grey.value[i] + kPedestal), 0, image.white_level));
  return image;
}

Places own_dots(const GreyImage& grey, double white) {
  const Image image = whole_levels(grey, white);
  DotExtractor extractor(grey.width, grey.height);
  ExtractorParameters parameters;
  parameters.black_level = kPedestal;
  DotList list;
  extractor.extract(image.view(), parameters, list);
  Places places;
  for (const Dot& dot : list.dots) places.push_back(dot.pixel);
  return places;
}

Places classical_dots(const GreyImage& image) {
  ClassicalPipelines pipelines(image.width, image.height, {});
  pipelines.original() = image;
  Places places;
  for (const ClassicalDot& dot : pipelines.run(ClassicalAlgorithm::kStars)) places.push_back(dot.pixel);
  return places;
}

GreyImage less(const GreyImage& image, const GreyImage& black) {
  GreyImage out = image;
  for (std::size_t i = 0; i < black.value.size(); ++i) out.value[i] -= black.value[i];
  return out;
}

template <class Fold>
GreyImage folded(const std::vector<GreyImage>& images, Fold&& fold) {
  GreyImage out = images.front();
  for (std::size_t k = 1; k < images.size(); ++k) {
    for (std::size_t i = 0; i < out.value.size(); ++i) out.value[i] = fold(out.value[i], images[k].value[i]);
  }
  return out;
}

void judge_background(const Sequence& sequence, const std::vector<WantedStar>& wanted,
                      SequenceResult& result) {
  const GreyImage& image = sequence.images.front();
  const auto white = std::count_if(image.value.begin(), image.value.end(),
                                   [&](float level) { return level >= sequence.white_level; });
  result.saturated = double(white) / double(image.value.size());
  for (const WantedStar& star : wanted) {
    const auto u = static_cast<int>(std::lround(star.pixel.x())) + 5;
    const auto v = static_cast<int>(std::lround(star.pixel.y()));
    result.background += image.at(std::clamp(u, 0, image.width - 1), std::clamp(v, 0, image.height - 1)) /
                         double(wanted.size());
  }
}

}  // namespace

std::vector<WantedStar> wanted_stars(std::span<const SkyStar> stars, const Lens& lens,
                                     const Eigen::Matrix3d& camera_from_j2000, double field,
                                     const Eigen::Vector3d& centre, double radius) {
  std::vector<WantedStar> wanted;
  std::vector<Eigen::Vector2d> brighter;
  for (const SkyStar& star : stars) {  // brightest first
    const Eigen::Vector3d direction = camera_from_j2000 * star.direction;
    Eigen::Vector2d pixel;
    if (direction.z() < std::cos(0.5 * field) || !lens.project(direction, pixel)) continue;
    const bool alone = std::none_of(brighter.begin(), brighter.end(), [&](const Eigen::Vector2d& other) {
      return (other - pixel).norm() < kBlend;
    });
    brighter.push_back(pixel);
    const bool inside =
        pixel.x() > 8 && pixel.y() > 8 && pixel.x() < lens.width() - 9 && pixel.y() < lens.height() - 9;
    if (alone && inside && star.direction.dot(centre) > std::cos(radius))
      wanted.push_back({star.hr, star.magnitude, pixel});
  }
  return wanted;
}

SequenceResult judge(const Sequence& sequence, const std::vector<WantedStar>& wanted) {
  SequenceResult result;
  result.stars = static_cast<int>(wanted.size());
  judge_background(sequence, wanted, result);
  std::vector<GreyImage> clean;
  std::vector<Places> classical;
  std::vector<Places> own;
  for (const GreyImage& image : sequence.images) {
    clean.push_back(less(image, sequence.black_frame));
    classical.push_back(classical_dots(clean.back()));
    own.push_back(own_dots(clean.back(), sequence.white_level));
  }
  const auto count = static_cast<float>(clean.size());
  result.average = folded(clean, [](float a, float b) { return a + b; });
  for (float& level : result.average.value) level /= count;
  result.darken = folded(clean, [](float a, float b) { return std::min(a, b); });
  const std::size_t all = own.size();
  const std::size_t persistent = std::min(kPersistence, all);
  result.limits = {limit_of("dissertation's extraction, persistent", classical, persistent, wanted),
                   limit_of("dissertation's extraction, in all frames", classical, all, wanted),
                   limit_of("flight extractor, first frame alone", {own.front()}, 1, wanted),
                   limit_of("flight extractor, persistent", own, persistent, wanted),
                   limit_of("flight extractor, average of the frames",
                            {own_dots(result.average, sequence.white_level)}, 1, wanted)};
  return result;
}

std::vector<TransitPoint> lamp_transit(const sim::Scenario& scenario, const std::vector<double>& angles) {
  std::vector<TransitPoint> points;
  const sim::Sensor& sensor = scenario.sensors[0];
  const sim::CameraView view(scenario.rig.cameras[0], sensor, scenario.seed, 0);
  const sim::LogPixel pixel = sensor.log_pixel();
  const sim::LogResponse& response = *sensor.logarithmic;
  const Eigen::Quaterniond j2000_from_rig = sim::scene_at(scenario, 0).rig_from_j2000.conjugate();
  for (const double angle : angles) {
    sim::Scenario moved = scenario;
    // The lamp goes to −x, the card stays 60 degrees behind it.
    moved.sun =
        sim::Disc{j2000_from_rig * Eigen::Vector3d(-std::sin(angle), 0, std::cos(angle)), 0.0093, -26.74};
    const double card_angle = angle - M_PI / 3;
    const Pose turn{Eigen::Quaterniond(Eigen::AngleAxisd(-card_angle, Eigen::Vector3d::UnitY())),
                    Eigen::Vector3d::Zero()};
    sim::Card& card = moved.cards.front();
    card.inertial = false;
    card.motion = sim::Motion::constant(turn * scenario.cards.front().motion.at(0), Eigen::Vector3d::Zero(),
                                        Eigen::Vector3d::Zero());
    sim::CameraRenderer renderer(moved, {}, view, 0);
    renderer.draw(0);
    const auto electrons_at = [&](const Eigen::Vector3d& on_card) {
      Eigen::Vector2d place = Eigen::Vector2d::Zero();
      view.camera().lens.project(card.motion.at(0) * on_card, place);
      const auto u = static_cast<std::size_t>(std::clamp(std::lround(place.x()), 0L, long{view.width()} - 1));
      const auto v =
          static_cast<std::size_t>(std::clamp(std::lround(place.y()), 0L, long{view.height()} - 1));
      return double(renderer.mean_electrons()[v * static_cast<std::size_t>(view.width()) + u]);
    };
    double brightest = 0;
    double contrast = 0;
    double plate = 0;
    for (const Target& target : card.body.targets) {
      const double disc = electrons_at(target.position);
      plate = electrons_at(target.position + Eigen::Vector3d(0.02, 0.02, 0));
      brightest = std::max({brightest, disc, plate});
      contrast +=
          (pixel.level(disc) - pixel.level(plate)) / pixel.noise(plate) / double(card.body.targets.size());
    }
    const double dark = sensor.dark_current * sensor.exposure;
    const double room =
        response.full_scale / response.analog_gain - response.volts_per_decade * std::log10(brightest / dark);
    points.push_back(
        {angle, response.blacklevel_dark + room / response.blacklevel_step, plate / dark, contrast});
  }
  return points;
}

}  // namespace omma::ground
