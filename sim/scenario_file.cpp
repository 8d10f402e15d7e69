#include "sim/scenario_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "components/catalogue/observer.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kQuaternionTolerance = 1e-3;

Eigen::Vector3d vector_of(const TomlTable& table, std::string_view key) {
  const auto v = table.numbers(key, 3);
  return {v[0], v[1], v[2]};
}

Eigen::Quaterniond quaternion_of(const TomlTable& table, std::string_view key) {
  const auto q = table.numbers(key, 4);
  Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (!(std::abs(rotation.norm() - 1) <= kQuaternionTolerance)) {
    throw table.error(key, "a quaternion of length 1", "length " + std::to_string(rotation.norm()));
  }
  rotation.normalize();
  return rotation;
}

// A key's time, after the one before it.
double key_time(const TomlTable& key, const std::vector<PoseKey>& before) {
  const double time = key.number("time_s");
  if (!before.empty() && time <= before.back().time) {
    throw key.error("time_s", "a time after the key before, " + std::to_string(before.back().time) + " s",
                    std::to_string(time) + " s");
  }
  return time;
}

Motion rig_motion_of(const TomlTable& table) {
  const auto keys = table.tables_if("key");
  if (keys.empty()) {
    const Pose start{quaternion_of(table, "rig_from_j2000").conjugate(), Eigen::Vector3d::Zero()};
    const Eigen::Vector3d rate = kDegree * vector_of(table, "rate_deg_s");
    table.refuse_unknown_keys();
    return Motion::constant(start, Eigen::Vector3d::Zero(), rate);
  }
  table.refuse_unknown_keys();
  std::vector<PoseKey> poses;
  for (const TomlTable& key : keys) {
    const double time = key_time(key, poses);
    poses.push_back({time, {quaternion_of(key, "rig_from_j2000").conjugate(), Eigen::Vector3d::Zero()}});
    key.refuse_unknown_keys();
  }
  return Motion::through(std::move(poses));
}

Motion card_motion_of(const TomlTable& table) {
  const auto keys = table.tables_if("key");
  if (keys.empty()) {
    const Pose start{quaternion_of(table, "quaternion_xyzw"), vector_of(table, "position_m")};
    return Motion::constant(start, vector_of(table, "velocity_m_s"),
                            kDegree * vector_of(table, "rate_deg_s"));
  }
  std::vector<PoseKey> poses;
  for (const TomlTable& key : keys) {
    const double time = key_time(key, poses);
    poses.push_back({time, {quaternion_of(key, "quaternion_xyzw"), vector_of(key, "position_m")}});
    key.refuse_unknown_keys();
  }
  return Motion::through(std::move(poses));
}

// Discs must differ from the plate the way their type says.
void check_contrast(const TomlTable& table, const Card& card) {
  for (const Target& target : card.body.targets) {
    const bool brighter = card.disc_magnitude < card.plate_magnitude;
    const bool light = target.type == 1;
    if (brighter != light) {
      throw table.error("disc_v_arcsec2",
                        light ? "discs brighter than the plate (a smaller magnitude): target " +
                                    std::string(target.id.view()) + " is of type 1"
                              : "discs darker than the plate (a larger magnitude): target " +
                                    std::string(target.id.view()) + " is of type 0",
                        std::to_string(card.disc_magnitude) + " on " + std::to_string(card.plate_magnitude));
    }
  }
}

Card card_of(const TomlTable& table) {
  Card card;
  const std::string name = table.text("name");
  if (name.empty() || name.size() > limits::kNameLength) {
    throw table.error("name", "1 to " + std::to_string(limits::kNameLength) + " characters",
                      '"' + name + '"');
  }
  card.target_file = table.path("targets");
  const std::string frame = table.text("frame");
  if (frame != "rig" && frame != "j2000")
    throw table.error("frame", "\"rig\" or \"j2000\"", '"' + frame + '"');
  card.inertial = frame == "j2000";
  const auto plate = table.numbers("plate_m", 2);
  if (!(plate[0] > 0 && plate[1] > 0)) throw table.error("plate_m", "two lengths above 0", "one that is not");
  card.width = plate[0];
  card.height = plate[1];
  card.plate_magnitude = table.number("plate_v_arcsec2", {-20, 60});
  card.disc_magnitude = table.number("disc_v_arcsec2", {-20, 60});
  card.disc_diameter = table.number("disc_diameter_m", {1e-6, 100});
  card.motion = card_motion_of(table);
  table.refuse_unknown_keys();
  card.body = read_target_file(card.target_file);
  card.body.name = Name(name);
  check_contrast(table, card);
  return card;
}

