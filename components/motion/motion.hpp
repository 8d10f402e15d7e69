// Motion: moves the axes of a gimbal along their trajectories, a command an axis each beat. It first takes
// the axes from home to where the trajectories begin, under their limits; a late beat or a board that was
// away is caught up the same way, while the trajectory's time goes on.
//
// Before the first command the board's servos stand anywhere: the first pulse, home, is a jump.
#pragma once

#include <atomic>
#include <vector>

#include "components/motion/axis.hpp"
#include "components/motion/motion_report.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/events.hpp"

namespace omma {

inline constexpr EventDescriptor kMotionMode{
    .id = 60,
    .severity = EventSeverity::kActivity,
    .name = "motion_mode",
    .text = "motion: mode {0} (0 to the start, 1 runs, 2 finished, 3 goes home, 4 at home, 5 stopped)",
    .values = {{{"mode"}}}};

inline constexpr EventDescriptor kMotionLate{.id = 61,
                                             .severity = EventSeverity::kWarning,
                                             .name = "motion_late",
                                             .text = "motion: {0} beats late at {1} of the trajectory",
                                             .values = {{{"count"}, {"time", "s"}}}};

inline constexpr EventDescriptor kServoBoardLost{
    .id = 62,
    .severity = EventSeverity::kFailure,
    .name = "servo_board_lost",
    .text =
        "motion: the servo board takes no commands at {0} of the trajectory; the axes stay where they are",
    .values = {{{"time", "s"}}}};

inline constexpr EventDescriptor kServoBoardBack{
    .id = 63,
    .severity = EventSeverity::kActivity,
    .name = "servo_board_back",
    .text = "motion: the servo board takes commands again after {0}, {1} commands later",
    .values = {{{"time", "s"}, {"count"}}}};

inline constexpr EventDescriptor kEmergencyStop{
    .id = 64,
    .severity = EventSeverity::kWarning,
    .name = "emergency_stop",
    .text = "motion: emergency stop at {0} of the trajectory, pulses ended",
    .values = {{{"time", "s"}}}};

inline constexpr std::array kMotionEvents{kMotionMode, kMotionLate, kServoBoardLost, kServoBoardBack,
                                          kEmergencyStop};
static_assert(are_unique(kMotionEvents) && are_well_formed(kMotionEvents));

enum class MotionRequest : std::uint8_t {
  kNone,
  kRun,   ///< the trajectory from its beginning; also ends an emergency stop
  kHome,  ///< all axes home; also ends an emergency stop
};

struct MotionParameters {
  std::vector<MotionAxis> axes;  ///< at most kMostAxes
  TimeNs period_ns = 5'000'000;  ///< of its rate group
};

class Motion final : public Component {
 public:
  /// @param driver  outlives this component
  Motion(MotionParameters parameters, ServoDriver& driver, Events& events);

  Out<MotionReport> report;

  std::string_view name() const override { return "motion"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("report", report); }
  void step(const Tick& tick) noexcept override;

  /// From any thread: what the next beat begins to do.
  void request(MotionRequest request) noexcept { request_.store(request, std::memory_order_relaxed); }
  /// From any thread or a signal handler: the next beat ends all pulses, and so do those after it until the
  /// board has taken it. Goes before every other request.
  void emergency_stop() noexcept { stop_requested_.store(true, std::memory_order_relaxed); }

 private:
  void obey_requests(const Tick& tick) noexcept;
  void enter(MotionMode mode, const Tick& tick) noexcept;
  void count_late(const Tick& tick) noexcept;
  void end_pulses() noexcept;
  void command(const Tick& tick, int periods) noexcept;
  void tell_board(bool taken, const Tick& tick) noexcept;
  void advance(const Tick& tick) noexcept;
  AxisState goal(const MotionAxis& axis) const noexcept;

  const std::vector<MotionAxis> axes_;
  const double period_;  // [s]
  const TimeNs period_ns_;
  double first_time_ = 0;  // of the trajectories [s]
  double last_time_ = 0;
  ServoDriver& driver_;
  Events& events_;
  std::atomic<MotionRequest> request_{MotionRequest::kNone};
  std::atomic<bool> stop_requested_{false};

  bool begun_ = false;
  TimeNs previous_ns_ = 0;   // the beat before
  TimeNs run_start_ns_ = 0;  // on-board time of the trajectory's beginning
  bool stop_taken_ = false;  // by the board
  TimeNs lost_since_ns_ = 0;
  std::uint64_t refused_before_ = 0;  // commands, when the board was lost
};

}  // namespace omma
