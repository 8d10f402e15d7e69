#include "components/motion/motion.hpp"

#include <algorithm>
#include <utility>

#include "components/motion/axis_follower.hpp"

namespace omma {
namespace {

constexpr double kSeconds = 1e-9;
constexpr int kMostPeriods = 64;  // caught up in one beat

}  // namespace

Motion::Motion(MotionParameters parameters, ServoDriver& driver, Events& events)
    : axes_(std::move(parameters.axes)),
      period_(static_cast<double>(parameters.period_ns) * kSeconds),
      period_ns_(parameters.period_ns),
      driver_(driver),
      events_(events) {
  report->axes.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const AxisSpline& trajectory = axes_[i].trajectory;
    first_time_ = i == 0 ? trajectory.first_time() : std::min(first_time_, trajectory.first_time());
    last_time_ = i == 0 ? trajectory.last_time() : std::max(last_time_, trajectory.last_time());
    report->axes[i].state.angle = axes_[i].axis.home;
  }
  report->trajectory_time = first_time_;
}

void Motion::step(const Tick& tick) noexcept {
  count_late(tick);
  const TimeNs since = begun_ ? elapsed(previous_ns_, tick.time_ns) : period_ns_;
  const auto periods = static_cast<int>(std::clamp<TimeNs>(since / period_ns_, 1, kMostPeriods));
  begun_ = true;
  previous_ns_ = tick.time_ns;
  report->time_ns = tick.time_ns;
  report->valid = true;
  obey_requests(tick);
  if (report->mode == MotionMode::kStopped) {
    end_pulses();
    return;
  }
  if (report->mode == MotionMode::kRunning)
    report->trajectory_time =
        first_time_ + static_cast<double>(elapsed(run_start_ns_, tick.time_ns)) * kSeconds;
  command(tick, periods);
  advance(tick);
}

void Motion::count_late(const Tick& tick) noexcept {
  if (!begun_) return;
  const TimeNs missed = elapsed(previous_ns_, tick.time_ns) / period_ns_ - 1;
  if (missed <= 0) return;
  report->late_ticks += static_cast<std::uint64_t>(missed);
  events_.raise<kMotionLate>(tick, missed, report->trajectory_time);
}

void Motion::obey_requests(const Tick& tick) noexcept {
  const MotionRequest request = request_.exchange(MotionRequest::kNone, std::memory_order_relaxed);
  if (stop_requested_.exchange(false, std::memory_order_relaxed)) {
    if (report->mode == MotionMode::kStopped) return;
    stop_taken_ = false;
    for (AxisCommand& axis : report->axes) axis.state.speed = axis.state.acceleration = 0;
    events_.raise<kEmergencyStop>(tick, report->trajectory_time);
    enter(MotionMode::kStopped, tick);
    return;
  }
  if (request == MotionRequest::kHome) enter(MotionMode::kHoming, tick);
  if (request == MotionRequest::kRun) {
    report->trajectory_time = first_time_;
    enter(MotionMode::kApproaching, tick);
  }
}

void Motion::enter(MotionMode mode, const Tick& tick) noexcept {
  report->mode = mode;
  events_.raise<kMotionMode>(tick, static_cast<int>(mode));
}

void Motion::end_pulses() noexcept {
  if (stop_taken_) return;
  stop_taken_ = driver_.stop();
  report->board_lost = !stop_taken_;
  if (!stop_taken_) {
    ++report->refused_commands;
    return;
  }
  for (AxisCommand& axis : report->axes) axis.pulse = 0;
}

AxisState Motion::goal(const MotionAxis& axis) const noexcept {
  const bool home = report->mode == MotionMode::kHoming || report->mode == MotionMode::kHome;
  if (home) return {axis.axis.home, 0, 0};
  return axis.trajectory.at(report->trajectory_time);
}

void Motion::command(const Tick& tick, int periods) noexcept {
  bool taken = true;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    AxisCommand& axis = report->axes[i];
    axis.goal = goal(axes_[i]);
    AxisState next = axis.state;
    // In the periods before this one the goal was still on its way here.
    for (int k = periods - 1; k >= 0; --k) {
      AxisState waypoint = axis.goal;
      waypoint.angle -= k * period_ * axis.goal.speed;
      next = follow(next, waypoint, axes_[i].axis.limits, period_);
    }
    const QuarterMicroseconds pulse = axes_[i].axis.pulses.pulse(next.angle);
    if (driver_.set_target(axes_[i].axis.channel, pulse)) {
      axis.state = next;
      axis.pulse = pulse;
    } else {
      ++report->refused_commands;
      axis.state.speed = axis.state.acceleration = 0;  // it stays where it was told last
      taken = false;
    }
  }
  tell_board(taken, tick);
}

void Motion::tell_board(bool taken, const Tick& tick) noexcept {
  if (!taken && !report->board_lost) {
    lost_since_ns_ = tick.time_ns;
    refused_before_ = report->refused_commands;
    events_.raise<kServoBoardLost>(tick, report->trajectory_time);
  } else if (taken && report->board_lost) {
    events_.raise<kServoBoardBack>(tick,
                                   static_cast<double>(elapsed(lost_since_ns_, tick.time_ns)) * kSeconds,
                                   report->refused_commands - refused_before_);
  }
  report->board_lost = !taken;
}

void Motion::advance(const Tick& tick) noexcept {
  const bool arrived = std::all_of(report->axes.begin(), report->axes.end(), [](const AxisCommand& axis) {
    return axis.state.angle == axis.goal.angle && axis.state.speed == axis.goal.speed;
  });
  if (!arrived) return;
  if (report->mode == MotionMode::kApproaching) {
    run_start_ns_ = tick.time_ns;
    enter(MotionMode::kRunning, tick);
  } else if (report->mode == MotionMode::kRunning && report->trajectory_time >= last_time_) {
    enter(MotionMode::kFinished, tick);
  } else if (report->mode == MotionMode::kHoming) {
    enter(MotionMode::kHome, tick);
  }
}

}  // namespace omma
