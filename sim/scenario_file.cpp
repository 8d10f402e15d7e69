#include "sim/scenario_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "components/catalogue/observer.hpp"
#include "components/geometry/rig_file.hpp"
#include "sim/scenario_tables.hpp"

namespace omma::sim {
namespace {

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
  const double ra = kRadiansPerDegree * table.number("ra_deg", {-360, 360});
  const double dec = kRadiansPerDegree * table.number("dec_deg", {-90, 90});
  disc.direction = {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
  disc.diameter = kRadiansPerDegree * table.number("diameter_deg", {1e-4, 10}, diameter_deg);
  disc.magnitude = table.number("magnitude", {-30, 10}, magnitude);
  table.refuse_unknown_keys();
  return disc;
}

void read_sun_and_moon(const TomlTable& root, Scenario& scenario) {
  scenario.solar_system = root.flag("solar_system", scenario.orbit.has_value());
  for (const char* told : {"sun", "moon"}) {
    if (scenario.solar_system && root.has(told))
      throw root.error(told, "solar_system = false, for a body at a place of its own", "solar_system = true");
  }
  if (const auto sun = root.table_if("sun")) scenario.sun = disc_of(*sun, 0.533, -26.74);
  const auto moon = root.table_if("moon");
  if (!moon) return;
  scenario.moon = disc_of(*moon, 0.52, -12.7);
  if (scenario.sun && !moon->has("magnitude"))
    scenario.moon->magnitude = moon_magnitude(phase_angle(scenario.moon->direction, scenario.sun->direction));
}

double epoch_of(const TomlTable& root) {
  try {
    return parse_utc(root.text("epoch_utc"));
  } catch (const InputError&) {
    const std::string found = '"' + root.text("epoch_utc") + '"';
    throw root.error("epoch_utc", "a UTC time such as \"2026-03-21T06:00:00Z\"", found);
  }
}

// A rig is in orbit or on the ground, not both.
void read_surroundings(const TomlTable& root, Scenario& scenario) {
  if (const auto ground = root.table_if("ground")) scenario.ground = ground_of(*ground);
  if (const auto orbit = root.table_if("orbit")) {
    if (scenario.ground) throw root.error("orbit", "[orbit] or [ground]", "both");
    scenario.orbit = orbit_of(*orbit);
  }
  if (const auto earth = root.table_if("earth")) {
    if (!scenario.orbit) throw root.error("earth", "an [orbit], from which the Earth is seen", "none");
    scenario.earth = earth_of(*earth);
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
  const double duration = scenario.frames / scenario.frame_rate;
  read_surroundings(root, scenario);
  read_trajectory(root.table("trajectory"), duration, scenario);
  scenario.rig = read_rig_file(scenario.rig_file);
  read_sensors(root, scenario);
  scenario.cards = cards_of(root, duration, scenario.orbit ? &*scenario.orbit : nullptr);
  read_sun_and_moon(root, scenario);
  root.refuse_unknown_keys();
  return scenario;
}

}  // namespace omma::sim
