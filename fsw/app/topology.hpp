// Topology: the one file where everything is wired. Every component, every connection, every rate.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "components/approach/approach.hpp"
#include "components/attitude/attitude.hpp"
#include "components/camera/cameras.hpp"
#include "components/camera/trigger_watch.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/exposure/exposure.hpp"
#include "components/extractor/extractor.hpp"
#include "components/housekeeping/housekeeping.hpp"
#include "components/imaging/imaging.hpp"
#include "components/motion/motion.hpp"
#include "components/motion/motion_playback.hpp"
#include "components/pose/relative_pose.hpp"
#include "components/surveillance/surveillance.hpp"
#include "components/sync_trigger/sync_trigger.hpp"
#include "components/telemetry/telemetry.hpp"
#include "components/tracker/lookout.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/app/camera_drivers.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/app/run_options.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/worker_pool.hpp"
#include "fsw/services/command_text.hpp"
#include "fsw/services/commander.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/fault_watch.hpp"
#include "fsw/services/health.hpp"
#include "fsw/services/limit_watch.hpp"
#include "fsw/services/mode_keeper.hpp"
#include "fsw/services/parameters.hpp"
#include "fsw/services/utc_correlation.hpp"

namespace omma {

/// All components of the flight program, wired. Made once, before time starts; nothing in it moves
/// afterwards.
class Topology {
 public:
  /// @throws InputError where a file the mission names is not usable
  Topology(const Mission& mission, const RunOptions& options);
  Topology(const Topology&) = delete;
  Topology& operator=(const Topology&) = delete;

  const Mission& mission() const { return mission_; }
  /// Base ticks that so many frame sets take.
  std::uint64_t ticks(std::uint64_t frame_sets) const;
  /// Null where nothing moves.
  ServoDriver* servo() const { return servo_.get(); }
  /// Null where nothing is fired.
  TriggerDriver* trigger_line() const { return trigger_line_.get(); }
  RateGroupTable table();
  /// Which component ends which stage of a frame set's way.
  std::vector<telemetry::StageEnd> stage_ends() const;
  /// Latency budgets: as the mission declares them, or as they follow from the table's.
  telemetry::PerStage<> latency_budgets();
  /// Real-time privileges that the threads sharing the extraction were not granted.
  const Refusals& refusals() const { return pool_.refusals(); }
  /// Told of the jobs of those threads, and of the caller's, from now on.
  void observe_jobs(JobObserver& observer) noexcept { pool_.observe(observer); }
  /// The words of the commands it takes; valid as long as this.
  CommandVocabulary vocabulary() const;
  /// CameraDrivers::frame_sets
  std::uint64_t frame_sets() const { return drivers_.frame_sets(); }

 private:
  const Mission mission_;
  WorkerPool pool_;
  StarCatalogue catalogue_;
  CameraDrivers drivers_;
  std::unique_ptr<ServoDriver> servo_;
  std::unique_ptr<TriggerDriver> trigger_line_;

 public:
  Events events;

  // In the order of the data.
  Commander commander;
  Parameters parameters;
  SyncTrigger sync_trigger;
  Cameras cameras;
  Exposure exposure;
  Lookout lookout;
  Extractor extractor;
  Tracker tracker;
  Attitude attitude;
  RelativePose pose;
  Surveillance surveillance;
  Approach approach;
  Imaging imaging;
  Housekeeping housekeeping;
  LimitWatch limit_watch;
  ModeKeeper mode_keeper;
  FaultWatch fault_watch;
  Telemetry telemetry;
  UtcCorrelation utc;
  std::optional<Motion> motion;
  std::optional<MotionPlayback> motion_playback;  // instead of it, where the axes are recorded
  std::optional<TriggerWatch> trigger_watch;
  Health health;

 private:
  Latest<HealthReport> health_to_telemetry_;  // from one rate group to the other
  Latest<TimingReport> timing_to_telemetry_;
  Latest<UtcReport> utc_to_telemetry_;
  std::optional<Latest<MotionReport>> motion_to_telemetry_;
  Queue<CommandAck, 64> acks_to_telemetry_;

  void connect();
  void bind_commands();
};

}  // namespace omma
