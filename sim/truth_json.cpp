#include "sim/truth_json.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "sim/exposure.hpp"

namespace omma::sim {
namespace {

using Json = nlohmann::ordered_json;

// Digits that no test of accuracy misses, in files a tenth smaller than with all of them.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}
double pixel(double value) {
  return rounded(value, 1e-6);
}
double digits(double value, int count) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", count, value);
  return std::strtod(text, nullptr);
}

Json xyzw(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
Json xyz(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Json pose(const Pose& p) {
  return {{"quaternion_xyzw", xyzw(p.rotation)}, {"translation_m", xyz(p.translation)}};
}

Json spot_json(const Scenario& scenario, std::size_t camera, const SpotTruth& truth) {
  Json spot{{"camera", camera}};
  switch (truth.spot.kind) {
    case SpotKind::kStar:
      spot["kind"] = "star";
      spot["hr"] = truth.spot.hr;
      break;
    case SpotKind::kMoon:
      spot["kind"] = "moon";
      break;
    case SpotKind::kSun:
      spot["kind"] = "sun";
      break;
    case SpotKind::kPlanet:
      spot["kind"] = "planet";
      spot["name"] = std::string(solar_body_name(truth.spot.planet));
      break;
    case SpotKind::kTarget: {
      const TargetBody& body = scenario.cards[truth.spot.card].body;
      spot["kind"] = "target";
      spot["body"] = std::string(body.name.view());
      spot["id"] = std::string(body.targets[truth.spot.target].id.view());
      break;
    }
  }
  spot["u"] = pixel(truth.spot.centre.x());
  spot["v"] = pixel(truth.spot.centre.y());
  spot["flux"] = digits(truth.flux, 7);
  spot["snr"] = digits(truth.snr, 6);
  spot["information"] = {digits(truth.information(0, 0), 9), digits(truth.information(0, 1), 9),
                         digits(truth.information(1, 1), 9)};
  if (truth.saturated) spot["saturated"] = true;
  return spot;
}

Json log_response_json(const LogResponse& r) {
  return {{"millivolts_per_decade", 1e3 * r.volts_per_decade},
          {"dynamic_range_db", r.dynamic_range_db},
          {"full_scale_v", r.full_scale},
          {"analog_gain", r.analog_gain},
          {"blacklevel", r.blacklevel},
          {"blacklevel_dark", r.blacklevel_dark},
          {"blacklevel_step_mv", 1e3 * r.blacklevel_step},
          {"junction_e", r.junction},
          {"fixed_pattern_mv", 1e3 * r.fixed_pattern},
          {"read_noise_mv", 1e3 * r.read_noise}};
}

Json disc_json(const Disc& disc) {
  return {{"direction_j2000", xyz(disc.direction)},
          {"diameter_deg", disc.diameter * 180.0 / std::numbers::pi},
          {"magnitude", disc.magnitude}};
}

Json sensor_json(const Sensor& s) {
  Json json{{"bits", s.bits},
            {"white_level", s.white_level()},
            {"gain_e", s.gain},
            {"black_level", s.black_level},
            {"read_noise_e", s.read_noise},
            {"dark_current_e_s", s.dark_current},
            {"full_well_e", s.full_well},
            {"exposure_s", s.exposure},
            {"zero_point_e_s", s.zero_point},
            {"sky_e_s", s.sky},
            {"psf_sigma_px", s.psf_sigma},
            {"vignetting", s.vignetting},
            {"field_deg", s.field * 180.0 / std::numbers::pi},
            {"hot_pixels", s.hot_pixels},
            {"hot_pixel_current_e_s", s.hot_pixel_current},
            {"blooming", s.blooming},
            {"glare", s.glare},
            {"glare_radius_px", s.glare_radius},
            {"blur_samples", s.blur_samples},
            {"fill_factor", s.fill_factor},
            {"veil", s.veil}};
  if (s.logarithmic) json["logarithmic"] = log_response_json(*s.logarithmic);
  return json;
}

Json card_json(const Card& card, const std::string& target_file) {
  Json targets = Json::array();
  for (const Target& t : card.body.targets) {
    targets.push_back({{"id", std::string(t.id.view())},
                       {"x", t.position.x()},
                       {"y", t.position.y()},
                       {"z", t.position.z()},
                       {"group", t.group},
                       {"type", t.type}});
  }
  Json json{{"name", std::string(card.body.name.view())},
            {"targets_file", target_file},
            {"disc_diameter_m", card.disc_diameter},
            {"faces", Json::array()}};
  for (const Face& face : card.faces)
    json["faces"].push_back(
        {{"plate_m", {face.width, face.height}}, {"body_from_face", pose(face.body_from_face)}});
  if (card.printed) {
    json["plate_albedo"] = card.printed->plate;
    json["disc_albedo"] = card.printed->disc;
    json["ambient_v_arcsec2"] = card.printed->ambient;
  } else {
    json["plate_v_arcsec2"] = card.plate_magnitude;
    json["disc_v_arcsec2"] = card.disc_magnitude;
  }
  if (card.led) json["led"] = {{"v_at_1m", card.led->magnitude}, {"order", card.led->order}};
  json["targets"] = targets;
  return json;
}

/// What the images of one frame set show of a rig that does not turn evenly.
Json exposures(const Scenario& scenario, double time) {
  Json list = Json::array();
  for (std::size_t camera = 0; camera < scenario.rig.cameras.size(); ++camera) {
    const ExposureShift shift = exposure_shift(scenario, camera, time);
    Json bodies = Json::array();
    for (const Vector6d& body : shift.bodies)
      bodies.push_back({{"turn_rad", xyz(body.head<3>())}, {"move_m", xyz(body.tail<3>())}});
    list.push_back({{"turn_rad", xyz(shift.turn)}, {"bodies", bodies}});
  }
  return list;
}

/// Where the rig is and what is about it, in the rig's axes; directions before refraction.
void add_surroundings(const Scenario& scenario, const SceneInstant& scene, double time, Json& line) {
  const SkyScene sky = sky_scene_at(scenario, time);
  const OrbitState observer = observer_at(scenario, time);
  if (!observer.position.isZero(0)) {
    line["position_m"] = xyz(observer.position);
    line["velocity_m_s"] = xyz(observer.velocity);
  }
  if (sky.earth) {
    const double distance = observer.position.norm();
    line["earth"] = {{"direction_rig", xyz(scene.rig_from_j2000 * -observer.position / distance)},
                     {"radius_rad", std::asin(kEarthRadius / distance)}};
  }
  if (scenario.gimbal) {
    const GimbalAngles angles = scenario.gimbal->at(time);
    Json gimbal = Json::array();
    for (std::size_t p = 0; p < scenario.gimbal->parts().size(); ++p) {
      gimbal.push_back({{"axis", std::string(scenario.gimbal->parts()[p].motion.axis.name.view())},
                        {"commanded_rad", angles.commanded[p]},
                        {"real_rad", angles.real[p]},
                        {"tilt_rad", angles.tilt[p]}});
    }
    line["gimbal"] = gimbal;
    line["exposures"] = exposures(scenario, time);
  }
  if (scenario.ground) line["up_rig"] = xyz(scene.up_rig);
  if (sky.sun) line["sun_rig"] = xyz(scene.rig_from_j2000 * sky.sun->direction);
  if (sky.moon) line["moon_rig"] = xyz(scene.rig_from_j2000 * sky.moon->direction);
}

}  // namespace

std::int64_t time_ns_of(const Scenario& scenario, std::uint64_t frame) {
  return std::llround(scenario.time_of(frame) * 1e9);
}

std::string utc_of(const Scenario& scenario, std::uint64_t frame) {
  using std::chrono::days;
  using std::chrono::floor;
  using std::chrono::nanoseconds;
  constexpr double kUnixEpoch = 2440587.5;
  // A Julian date holds 0.04 ms; the epoch is taken to the millisecond, the frames after it exactly.
  const std::chrono::milliseconds start(std::llround((scenario.julian_date_utc - kUnixEpoch) * 86400e3));
  const std::chrono::sys_time<nanoseconds> time{start + nanoseconds(time_ns_of(scenario, frame))};
  const auto day = floor<days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%06dZ", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()),
                static_cast<int>(clock.subseconds().count() / 1000));
  return text;
}

std::string truth_line(const Scenario& scenario, std::uint64_t frame,
                       std::span<const std::vector<SpotTruth>> spots) {
  const SceneInstant scene = scene_at(scenario, scenario.time_of(frame));
  Json line{{"frame", frame},
            {"time_ns", time_ns_of(scenario, frame)},
            {"utc", utc_of(scenario, frame)},
            {"rig_from_j2000", xyzw(scene.rig_from_j2000)},
            {"rate_rig", xyz(scene.rig_rate)}};
  line["bodies"] = Json::array();
  for (std::size_t c = 0; c < scenario.cards.size(); ++c) {
    line["bodies"].push_back({{"name", std::string(scenario.cards[c].body.name.view())},
                              {"rig_from_body", pose(scene.rig_from_body[c])},
                              {"rate_body", xyz(scene.body_rate[c])}});
  }
  add_surroundings(scenario, scene, scenario.time_of(frame), line);
  line["spots"] = Json::array();
  for (std::size_t camera = 0; camera < spots.size(); ++camera) {
    for (const SpotTruth& spot : spots[camera]) line["spots"].push_back(spot_json(scenario, camera, spot));
  }
  return line.dump();
}

std::string scenario_json(const Scenario& scenario, std::span<const std::string> lens_files,
                          std::span<const std::string> target_files) {
  Json rig{{"name", std::string(scenario.rig.name.view())}, {"file", "rig.toml"}, {"cameras", Json::array()}};
  for (std::size_t i = 0; i < scenario.rig.cameras.size(); ++i) {
    const RigCamera& camera = scenario.rig.cameras[i];
    rig["cameras"].push_back({{"name", std::string(camera.name.view())},
                              {"lens_file", lens_files[i]},
                              {"width", camera.lens.width()},
                              {"height", camera.lens.height()},
                              {"rig_from_camera", pose(camera.rig_from_camera)},
                              {"sensor", sensor_json(scenario.sensors[i])}});
  }
  Json json{{"name", scenario.name},
            {"epoch_utc", utc_of(scenario, 0)},
            {"frame_rate_hz", scenario.frame_rate},
            {"frames", scenario.frames},
            {"seed", scenario.seed},
            {"faintest_v", scenario.faintest},
            {"truth_minimum_snr", scenario.truth_minimum_snr},
            {"rig", rig}};
  json["bodies"] = Json::array();
  for (std::size_t c = 0; c < scenario.cards.size(); ++c) {
    json["bodies"].push_back(card_json(scenario.cards[c], target_files[c]));
  }
  if (scenario.moon) json["moon"] = disc_json(*scenario.moon);
  if (scenario.sun) json["sun"] = disc_json(*scenario.sun);
  json["solar_system"] = scenario.solar_system;
  if (scenario.ground) {
    const Ground& ground = *scenario.ground;
    json["ground"] = {{"up_rig", xyz(scene_at(scenario, 0).up_rig)},
                      {"skyline_deg", ground.skyline * 180.0 / std::numbers::pi},
                      {"extinction_mag", ground.extinction},
                      {"refraction", ground.refracts}};
  }
  return json.dump(2) + "\n";
}

}  // namespace omma::sim
