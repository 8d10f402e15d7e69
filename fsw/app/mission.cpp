#include "fsw/app/mission.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "components/camera/camera_setup_table.hpp"
#include "components/catalogue/observer.hpp"
#include "components/catalogue/observer_table.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/estimation/calibration_error_file.hpp"
#include "components/extractor/extractor_tuning.hpp"
#include "components/geometry/rig_file.hpp"
#include "components/tracker/tracker_tuning.hpp"
#include "fsw/app/camera_tables.hpp"
#include "fsw/app/mission_approach.hpp"
#include "fsw/app/mission_imaging.hpp"
#include "fsw/services/toml_table.hpp"
#include "hal/sources/live_drivers.hpp"

namespace omma {
namespace {

// "bright", "dark" or "both"
std::string choices_text(std::string_view choices) {
  std::string text;
  for (int i = 0; i < choice_count(choices); ++i) {
    if (i > 0) text += i + 1 == choice_count(choices) ? " or " : ", ";
    text.append("\"").append(choice_name(choices, i)).append("\"");
  }
  return text;
}

double read_choice(const TomlTable& table, std::string_view key, std::string_view choices, double otherwise) {
  const std::string word = table.text(key, choice_name(choices, static_cast<int>(otherwise)));
  for (int i = 0; i < choice_count(choices); ++i)
    if (choice_name(choices, i) == word) return i;
  throw table.error(key, choices_text(choices), word);
}

// The keys of a table are the last parts of the parameters' names; their ranges are the parameters'.
template <class Fields>
void read_parameters(const TomlTable& table, Fields& fields) {
  visit_parameters(fields, [&table](const ParameterDescriptor& parameter, auto& field) {
    using Field = std::remove_reference_t<decltype(field)>;
    const std::string_view key = parameter.name.substr(parameter.name.rfind('.') + 1);
    const ValueDescriptor& value = parameter.value;
    const Range range{value.least, value.most};
    if (value.type == ValueType::kChoice)
      field = static_cast<Field>(read_choice(table, key, value.choices, static_cast<double>(field)));
    else if (value.type == ValueType::kInteger)
      field = static_cast<Field>(table.integer(key, range, static_cast<std::int64_t>(field)));
    else
      field = static_cast<Field>(table.number(key, range, static_cast<double>(field)));
  });
}

void read_driver(const TomlTable& table, const Lens& lens, double frame_rate_hz, CameraMission& camera) {
  camera.driver = table.text("driver");
  if (camera.driver == "recorded") {
    camera.bits = static_cast<int>(table.integer("bits", {8, 16}, 8));
    // What a live driver needs may stay, so that one word switches between them.
    if (table.has("device")) read_camera_setup(table, lens.width(), lens.height(), frame_rate_hz);
    return;
  }
  std::string known = "\"recorded\"";
  bool live = false;
  for (const std::string_view name : live_drivers()) {
    known += ", \"" + std::string(name) + "\"";
    live = live || name == camera.driver;
  }
  if (!live) throw table.error("driver", known, camera.driver);
  camera.setup = read_camera_setup(table, lens.width(), lens.height(), frame_rate_hz);
}

// The mission's [[camera]] tables, put into the order of the rig; every camera of the rig exactly once.
std::vector<CameraMission> read_cameras(const TomlTable& root, const Rig& rig, double frame_rate_hz) {
  std::vector<CameraMission> cameras(rig.cameras.size());
  std::vector<bool> seen(rig.cameras.size(), false);
  for (const TomlTable& table : root.tables("camera")) {
    const std::string name = table.text("name");
    std::size_t at = 0;
    while (at < rig.cameras.size() && rig.cameras[at].name.view() != name) ++at;
    if (at == rig.cameras.size()) {
      throw table.error("name", "a camera of the rig " + std::string(rig.name.view()), name);
    }
    if (seen[at]) throw table.error("name", "each camera once", name + " again");
    seen[at] = true;
    CameraMission& camera = cameras[at];
    camera.driver = table.text("driver");
    const Lens& lens = rig.cameras[at].lens;
    read_driver(table, lens, frame_rate_hz, camera);
    camera.dots.width = lens.width();
    camera.dots.height = lens.height();
    read_extractors(table, camera.dots);
    read_sensor(table, lens, camera.dots, camera.read_noise_e);
    read_mask(table, lens, camera.dots);
    camera.exposure = read_exposure(table);
    table.refuse_unknown_keys();
  }
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (!seen[c]) {
      throw root.error("camera", "a [[camera]] for every camera of the rig",
                       "none for " + std::string(rig.cameras[c].name.view()));
    }
  }
  return cameras;
}

std::vector<TargetBody> read_bodies(const TomlTable& root, ApproachParameters& approach) {
  std::vector<TargetBody> bodies;
  for (const TomlTable& table : root.tables_if("body")) {
    const std::string name = table.text("name");
    for (const TargetBody& body : bodies) {
      if (body.name.view() == name) throw table.error("name", "each body once", name + " again");
    }
    if (bodies.size() == limits::kTargetBodies) {
      throw table.error("name", "at most " + std::to_string(limits::kTargetBodies) + " bodies",
                        "one more, " + name);
    }
    TargetBody body = read_target_file(table.path("targets"));
    body.name = Name(name);
    if (const auto light = table.table_if("light")) {
      approach.bodies.push_back(read_light(*light, static_cast<std::uint8_t>(bodies.size())));
    }
    bodies.push_back(body);
    table.refuse_unknown_keys();
  }
  return bodies;
}

TrackerParameters read_tracker(const TomlTable& table) {
  TrackerParameters parameters;
  read_parameters(table, parameters);
  parameters.observer_sigma = table.number("observer_sigma_m", {0, 1e9}, parameters.observer_sigma);
  table.refuse_unknown_keys();
  return parameters;
}

LookoutParameters read_lookout(const TomlTable& table) {
  LookoutParameters p;
  p.full_search_every = static_cast<int>(table.integer("full_search_every", {1, 1000}, p.full_search_every));
  table.refuse_unknown_keys();
  return p;
}

// Where the rig is: aberration by its own speed, refraction, parallax.
void read_observer(const TomlTable& table, bool has_epoch, TrackerParameters& tracker) {
  const auto orbit = table.table_if("orbit");
  if (orbit.has_value() == table.has("site"))
    throw table.error("site", "a site on the ground or an [observer.orbit]", orbit ? "both" : "neither");
  if (!has_epoch)
    throw table.error("site", "an epoch, at which the Earth's turn or the orbit is known", "none");
  if (orbit) {
    tracker.orbit = orbit_of(*orbit);
  } else {
    tracker.observer.site = ground_site_of(table);
  }
  tracker.observer_sigma = table.number("sigma_m", {0, 1e9}, 1000);
  table.refuse_unknown_keys();
}

SurveillanceParameters read_surveillance(const TomlTable& table) {
  constexpr double kDegree = std::numbers::pi / 180;
  SurveillanceParameters p;
  p.largest_rate = kDegree * table.number("largest_rate_deg_s", {0.001, 90}, p.largest_rate / kDegree);
  p.acceleration = kDegree * table.number("acceleration_deg_s2", {1e-9, 90}, p.acceleration / kDegree);
  p.false_objects_per_hour = table.number("false_objects_per_hour", {1e-9, 1000}, p.false_objects_per_hour);
  p.least_sightings = static_cast<int>(table.integer("least_sightings", {3, 1000}, p.least_sightings));
  p.patience = static_cast<int>(table.integer("patience", {1, 10000}, p.patience));
  table.refuse_unknown_keys();
  return p;
}

AttitudeParameters read_attitude(const TomlTable& table, double frame_rate_hz) {
  AttitudeParameters p;
  const std::string filter = table.text("filter", "none");
  if (filter == "mekf") {
    p.filter = AttitudeFilterKind::kMekf;
  } else if (filter != "none") {
    throw table.error("filter", "\"none\" or \"mekf\"", filter);
  }
  read_parameters(table, p);
  // A turn between two frame sets is known short of a whole one.
  p.mekf.first_rate_sigma = std::min(p.mekf.first_rate_sigma, 0.3 * frame_rate_hz);
  table.refuse_unknown_keys();
  return p;
}

telemetry::PerStage<double> read_latency(const TomlTable& table) {
  telemetry::PerStage<double> latency_ms{};
  double before = 0;
  for (std::size_t s = 1; s < latency_ms.size(); ++s) {
    const std::string key = std::string(telemetry::stage_name(static_cast<telemetry::FrameStage>(s))) + "_ms";
    latency_ms[s] = table.number(key, {0, 1e6}, 0);
    if (latency_ms[s] <= 0) continue;
    if (latency_ms[s] < before)
      throw table.error(key, "no less than the stage before it has", std::to_string(latency_ms[s]));
    before = latency_ms[s];
  }
  table.refuse_unknown_keys();
  return latency_ms;
}

// The spacecraft's name is a part of every topic's name.
bool is_topic_part(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= limits::kNameLength && std::all_of(name.begin(), name.end(), fits);
}

}  // namespace

