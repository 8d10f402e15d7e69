// The camera interface. A driver (recorded frames, V4L2, libcamera, simulator) implements it; the camera
// component calls it once per frame set.
#pragma once

#include <cstdint>
#include <string_view>

#include "fsw/kernel/tick.hpp"
#include "hal/image.hpp"

namespace omma {

enum class FrameStatus : std::uint8_t {
  kMissing,    ///< no frame came for this trigger
  kFresh,      ///< the frame of this trigger
  kLate,       ///< a frame came, but it belongs to an earlier trigger
  kStuck,      ///< the driver delivers, but always the same frame
  kSaturated,  ///< the frame of this trigger, too bright to use
};

/// One image of one camera. The pixels stay valid until the next `grab` of the same camera.
struct Frame {
  ImageView image;
  std::uint64_t number = 0;         ///< frame id: the trigger it belongs to
  TimeNs exposure_midpoint_ns = 0;  ///< on-board time
  FrameStatus status = FrameStatus::kMissing;
};

class CameraDriver {
 public:
  virtual ~CameraDriver() = default;
  virtual std::string_view driver_name() const = 0;
  /// True when nothing will ever come any more (a recording played to its end).
  virtual bool at_end() const noexcept { return false; }
  /// Fetches the frame of trigger `number`. Never allocates; waits no longer than its own time-out.
  virtual Frame grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept = 0;
};

}  // namespace omma
