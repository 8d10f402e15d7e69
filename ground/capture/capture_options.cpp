#include "ground/capture/capture_options.hpp"

#include <charconv>
#include <cstdio>

#include "components/camera/camera_setup_table.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma::ground {
namespace {

constexpr const char* kCommand = "omma capture";

void read_size(const std::string& text, CameraSetup& setup) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &setup.width, &setup.height, &rest) != 2 || setup.width < 1 ||
      setup.height < 1)
    throw InputError(kCommand, 0, "--size", "WIDTHxHEIGHT, for instance 640x480", text);
}

CameraControl read_control(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw InputError(kCommand, 0, "--set", "NAME=VALUE", text);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

CaptureCamera read_camera(const std::string& text, const CameraSetup& setup) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':', equals);
  if (equals == std::string::npos || equals == 0 || colon == std::string::npos || colon + 1 == text.size())
    throw InputError(kCommand, 0, "--camera", "NAME=DRIVER:DEVICE, for instance cam0=v4l2:/dev/video0", text);
  CaptureCamera camera{text.substr(0, equals), text.substr(equals + 1, colon - equals - 1), setup};
  camera.setup.device = text.substr(colon + 1);
  return camera;
}

std::vector<CaptureCamera> cameras_of_mission(const std::string& file) {
  const TomlTable root = TomlTable::read(file);
  const Rig rig = read_rig_file(root.path("rig"));
  const double rate_hz = root.number("frame_rate_hz", {0.01, 1000}, 10);
  std::vector<CaptureCamera> cameras;
  for (const TomlTable& table : root.tables("camera")) {
    const std::string name = table.text("name");
    const std::string driver = table.text("driver");
    if (driver == "recorded") continue;
    for (const RigCamera& camera : rig.cameras) {
      if (camera.name.view() == name)
        cameras.push_back(
            {name, driver, read_camera_setup(table, camera.lens.width(), camera.lens.height(), rate_hz)});
    }
  }
  if (cameras.empty()) throw root.error("camera", "a live camera of the rig", "none");
  return cameras;
}

}  // namespace

std::vector<CaptureCamera> capture_cameras(const CaptureArguments& arguments) {
  if (arguments.mission.empty() == arguments.cameras.empty())
    throw InputError(kCommand, 0, "cameras", "either a mission file or --camera",
                     arguments.mission.empty() ? "neither" : "both");
  if (!arguments.mission.empty()) return cameras_of_mission(arguments.mission);
  CameraSetup setup;
  setup.where = kCommand;
  read_size(arguments.size, setup);
  setup.format = arguments.format;
  setup.frame_rate_hz = arguments.rate_hz;
  setup.buffers = arguments.buffers;
  setup.timeout_ms = arguments.timeout_ms;
  setup.bayer = arguments.bayer == "raw"     ? BayerUse::kRaw
                : arguments.bayer == "green" ? BayerUse::kGreen
                                             : BayerUse::kGrey;
  setup.dma_buf = arguments.memory == "dma-buf";
  setup.memory_from = arguments.memory_from;
  if (!setup.memory_from.empty() && !setup.dma_buf)
    throw InputError(kCommand, 0, "--memory-from", "--memory dma-buf beside it", arguments.memory);
  for (const std::string& control : arguments.controls) setup.controls.push_back(read_control(control));
  std::vector<CaptureCamera> cameras;
  for (const std::string& camera : arguments.cameras) cameras.push_back(read_camera(camera, setup));
  return cameras;
}

}  // namespace omma::ground