std::vector<Card> cards_of(const TomlTable& root) {
  std::vector<Card> cards;
  for (const TomlTable& table : root.tables_if("card")) {
    if (cards.size() == static_cast<std::size_t>(limits::kTargetBodies)) {
      throw table.error("name",
                        "at most " + std::to_string(limits::kTargetBodies) + " cards (limits::kTargetBodies)",
                        "another one");
    }
    Card card = card_of(table);
    for (const Card& other : cards) {
      if (other.body.name == card.body.name) {
        throw table.error("name", "a name no other card has", '"' + table.text("name") + "\" again");
      }
    }
    cards.push_back(std::move(card));
  }
  return cards;
}

LogResponse log_response_of(const TomlTable& table) {
  LogResponse r;
  r.volts_per_decade = 1e-3 * table.number("millivolts_per_decade", {1, 1000}, 1e3 * r.volts_per_decade);
  r.dynamic_range_db = table.number("dynamic_range_db", {20, 240}, r.dynamic_range_db);
  r.full_scale = table.number("full_scale_v", {0.01, 20}, r.full_scale);
  r.analog_gain = table.number("analog_gain", {0.1, 1000}, r.analog_gain);
  r.blacklevel = table.number("blacklevel", {-1000, 1000}, r.blacklevel);
  r.blacklevel_dark = table.number("blacklevel_dark", {-1000, 1000}, r.blacklevel_dark);
  r.blacklevel_step = 1e-3 * table.number("blacklevel_step_mv", {0, 1000}, 1e3 * r.blacklevel_step);
  r.junction = table.number("junction_e", {10, 1e9}, r.junction);
  r.fixed_pattern = 1e-3 * table.number("fixed_pattern_mv", {0, 1000}, 1e3 * r.fixed_pattern);
  r.read_noise = 1e-3 * table.number("read_noise_mv", {0, 1000}, 1e3 * r.read_noise);
  table.refuse_unknown_keys();
  return r;
}

void read_stray_light(const TomlTable& table, Sensor& sensor) {
  sensor.veil = table.number("veil", {0, 1}, 0);
  sensor.veil_width = kDegree * table.number("veil_width_deg", {0.1, 180}, 23);
  sensor.veil_reach = kDegree * table.number("veil_reach_deg", {0, 180}, 92);
  for (const TomlTable& ghost : table.tables_if("ghost")) {
    sensor.ghosts.push_back({ghost.number("place", {-5, 5}), ghost.number("radius_px", {0.5, 1e4}),
                             ghost.number("share", {0, 1})});
    ghost.refuse_unknown_keys();
  }
}

// What only a linear sensor has.
void read_linear(const TomlTable& table, Sensor& sensor) {
  sensor.gain = table.number("gain_e", {1e-3, 1e6});
  sensor.black_level = table.number("black_level", {0, 65535});
  sensor.read_noise = table.number("read_noise_e", {0.5, 1e4});
  sensor.full_well = table.number("full_well_e", {1, 1e9});
  sensor.blooming = table.number("blooming", {0, 1}, 0);
  if (sensor.black_level >= sensor.white_level()) {
    throw table.error("black_level", "a grey level below white, " + std::to_string(sensor.white_level()),
                      std::to_string(sensor.black_level));
  }
}

Sensor sensor_of(const TomlTable& table) {
  Sensor sensor;
  sensor.bits = static_cast<int>(table.integer("bits", {8, 16}));
  sensor.dark_current = table.number("dark_current_e_s", {0, 1e9});
  sensor.exposure = table.number("exposure_s", {1e-9, 1e4});
  sensor.zero_point = table.number("zero_point_e_s", {1e-6, 1e15});
  sensor.sky = table.number("sky_e_s", {0, 1e9});
  sensor.psf_sigma = table.number("psf_sigma_px", {0.2, 5});
  sensor.vignetting = table.number("vignetting", {0, 1});
  sensor.field = kDegree * table.number("field_deg", {0.01, 360});
  sensor.hot_pixels = table.number("hot_pixels", {0, 1}, 0);
  sensor.hot_pixel_current = table.number("hot_pixel_current_e_s", {0, 1e9}, 0);
  sensor.glare = table.number("glare", {0, 1}, 0);
  sensor.glare_radius = table.number("glare_radius_px", {0.1, 1e4}, 10);
  sensor.blur_samples = static_cast<int>(table.integer("blur_samples", {1, 256}, 1));
  sensor.fill_factor = table.number("fill_factor", {0.01, 1}, 1);
  read_stray_light(table, sensor);
  if (const auto logarithmic = table.table_if("logarithmic")) {
    sensor.logarithmic = log_response_of(*logarithmic);
    if (!(sensor.dark_current > 0))
      throw table.error("dark_current_e_s", "above 0: a logarithmic pixel's signal is light over it", "0");
  } else {
    read_linear(table, sensor);
  }
  table.refuse_unknown_keys();
  return sensor;
}

