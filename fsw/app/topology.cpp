#include "fsw/app/topology.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hal/recorded/recorded_camera.hpp"

namespace omma {
namespace {

StarCatalogue star_catalogue(const Mission& mission) {
  Observer observer;
  if (!mission.epoch_utc.empty()) observer.julian_date_utc = parse_utc(mission.epoch_utc);
  double finest = 1;
  for (const RigCamera& camera : mission.rig.cameras) finest = std::min(finest, camera.lens.pixel_angle());
  // Two stars within two pixels of the finest camera are one dot.
  return {observer, {.magnitude_limit = 6.5F, .resolution = 2 * finest}};
}

std::vector<std::unique_ptr<CameraDriver>> camera_drivers(const Mission& mission, const RunOptions& options) {
  std::vector<std::unique_ptr<CameraDriver>> drivers;
  for (std::size_t c = 0; c < mission.rig.cameras.size(); ++c) {
    const RigCamera& camera = mission.rig.cameras[c];
    const int bits = mission.cameras[c].bits;
    const RecordedCameraOptions recorded{
        .playback = options.lockstep ? Playback::kLockstep : Playback::kRealTime,
        .width = camera.lens.width(),
        .height = camera.lens.height(),
        .bits = bits > 8 ? 16 : 8,
        .white_level = static_cast<std::uint16_t>((1 << bits) - 1)};
    drivers.push_back(
        std::make_unique<RecordedCamera>(mission.recording, std::string(camera.name.view()), recorded));
  }
  return drivers;
}

std::vector<CameraDriver*> pointers(const std::vector<std::unique_ptr<CameraDriver>>& drivers) {
  std::vector<CameraDriver*> result;
  for (const auto& driver : drivers) result.push_back(driver.get());
  return result;
}

std::vector<ExtractorCamera> extractor_cameras(const Mission& mission) {
  std::vector<ExtractorCamera> cameras;
  for (std::size_t c = 0; c < mission.rig.cameras.size(); ++c) {
    const Lens& lens = mission.rig.cameras[c].lens;
    cameras.push_back({lens.width(), lens.height(), mission.cameras[c].extractor});
  }
  return cameras;
}

}  // namespace

Topology::Topology(const Mission& mission, const RunOptions& options)
    : mission_(mission),
      pool_(options.workers),
      catalogue_(star_catalogue(mission_)),
      drivers_(camera_drivers(mission_, options)),
      sync_trigger(nullptr),
      cameras(pointers(drivers_)),
      extractor(extractor_cameras(mission_), pool_),
      tracker(mission_.tracker, mission_.rig, catalogue_, mission_.bodies),
      attitude(mission_.attitude),
      pose(mission_.pose) {
  connect();
}

void Topology::connect() {
  cameras.trigger.bind(sync_trigger.trigger);
  extractor.frames.bind(cameras.frames);
  tracker.dots.bind(extractor.dots);
  tracker.attitude.bind(attitude.estimate);
  tracker.poses.bind(pose.estimates);
  attitude.pairings.bind(tracker.pairings);
  pose.pairings.bind(tracker.pairings);
}

RateGroupTable Topology::table() {
  using std::chrono::microseconds;
  const auto period = microseconds(std::llround(1e6 / mission_.frame_rate_hz));
  return {.base_period = period,
          .groups = {{.name = "vision",
                      .priority = 60,
                      .components = {{sync_trigger, microseconds(100)},
                                     {cameras, microseconds(2000)},
                                     {extractor, microseconds(10000)},
                                     {tracker, microseconds(15000)},
                                     {attitude, microseconds(2000)},
                                     {pose, microseconds(2000)}}}}};
}

}  // namespace omma
