#include "components/motion/recorded_motion.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace omma {
namespace {

/// Straight between the lines of a table; it has at least one, and `time` lies in a table of all axes.
AxisState between(std::span<const KeyPoint> points, double time) noexcept {
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double t, const KeyPoint& point) { return t < point.time; });
  if (after == points.begin()) return {points.front().angle, 0, 0};
  if (after == points.end()) return {points.back().angle, 0, 0};
  const KeyPoint& from = *(after - 1);
  const double speed = (after->angle - from.angle) / (after->time - from.time);
  return {from.angle + (time - from.time) * speed, speed, 0};
}

}  // namespace

RecordedMotion::RecordedMotion(std::vector<GimbalAxis> axes, std::vector<std::vector<KeyPoint>> angles)
    : axes_(std::move(axes)),
      angles_(std::move(angles)),
      first_time_(std::numeric_limits<double>::infinity()),
      last_time_(-std::numeric_limits<double>::infinity()) {
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    if (angles_[i].empty()) {
      angles_[i] = {{0, axes_[i].home}};
      continue;
    }
    first_time_ = std::min(first_time_, angles_[i].front().time);
    last_time_ = std::max(last_time_, angles_[i].back().time);
  }
}

void RecordedMotion::tell(std::uint64_t frame, double seconds, MotionReport& report) const noexcept {
  if (!axes_.empty()) {
    tell_angles(seconds, report);
    return;
  }
  const auto at = std::lower_bound(
      samples_.begin(), samples_.end(), frame,
      [](const RecordedMotionSample& sample, std::uint64_t number) { return sample.frame < number; });
  report.valid = at != samples_.end() && at->frame == frame;
  if (!report.valid) return;
  const TimeNs time_ns = report.time_ns;
  report = at->report;
  report.time_ns = time_ns;
}

void RecordedMotion::tell_angles(double seconds, MotionReport& report) const noexcept {
  report.valid = seconds >= first_time_ && seconds <= last_time_;
  if (!report.valid) return;
  report.mode = MotionMode::kRunning;
  report.trajectory_time = seconds;
  report.axes.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    AxisCommand& axis = report.axes[i];
    axis.state = axis.goal = between(angles_[i], seconds);
    axis.pulse = axes_[i].pulses.pulse(axis.state.angle);
  }
}

}  // namespace omma
