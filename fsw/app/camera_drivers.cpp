#include "fsw/app/camera_drivers.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "fsw/app/mcap_frames.hpp"
#include "hal/live/live_camera.hpp"
#include "hal/recorded/recorded_camera.hpp"
#include "hal/sources/live_drivers.hpp"

namespace omma {
namespace {

constexpr std::uint32_t kSlots = 6;
constexpr int kPriority = 65;  // above the vision group: what a camera gives is taken out while a step runs

// A folder of image files, or a file of messages.
std::unique_ptr<FrameStore> frame_store(const Mission& mission, std::size_t c) {
  const std::string name(mission.rig.cameras[c].name.view());
  if (mission.recording.extension() == ".mcap")
    return std::make_unique<McapFrames>(mission.recording, name, mission.frame_rate_hz);
  return std::make_unique<FileFrames>(mission.recording / name, name);
}

// All recordings of a mission begin their next round together: after the longest.
std::uint64_t round_length(const Mission& mission) {
  std::uint64_t length = 0;
  for (std::size_t c = 0; c < mission.rig.cameras.size(); ++c) {
    if (mission.cameras[c].driver != "recorded") continue;
    const auto frames = frame_store(mission, c);
    length = std::max(length, frames->number(frames->count() - 1) + 1);
  }
  return length;
}

std::unique_ptr<CameraDriver> recorded(const Mission& mission, std::size_t c, const RunOptions& options,
                                       std::uint64_t round_length) {
  const RigCamera& camera = mission.rig.cameras[c];
  const int bits = mission.cameras[c].bits;
  return std::make_unique<RecordedCamera>(
      frame_store(mission, c),
      RecordedCameraOptions{.playback = options.lockstep ? Playback::kLockstep : Playback::kRealTime,
                            .width = camera.lens.width(),
                            .height = camera.lens.height(),
                            .bits = bits > 8 ? 16 : 8,
                            .white_level = static_cast<std::uint16_t>((1 << bits) - 1),
                            .rounds = options.rounds,
                            .round_length = round_length});
}

}  // namespace

bool has_live_cameras(const Mission& mission) {
  return std::any_of(mission.cameras.begin(), mission.cameras.end(),
                     [](const CameraMission& camera) { return camera.driver != "recorded"; });
}

CameraDrivers::CameraDrivers(const Mission& mission, const RunOptions& options) {
  if (!options.with_cameras) return;
  const std::uint64_t length = round_length(mission);
  const auto phase = std::make_shared<FramePhase>(std::llround(1e9 / mission.frame_rate_hz),
                                                  std::llround(1e6 * mission.frame_delay_ms));
  for (std::size_t c = 0; c < mission.rig.cameras.size(); ++c) {
    const CameraMission& camera = mission.cameras[c];
    drivers_.push_back(camera.driver == "recorded"
                           ? recorded(mission, c, options, length)
                           : std::make_unique<LiveCamera>(make_frame_source(camera.driver, camera.setup),
                                                          phase, camera.setup.timeout_ms, kSlots, kPriority));
  }
}

std::vector<CameraDriver*> CameraDrivers::pointers() const {
  std::vector<CameraDriver*> result;
  result.reserve(drivers_.size());
  for (const auto& driver : drivers_) result.push_back(driver.get());
  return result;
}

std::uint64_t CameraDrivers::frame_sets() const {
  std::uint64_t last = 0;
  for (const auto& driver : drivers_) last = std::max(last, driver->last_number());
  return last == kEndless ? kEndless : last + 1;
}

}  // namespace omma
