// Range modes: what is told of a body at its present distance. Far it is a light among the stars, a bearing;
// nearer its brightness gives the range as well; close its fiducials give the pose. The steps between them
// have hysteresis: a mode is entered on better terms than it is left, and neither for a single frame set.
// The three modes are those of the vision based sensor of the μASC (M. Benn, J. L. Jørgensen, Range
// management of a vision based rendezvous and docking navigation sensor, IAC 2008).
#pragma once

#include <cstdint>

namespace omma {

enum class RangeMode : std::uint8_t {
  kNone,          ///< not seen
  kFar,           ///< bearing
  kIntermediate,  ///< bearing, and range from brightness
  kClose,         ///< pose from fiducials
};

struct RangeModeParameters {
  double range_sigma_enter = 0.25;  ///< of ln range: range is told where it is known better ...
  double range_sigma_leave = 0.35;  ///< ... and no more where worse
  double snr_enter = 10;  ///< of the light: what is found near the threshold only is found too bright
  double snr_leave = 7;
  int settle = 3;    ///< frame sets in a row before a mode is entered
  int patience = 5;  ///< frame sets in a row without what a mode needs before it is left
};

/// What one frame set offers.
struct RangeEvidence {
  bool followed = false;   ///< the body's light has a bearing, seen or expected
  double range_sigma = 1;  ///< of ln range, from brightness [1]
  double snr = 0;          ///< of the light in this frame set; 0: not seen
  bool pose = false;       ///< fiducials gave its position
};

class RangeModes {
 public:
  explicit RangeModes(const RangeModeParameters& parameters) : parameters_(parameters) {}

  RangeMode step(const RangeEvidence& evidence) noexcept;
  RangeMode mode() const noexcept { return mode_; }

 private:
  bool brightness_serves(const RangeEvidence& evidence) const noexcept;

  RangeModeParameters parameters_;
  RangeMode mode_ = RangeMode::kNone;
  int with_pose_ = 0;  // frame sets in a row
  int without_pose_ = 0;
  int with_range_ = 0;
  int without_range_ = 0;
};

}  // namespace omma
