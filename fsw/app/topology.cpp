#include "fsw/app/topology.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "components/extractor/step_budget.hpp"
#include "fsw/app/operations.hpp"
#include "fsw/app/program_dictionary.hpp"

namespace omma {
namespace {

constexpr int kMotionPriority = 80;
constexpr int kVisionPriority = 60;
constexpr int kHealthPriority = 10;

StarCatalogue star_catalogue(const Mission& mission) {
  double finest = 1;
  for (const RigCamera& camera : mission.rig.cameras) finest = std::min(finest, camera.lens.pixel_angle());
  // Two stars within two pixels of the finest camera are one dot.
  Observer from_centre;  // of the Earth: the tracker adds what the observer's own place does
  from_centre.julian_date_utc = mission.tracker.observer.julian_date_utc;
  return {from_centre, {.magnitude_limit = 6.5F, .resolution = 2 * finest}};
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

// Light is added up in raw frames: only of sensors whose grey levels are even in light as they come.
ApproachParameters approach_parameters(const Mission& mission) {
  ApproachParameters parameters = mission.approach;
  for (std::size_t c = 0; c < mission.cameras.size(); ++c) {
    const ExtractorCamera& camera = mission.cameras[c].dots;
    const bool even = camera.sensor.response.empty() && camera.illumination.empty();
    parameters.gain[c] = even ? camera.parameters.gain : 0;
    parameters.black_level[c] = camera.parameters.black_level;
  }
  return parameters;
}

std::optional<UtcNs> epoch(const Mission& mission) {
  if (mission.epoch_utc.empty()) return std::nullopt;
  return parse_utc_ns(mission.epoch_utc);
}

std::vector<ParameterEntry> parameter_entries(const Mission& mission) {
  std::vector<std::string> names;
  std::vector<ExtractorParameters> extractors;
  for (std::size_t c = 0; c < mission.rig.cameras.size(); ++c) {
    names.emplace_back(mission.rig.cameras[c].name.view());
    extractors.push_back(mission.cameras[c].dots.parameters);
  }
  std::vector<ParameterEntry> entries;
  add_entries(entries, extractors, names);
  add_entries(entries, std::vector{mission.tracker});
  add_entries(entries, std::vector{mission.attitude});
  add_entries(entries, std::vector{mission.imaging});
  return entries;
}

telemetry::TelemetryNames telemetry_names(const Mission& mission) {
  telemetry::TelemetryNames names;
  for (const RigCamera& camera : mission.rig.cameras) names.cameras.push_back(camera.name);
  for (const TargetBody& body : mission.bodies) names.bodies.push_back(body.name);
  if (mission.motion)
    for (const MotionAxis& axis : mission.motion->axes) names.axes.push_back(axis.axis.name);
  return names;
}

}  // namespace

Topology::Topology(const Mission& mission, const RunOptions& options)
    : mission_(mission),
      pool_(options.workers, options.lockstep ? 0 : kVisionPriority),
      catalogue_(star_catalogue(mission_)),
      drivers_(mission_, options),
      servo_(servo_driver(mission_, options)),
      trigger_line_(trigger_driver(mission_, options, servo_.get())),
      commander(options.session),
      parameters(parameter_entries(mission_), events),
      sync_trigger(trigger_line_.get(), events),
      cameras(drivers_.pointers(), events),
      exposure(drivers_.pointers(), exposure_parameters(mission_), events),
      lookout(mission_.lookout, mission_.tracker, mission_.rig, mission_.bodies.size()),
      extractor(extractor_cameras(mission_), pool_),
      tracker(mission_.tracker, mission_.rig, catalogue_, mission_.bodies, masks(mission_)),
      attitude(mission_.attitude),
      pose(mission_.pose),
      surveillance(mission_.surveillance, mission_.rig, catalogue_, mission_.tracker.floor_px),
      approach(approach_parameters(mission_), mission_.rig, catalogue_, mission_.bodies,
               mission_.tracker.floor_px),
      imaging(mission_.imaging, mission_.rig, events),
      limit_watch(kLimits, events),
      mode_keeper(kTransitions, events),
      fault_watch(kFaultRules, events, mode_keeper, commander),
      telemetry(telemetry_names(mission_), events),
      utc(options.lockstep ? UtcCorrelation::Kind::kReplay : UtcCorrelation::Kind::kLive, epoch(mission_)),
      health(events),
      health_to_telemetry_(health.report),
      timing_to_telemetry_(health.timing),
      utc_to_telemetry_(utc.report) {
  if (mission_.motion && mission_.motion->driver == ServoKind::kRecorded) {
    motion_playback.emplace(mission_.motion->recorded);
  } else if (mission_.motion) {
    motion.emplace(MotionParameters{.axes = mission_.motion->axes, .period_ns = mission_.motion->period_ns()},
                   *servo_, events);
    motion_to_telemetry_.emplace(motion->report);
  }
  if (trigger_line_) trigger_watch.emplace(mission_.rig.cameras.size(), mission_.trigger.matching, events);
  connect();
  bind_commands();
}

void Topology::bind_commands() {
  commander.bind(kParameterCommands, parameters);
  commander.bind(kModeCommands, mode_keeper);
  commander.bind(kImagingCommands, imaging);
  commander.bind(kTrackerCommands, tracker);
  commander.bind(kApproachCommands, approach);
}

CommandVocabulary Topology::vocabulary() const {
  return {.commands = kCommands, .parameters = parameters.entries()};
}

void Topology::connect() {
  extractor.tuning.bind(parameters.committed);
  tracker.tuning.bind(parameters.committed);
  attitude.tuning.bind(parameters.committed);
  imaging.tuning.bind(parameters.committed);
  cameras.trigger.bind(sync_trigger.trigger);
  exposure.frames.bind(cameras.frames);
  lookout.frames.bind(cameras.frames);
  lookout.dots.bind(extractor.dots);
  lookout.pairings.bind(tracker.pairings);
  lookout.attitude.bind(attitude.estimate);
  lookout.poses.bind(pose.estimates);
  lookout.objects.bind(surveillance.objects);
  extractor.frames.bind(cameras.frames);
  extractor.windows.bind(lookout.windows);
  tracker.dots.bind(extractor.dots);
  tracker.attitude.bind(attitude.estimate);
  tracker.poses.bind(pose.estimates);
  attitude.pairings.bind(tracker.pairings);
  pose.pairings.bind(tracker.pairings);
  surveillance.dots.bind(extractor.dots);
  surveillance.pairings.bind(tracker.pairings);
  surveillance.attitude.bind(attitude.estimate);
  approach.frames.bind(cameras.frames);
  approach.dots.bind(extractor.dots);
  approach.pairings.bind(tracker.pairings);
  approach.attitude.bind(attitude.estimate);
  approach.poses.bind(pose.estimates);
  approach.objects.bind(surveillance.objects);
  approach.leftovers.bind(surveillance.leftovers);
  imaging.frames.bind(cameras.frames);
  imaging.dots.bind(extractor.dots);
  imaging.attitude.bind(attitude.estimate);
  housekeeping.frames.bind(cameras.frames);
  housekeeping.dots.bind(extractor.dots);
  housekeeping.pairings.bind(tracker.pairings);
  housekeeping.attitude.bind(attitude.estimate);
  housekeeping.poses.bind(pose.estimates);
  housekeeping.health.bind(health_to_telemetry_);
  limit_watch.channels.bind(housekeeping.channels);
  fault_watch.channels.bind(housekeeping.channels);
  mode_keeper.channels.bind(housekeeping.channels);
  commander.mode.bind(mode_keeper.state);
  telemetry.frames.bind(cameras.frames);
  telemetry.exposure.bind(exposure.report);
  telemetry.dots.bind(extractor.dots);
  telemetry.pairings.bind(tracker.pairings);
  telemetry.attitude.bind(attitude.estimate);
  telemetry.poses.bind(pose.estimates);
  telemetry.objects.bind(surveillance.objects);
  telemetry.approaches.bind(approach.estimates);
  telemetry.image.bind(imaging.chunk);
  telemetry.health.bind(health_to_telemetry_);
  telemetry.timing.bind(timing_to_telemetry_);
  telemetry.utc.bind(utc_to_telemetry_);
  if (trigger_watch) {
    trigger_watch->trigger.bind(sync_trigger.trigger);
    trigger_watch->frames.bind(cameras.frames);
  }
  if (motion_to_telemetry_) telemetry.motion.bind(*motion_to_telemetry_);
  if (motion_playback) {
    motion_playback->trigger.bind(sync_trigger.trigger);
    telemetry.motion.bind(motion_playback->report);
  }
  telemetry.commands.bind(commander.state);
  telemetry.parameters.bind(parameters.committed);
  telemetry.parameter_state.bind(parameters.state);
  telemetry.mode.bind(mode_keeper.state);
  telemetry.limit_counts.bind(limit_watch.counts);
  telemetry.tell_parameters(parameters.entries());
  commander.acks.bind(acks_to_telemetry_);
  telemetry.acks.bind(acks_to_telemetry_);
}

std::uint64_t Topology::ticks(std::uint64_t frame_sets) const {
  const std::uint64_t each = mission_.motion ? mission_.motion->beats_per_frame_set : 1;
  return frame_sets > kEndless / each ? kEndless : frame_sets * each;
}

RateGroupTable Topology::table() {
  using std::chrono::microseconds;
  const std::uint32_t base_ticks = mission_.motion ? mission_.motion->beats_per_frame_set : 1;
  const std::chrono::nanoseconds period = mission_.motion
                                              ? std::chrono::nanoseconds(mission_.motion->period_ns())
                                              : microseconds(std::llround(1e6 / mission_.frame_rate_hz));
  const BudgetRule draw_less{.reaction = BreachReaction::kDegrade};
  // Safe mode leaves out poses and pictures: the tracker has the processor to itself.
  const BudgetRule overloaded{.reaction = BreachReaction::kSafe, .breaches = 50, .in_steps = 60};
  RateGroupTable table{
      .base_period = period,
      .groups = {{.name = "vision",
                  .divisor = base_ticks,
                  .priority = kVisionPriority,
                  .critical = true,
                  .components = {{commander, microseconds(100)},
                                 {parameters, microseconds(100)},
                                 {sync_trigger, microseconds(100)},
                                 {cameras, microseconds(2000)},
                                 {exposure, microseconds(500)},
                                 {lookout, microseconds(500), {}, 1, kAttitudeModes},
                                 {extractor,
                                  extraction_budget(extractor_cameras(mission_), pool_.workers()),
                                  {},
                                  pool_.workers(),
                                  kAttitudeModes},
                                 {tracker, microseconds(15000), overloaded, 1, kAttitudeModes},
                                 {attitude, microseconds(2000), {}, 1, kAttitudeModes},
                                 {pose, microseconds(2000), {}, 1, kAllProductsModes},
                                 {surveillance, microseconds(2000), {}, 1, kAllProductsModes},
                                 {approach, microseconds(2000), {}, 1, kAllProductsModes},
                                 {imaging, microseconds(10000), draw_less, 1, kAllProductsModes},
                                 {housekeeping, microseconds(100)},
                                 {limit_watch, microseconds(100)},
                                 {fault_watch, microseconds(100)},
                                 {mode_keeper, microseconds(100)}}},
                 {.name = "health",
                  .divisor = base_ticks * beats_per_second(mission_.frame_rate_hz),
                  .priority = kHealthPriority,
                  .components = {{utc, microseconds(100)}, {health, microseconds(1000)}}}},
      .phase = &mode_keeper.phase()};
  auto& vision = table.groups.front().components;
  if (motion_playback) vision.push_back({*motion_playback, microseconds(100)});
  vision.push_back({telemetry, microseconds(1000)});
  if (trigger_watch) vision.push_back({*trigger_watch, microseconds(100)});
  if (motion)
    table.groups.push_back(
        {.name = "motion", .priority = kMotionPriority, .components = {{*motion, microseconds(500)}}});
  return table;
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
