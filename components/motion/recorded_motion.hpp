// What the axes of a gimbal did earlier, to be played back: what a flight told of them, frame set by frame
// set, or a table of their angles over time.
#pragma once

#include <cstdint>
#include <vector>

#include "components/motion/axis.hpp"
#include "components/motion/motion_report.hpp"

namespace omma {

struct RecordedMotionSample {
  std::uint64_t frame = 0;
  MotionReport report;  ///< its time is the recording's
};

class RecordedMotion {
 public:
  RecordedMotion() = default;
  /// @param samples  by rising frame
  explicit RecordedMotion(std::vector<RecordedMotionSample> samples) : samples_(std::move(samples)) {}
  /// @param angles  of each axis over time [s, rad], by rising time; an axis without any rests at home
  RecordedMotion(std::vector<GimbalAxis> axes, std::vector<std::vector<KeyPoint>> angles);

  bool empty() const noexcept { return samples_.empty() && axes_.empty(); }
  /// What was recorded at the frame set; of a table at `seconds` after its time 0, straight between two lines
  /// of it. All but the report's time is overwritten; not valid where the recording says nothing. Never
  /// allocates.
  void tell(std::uint64_t frame, double seconds, MotionReport& report) const noexcept;

 private:
  void tell_angles(double seconds, MotionReport& report) const noexcept;

  std::vector<RecordedMotionSample> samples_;
  std::vector<GimbalAxis> axes_;  // of a table
  std::vector<std::vector<KeyPoint>> angles_;
  double first_time_ = 0;
  double last_time_ = 0;
};

}  // namespace omma