Mission read_mission(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::read(file);
  Mission mission;
  mission.file = file.string();
  const std::string spacecraft = root.text("spacecraft");
  if (!is_topic_part(spacecraft)) {
    throw root.error("spacecraft",
                     "a name of 1 to " + std::to_string(limits::kNameLength) + " letters, digits, _ and -",
                     spacecraft);
  }
  mission.spacecraft = Name(spacecraft);
  mission.frame_rate_hz = root.number("frame_rate_hz", {0.01, 1000});
  mission.epoch_utc = root.text("epoch", "");
  std::optional<double> epoch;
  if (!mission.epoch_utc.empty()) {
    try {
      epoch = parse_utc(mission.epoch_utc);
    } catch (const std::exception&) {
      throw root.error("epoch", "a UTC time like 2026-03-20T12:00:00Z", mission.epoch_utc);
    }
  }
  mission.rig = read_rig_file(root.path("rig"));
  mission.cameras = read_cameras(root, mission.rig, mission.frame_rate_hz);
  mission.frame_delay_ms = root.number("frame_delay_ms", {0, 10000}, 0);
  if (root.has("recording")) mission.recording = root.path("recording");
  if (const auto trigger = root.table_if("trigger"))
    mission.trigger = read_trigger(*trigger, mission.frame_rate_hz);
  if (const auto motion = root.table_if("motion"))
    mission.motion = read_motion(*motion, mission.frame_rate_hz);
  mission.bodies = read_bodies(root, mission.approach);
  if (const auto lookout = root.table_if("lookout")) mission.lookout = read_lookout(*lookout);
  if (const auto tracker = root.table_if("tracker")) mission.tracker = read_tracker(*tracker);
  mission.tracker.observer.julian_date_utc = epoch;
  if (const auto observer = root.table_if("observer"))
    read_observer(*observer, epoch.has_value(), mission.tracker);
  if (const auto surveillance = root.table_if("surveillance"))
    mission.surveillance = read_surveillance(*surveillance);
  if (const auto approach = root.table_if("approach")) read_approach(*approach, mission.approach);
  if (const auto attitude = root.table_if("attitude"))
    mission.attitude = read_attitude(*attitude, mission.frame_rate_hz);
  IntegrityOptions integrity;
  if (const auto table = root.table_if("integrity")) integrity = read_integrity(*table);
  if (const auto table = root.table_if("calibration_error"))
    integrity.calibration = read_calibration_error(*table);
  mission.attitude.integrity = mission.pose.integrity = integrity;
  mission.attitude.axes = mission.pose.axes = camera_axes(mission.rig);
  mission.imaging.period = 10;
  if (const auto imaging = root.table_if("imaging")) mission.imaging = read_imaging(*imaging, mission.rig);
  for (std::size_t c = 0; c < mission.cameras.size(); ++c) {
    const CameraMission& camera = mission.cameras[c];
    mission.imaging.sensors[c] = {
        .electrons = static_cast<double>(camera.dots.parameters.gain),
        .black_level = static_cast<double>(camera.dots.parameters.black_level),
        .read_noise = camera.read_noise_e,
        .response = camera.dots.sensor.response,
        .relative_noise = static_cast<double>(camera.dots.parameters.relative_noise)};
  }
  if (const auto latency = root.table_if("latency")) mission.latency_ms = read_latency(*latency);
  mission.dds_domain = static_cast<int>(root.integer("dds_domain", {0, 230}, mission.dds_domain));
  root.refuse_unknown_keys();
  return mission;
}

}  // namespace omma