void read_sensors(const TomlTable& root, Scenario& scenario) {
  std::array<bool, limits::kCameras> known{};
  for (const TomlTable& table : root.tables("sensor")) {
    const std::string name = table.text("camera");
    const auto& cameras = scenario.rig.cameras;
    const auto* camera = std::find_if(cameras.begin(), cameras.end(),
                                      [&](const RigCamera& c) { return c.name.view() == name; });
    if (camera == cameras.end()) {
      throw table.error("camera", "a camera of the rig \"" + std::string(scenario.rig.name.view()) + '"',
                        '"' + name + '"');
    }
    const auto index = static_cast<std::size_t>(camera - cameras.begin());
    if (known[index]) throw table.error("camera", "one sensor a camera", '"' + name + "\" again");
    known[index] = true;
    scenario.sensors[index] = sensor_of(table);
  }
  for (std::size_t i = 0; i < scenario.rig.cameras.size(); ++i) {
    if (!known[i]) {
      throw root.error("sensor", "a sensor for every camera of the rig",
                       "none for \"" + std::string(scenario.rig.cameras[i].name.view()) + '"');
    }
  }
}

Disc disc_of(const TomlTable& table, double diameter_deg, double magnitude) {
  Disc disc;
  const double ra = kDegree * table.number("ra_deg", {-360, 360});
  const double dec = kDegree * table.number("dec_deg", {-90, 90});
  disc.direction = {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
  disc.diameter = kDegree * table.number("diameter_deg", {1e-4, 10}, diameter_deg);
  disc.magnitude = table.number("magnitude", {-30, 10}, magnitude);
  table.refuse_unknown_keys();
  return disc;
}

void read_sun_and_moon(const TomlTable& root, Scenario& scenario) {
  if (const auto sun = root.table_if("sun")) scenario.sun = disc_of(*sun, 0.533, -26.74);
  const auto moon = root.table_if("moon");
  if (!moon) return;
  scenario.moon = disc_of(*moon, 0.52, -12.7);
  if (scenario.sun && !moon->has("magnitude"))
    scenario.moon->magnitude = moon_magnitude(phase_angle(scenario.moon->direction, scenario.sun->direction));
}

Ground ground_of(const TomlTable& table) {
  Ground ground;
  ground.up = vector_of(table, "up_rig");
  if (!(std::abs(ground.up.norm() - 1) <= 1e-3)) {
    throw table.error("up_rig", "a vector of length 1", "length " + std::to_string(ground.up.norm()));
  }
  ground.up.normalize();
  ground.skyline = kDegree * table.number("skyline_deg", {-5, 89}, 0);
  ground.extinction = table.number("extinction_mag", {0, 5}, 0);
  table.refuse_unknown_keys();
  return ground;
}

double epoch_of(const TomlTable& root) {
  try {
    return parse_utc(root.text("epoch_utc"));
  } catch (const InputError&) {
    const std::string found = '"' + root.text("epoch_utc") + '"';
    throw root.error("epoch_utc", "a UTC time such as \"2026-03-21T06:00:00Z\"", found);
  }
}

}  // namespace

Scenario read_scenario_file(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::read(file);
  Scenario scenario;
  scenario.file = file;
  scenario.name = root.text("name");
  scenario.rig_file = root.path("rig");
  scenario.epoch_utc = root.text("epoch_utc");
  scenario.julian_date_utc = epoch_of(root);
  scenario.frame_rate = root.number("frame_rate_hz", {1e-6, 1e4});
  scenario.frames = static_cast<int>(root.integer("frames", {1, 1'000'000}));
  scenario.seed = static_cast<std::uint64_t>(root.integer("seed", {0, 9e15}, 1));
  scenario.faintest = root.number("faintest_v", {-2, 10}, 6.5);
  scenario.truth_minimum_snr = root.number("truth_minimum_snr", {0, 1e6}, 3);
  const TomlTable trajectory = root.table("trajectory");
  scenario.rig_motion = rig_motion_of(trajectory);
  scenario.rig = read_rig_file(scenario.rig_file);
  read_sensors(root, scenario);
  scenario.cards = cards_of(root);
  read_sun_and_moon(root, scenario);
  if (const auto ground = root.table_if("ground")) scenario.ground = ground_of(*ground);
  root.refuse_unknown_keys();
  return scenario;
}

}  // namespace omma::sim
