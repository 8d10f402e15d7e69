#include "fsw/app/topology.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace omma {
namespace {

constexpr int kVisionPriority = 60;
constexpr int kHealthPriority = 10;

StarCatalogue star_catalogue(const Mission& mission) {
  Observer observer;
  if (!mission.epoch_utc.empty()) observer.julian_date_utc = parse_utc(mission.epoch_utc);
  double finest = 1;
  for (const RigCamera& camera : mission.rig.cameras) finest = std::min(finest, camera.lens.pixel_angle());
  // Two stars within two pixels of the finest camera are one dot.
  return {observer, {.magnitude_limit = 6.5F, .resolution = 2 * finest}};
}

std::uint32_t beats_per_second(double rate_hz) {
  return static_cast<std::uint32_t>(std::max(1LL, std::llround(rate_hz)));
}

std::vector<ExtractorCamera> extractor_cameras(const Mission& mission) {
  std::vector<ExtractorCamera> cameras;
  for (const CameraMission& camera : mission.cameras) cameras.push_back(camera.dots);
  return cameras;
}

std::vector<ExposureParameters> exposure_parameters(const Mission& mission) {
  std::vector<ExposureParameters> parameters;
  for (const CameraMission& camera : mission.cameras) parameters.push_back(camera.exposure);
  return parameters;
}

std::vector<PixelMask> masks(const Mission& mission) {
  std::vector<PixelMask> all;
  for (const CameraMission& camera : mission.cameras) all.push_back(camera.dots.mask);
  return all;
}

ImagingParameters imaging_parameters(const Mission& mission) {
  ImagingParameters parameters;
  parameters.panorama.width = mission.panorama_width;
  parameters.period = mission.panorama_period;
  return parameters;
}

std::optional<UtcNs> epoch(const Mission& mission) {
  if (mission.epoch_utc.empty()) return std::nullopt;
  return parse_utc_ns(mission.epoch_utc);
}

telemetry::TelemetryNames telemetry_names(const Mission& mission) {
  telemetry::TelemetryNames names;
  for (const RigCamera& camera : mission.rig.cameras) names.cameras.push_back(camera.name);
  for (const TargetBody& body : mission.bodies) names.bodies.push_back(body.name);
  return names;
}

}  // namespace

Topology::Topology(const Mission& mission, const RunOptions& options)
    : mission_(mission),
      pool_(options.workers, options.lockstep ? 0 : kVisionPriority),
      catalogue_(star_catalogue(mission_)),
      drivers_(mission_, options),
      sync_trigger(nullptr),
      cameras(drivers_.pointers(), events),
      exposure(drivers_.pointers(), exposure_parameters(mission_), events),
      extractor(extractor_cameras(mission_), pool_),
      tracker(mission_.tracker, mission_.rig, catalogue_, mission_.bodies, masks(mission_)),
      attitude(mission_.attitude),
      pose(mission_.pose),
      imaging(imaging_parameters(mission_), mission_.rig),
      telemetry(telemetry_names(mission_), events),
      utc(options.lockstep ? UtcCorrelation::Kind::kReplay : UtcCorrelation::Kind::kLive, epoch(mission_)),
      health(events),
      health_to_telemetry_(health.report),
      timing_to_telemetry_(health.timing),
      utc_to_telemetry_(utc.report) {
  connect();
}

void Topology::connect() {
  cameras.trigger.bind(sync_trigger.trigger);
  exposure.frames.bind(cameras.frames);
  extractor.frames.bind(cameras.frames);
  tracker.dots.bind(extractor.dots);
  tracker.attitude.bind(attitude.estimate);
  tracker.poses.bind(pose.estimates);
  attitude.pairings.bind(tracker.pairings);
  pose.pairings.bind(tracker.pairings);
  imaging.frames.bind(cameras.frames);
  imaging.dots.bind(extractor.dots);
  imaging.attitude.bind(attitude.estimate);
  telemetry.frames.bind(cameras.frames);
  telemetry.dots.bind(extractor.dots);
  telemetry.pairings.bind(tracker.pairings);
  telemetry.attitude.bind(attitude.estimate);
  telemetry.poses.bind(pose.estimates);
  telemetry.image.bind(imaging.chunk);
  telemetry.health.bind(health_to_telemetry_);
  telemetry.timing.bind(timing_to_telemetry_);
  telemetry.utc.bind(utc_to_telemetry_);
}

RateGroupTable Topology::table() {
  using std::chrono::microseconds;
  const auto period = microseconds(std::llround(1e6 / mission_.frame_rate_hz));
  return {.base_period = period,
          .groups = {{.name = "vision",
                      .priority = kVisionPriority,
                      .components = {{sync_trigger, microseconds(100)},
                                     {cameras, microseconds(2000)},
                                     {exposure, microseconds(500)},
                                     {extractor, microseconds(10000), {}, pool_.workers()},
                                     {tracker, microseconds(15000)},
                                     {attitude, microseconds(2000)},
                                     {pose, microseconds(2000)},
                                     {imaging, microseconds(10000), {.reaction = BreachReaction::kDegrade}},
                                     {telemetry, microseconds(1000)}}},
                     {.name = "health",
                      .divisor = beats_per_second(mission_.frame_rate_hz),
                      .priority = kHealthPriority,
                      .components = {{utc, microseconds(100)}, {health, microseconds(1000)}}}}};
}

std::vector<telemetry::StageEnd> Topology::stage_ends() const {
  using telemetry::FrameStage;
  return {{&cameras, FrameStage::kFrame},
          {&extractor, FrameStage::kDots},
          {&tracker, FrameStage::kPairings},
          {&attitude, FrameStage::kSolution},
          {&pose, FrameStage::kSolution}};
}

telemetry::PerStage<> Topology::latency_budgets() {
  telemetry::PerStage<> budgets = telemetry::stage_budgets(table(), stage_ends());
  for (std::size_t s = 0; s < budgets.size(); ++s)
    if (mission_.latency_ms[s] > 0) budgets[s] = std::llround(mission_.latency_ms[s] * 1e6);
  return budgets;
}

}  // namespace omma
