#include "fsw/app/mission.hpp"

#include <algorithm>

#include "components/camera/camera_setup_table.hpp"
#include "components/catalogue/observer.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/app/camera_tables.hpp"
#include "fsw/services/toml_table.hpp"
#include "hal/sources/live_drivers.hpp"

namespace omma {
namespace {

void read_driver(const TomlTable& table, const Lens& lens, double frame_rate_hz, CameraMission& camera) {
  camera.driver = table.text("driver");
  if (camera.driver == "recorded") {
    camera.bits = static_cast<int>(table.integer("bits", {8, 16}, 8));
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
    camera.dots.parameters = read_extractor(table);
    read_sensor(table, lens, camera.dots);
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

std::vector<TargetBody> read_bodies(const TomlTable& root) {
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
    bodies.push_back(body);
    table.refuse_unknown_keys();
  }
  return bodies;
}

TrackerParameters read_tracker(const TomlTable& table) {
  TrackerParameters p;
  p.gate.chi2 = table.number("gate_chi2", {1, 1000}, p.gate.chi2);
  p.gate.floor_px = table.number("gate_floor_px", {0, 10}, p.gate.floor_px);
  p.faintest_star = static_cast<float>(table.number("faintest_star", {0, 8}, p.faintest_star));
  p.floor_px = table.number("lens_error_px", {0, 10}, p.floor_px);
  p.sky_angular_acceleration = table.number("sky_angular_acceleration", {0, 100}, p.sky_angular_acceleration);
  p.body_angular_acceleration =
      table.number("body_angular_acceleration", {0, 100}, p.body_angular_acceleration);
  p.body_linear_acceleration = table.number("body_linear_acceleration", {0, 100}, p.body_linear_acceleration);
  p.least_star_pairs = static_cast<int>(table.integer("least_star_pairs", {3, 100}, p.least_star_pairs));
  p.least_target_pairs = static_cast<int>(table.integer("least_target_pairs", {3, 64}, p.least_target_pairs));
  p.patience = static_cast<int>(table.integer("patience", {1, 1000}, p.patience));
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
  p.mekf.acceleration_density =
      table.number("acceleration_density", {1e-9, 100}, p.mekf.acceleration_density);
  // A turn between two frame sets is known short of a whole one.
  p.mekf.first_rate_sigma = std::min(p.mekf.first_rate_sigma, 0.3 * frame_rate_hz);
  p.least_pairs = static_cast<int>(table.integer("least_pairs", {3, 100}, p.least_pairs));
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
  if (!mission.epoch_utc.empty()) {
    try {
      parse_utc(mission.epoch_utc);
    } catch (const std::exception&) {
      throw root.error("epoch", "a UTC time like 2026-03-20T12:00:00Z", mission.epoch_utc);
    }
  }
  mission.rig = read_rig_file(root.path("rig"));
  mission.cameras = read_cameras(root, mission.rig, mission.frame_rate_hz);
  mission.frame_delay_ms = root.number("frame_delay_ms", {0, 10000}, 0);
  if (root.has("recording")) mission.recording = root.path("recording");
  mission.bodies = read_bodies(root);
  if (const auto tracker = root.table_if("tracker")) mission.tracker = read_tracker(*tracker);
  if (const auto attitude = root.table_if("attitude"))
    mission.attitude = read_attitude(*attitude, mission.frame_rate_hz);
  if (const auto imaging = root.table_if("imaging")) {
    mission.panorama_width =
        static_cast<int>(imaging->integer("panorama_width", {64, 4096}, mission.panorama_width));
    mission.panorama_period =
        static_cast<int>(imaging->integer("period", {1, 100000}, mission.panorama_period));
    imaging->refuse_unknown_keys();
  }
  if (const auto latency = root.table_if("latency")) mission.latency_ms = read_latency(*latency);
  mission.dds_domain = static_cast<int>(root.integer("dds_domain", {0, 230}, mission.dds_domain));
  root.refuse_unknown_keys();
  return mission;
}

}  // namespace omma
