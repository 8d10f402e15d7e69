// Telemetry: says what the other components found. `step` only copies their messages into a report of fixed
// size and hands it over; a thread that is not real-time (TelemetryOutput) makes DDS samples and log entries
// of it. Nothing upstream ever waits:
//
//   Telemetry telemetry({.cameras = ..., .bodies = ...}, events);       // last in the vision group
//   TelemetryOutput output(telemetry, all_event_descriptors);           // the thread
//   output.add(std::make_unique<LogSink>("flight.mcap", "demo", true)); // where it goes; any number, or none
//   output.start();
//   scheduler.run();
//   output.stop();                                                      // all of it written, files closed
//
// Real time: where the sinks are more than ReportQueue::kReports frame sets behind, whole frame sets are
// dropped and counted (Health::telemetry_dropped), and their sample numbers are missing. Lockstep: nothing is
// dropped, because time waits for the sinks between two ticks, outside every step:
//
//   clock.before_each_tick([&] { output.wait_for_room(); });
//
// What is sent, and in what order, depends on the messages alone: a replay gives the same log, byte for byte.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "components/approach/approach_estimate.hpp"
#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/exposure/exposure_report.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/imaging/image_chunk.hpp"
#include "components/motion/motion_report.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/surveillance/unknown_objects.hpp"
#include "components/telemetry/report_queue.hpp"
#include "components/telemetry/spacecraft_status.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/commander.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/health.hpp"
#include "fsw/services/limit_watch.hpp"
#include "fsw/services/parameters.hpp"
#include "fsw/services/utc_correlation.hpp"

namespace omma {

/// An event of an earlier run of the program, kept by the event store.
struct EarlierEvent {
  EventRecord record;
  std::uint32_t runs_ago = 1;
};

class Telemetry final : public Component {
 public:
  /// Allocates the reports. It is the one reader of `events`.
  Telemetry(const telemetry::TelemetryNames& names, Events& events);
  /// Before time starts: the parameters there are, whose values are sent.
  void tell_parameters(std::span<const ParameterEntry> entries) { parameter_entries_ = entries; }

  In<Frames> frames;
  In<DotLists> dots;
  In<Pairings> pairings;
  In<AttitudeEstimate> attitude;
  In<PoseEstimates> poses;
  In<UnknownObjects> objects;
  In<ApproachEstimates> approaches;  // left unbound where no light is followed
  In<ImageChunk> image;
  In<HealthReport> health;  // from another rate group: sent once per report
  In<TimingReport> timing;
  In<UtcReport> utc;
  In<ExposureReport> exposure;  // left unbound where nobody looks at exposure
  In<MotionReport> motion;      // from another rate group; left unbound where nothing moves
  In<CommanderState> commands;  // this and what follows is left unbound where no commands are taken
  InQueue<CommandAck> acks;
  In<ParameterSet> parameters;
  In<ParameterState> parameter_state;
  In<ModeState> mode;
  In<LimitCounts> limit_counts;

  std::string_view name() const override { return "telemetry"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

  /// The stamps of the frame set's way; made known before the run. Without, no frame_timing is sent.
  void time_frames(const telemetry::FrameStages& stages) { stages_ = &stages; }

  /// Before the run: sent in front of this run's own events.
  void tell_earlier(std::vector<EarlierEvent> events) { earlier_ = std::move(events); }

  /// After the scheduler has returned: sends a report of the events that came after the last frame set. False
  /// when none are left. (TelemetryOutput::stop does this.)
  bool send_rest() noexcept;

  telemetry::ReportQueue& reports() { return reports_; }

 private:
  using Report = telemetry::FrameReport;

  void add_frame_set(Report& report) noexcept;
  void add_dots(Report& report) noexcept;
  void add_products(Report& report) noexcept;
  bool add_housekeeping(Report& report) noexcept;  ///< true when there was a health report
  void add_stages(Report& report) noexcept;
  void add_events(Report& report) noexcept;
  void add_acks(Report& report) noexcept;
  telemetry::SpacecraftStatus status() const noexcept;
  void add_status(Report& report, bool due) noexcept;
  void add_parameters(Report& report) noexcept;
  bool take_event(telemetry::EventSample& event) noexcept;
  void count_dropped() noexcept;
  template <class Sample>
  void add(Report& report, Sample& sample, std::uint32_t& number) noexcept;

  telemetry::TelemetryNames names_;
  Events& events_;
  telemetry::ReportQueue reports_;
  std::span<const ParameterEntry> parameter_entries_;

  // The newest sample number of each topic, and of each key where it has one.
  std::array<std::uint32_t, telemetry::kTopicCount> numbers_{};
  std::array<std::uint32_t, limits::kCameras> dots_numbers_{};
  std::array<std::uint32_t, limits::kTargetBodies> pose_numbers_{};
  std::array<std::uint32_t, limits::kTargetBodies> approach_numbers_{};
  std::uint64_t frame_ = 0;  // newest frame set
  TimeNs health_time_ns_ = 0;
  bool has_health_ = false;
  TimeNs timing_time_ns_ = 0;
  bool has_timing_ = false;
  TimeNs utc_time_ns_ = 0;
  bool has_utc_ = false;
  const telemetry::FrameStages* stages_ = nullptr;
  bool has_status_ = false;
  telemetry::SpacecraftStatus sent_status_;
  std::uint32_t sent_parameters_ = 0;
  bool has_parameters_ = false;
  std::vector<EarlierEvent> earlier_;
  std::size_t earlier_sent_ = 0;
};

}  // namespace omma
