// The camera interface. A driver (recorded frames, V4L2, libcamera, simulator) implements it; the camera
// component calls it once per frame set.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "fsw/kernel/tick.hpp"
#include "hal/image.hpp"

namespace omma {

enum class FrameStatus : std::uint8_t {
  kMissing,     ///< no frame came for this trigger
  kFresh,       ///< the frame of this trigger
  kLate,        ///< a frame came, but it belongs to an earlier trigger
  kStuck,       ///< the driver delivers, but always the same frame
  kSaturated,   ///< the frame of this trigger, too bright to use
  kMismatched,  ///< a frame of a trigger not yet sent, or one that was not exposed at its trigger
};

/// What can be set on a camera while it runs.
struct CameraSettings {
  TimeNs exposure_ns = 0;  ///< time of exposure; 0 = not known
  float gain = 1;          ///< amplification of the signal, 1 = none
  float black_level = 0;   ///< grey level of a pixel without light

  friend bool operator==(const CameraSettings&, const CameraSettings&) = default;
};

/// What a camera accepts, bounds included; a quantity whose bounds are equal cannot be set.
struct CameraSettingsRange {
  CameraSettings least, most;
};

enum class SettingsResult : std::uint8_t {
  kAccepted,    ///< in effect within a few frames; the steps of the hardware may round it
  kNoControl,   ///< this camera has no such control (a recording)
  kOutOfRange,  ///< at least one value is outside the range: nothing was changed
  kFailed,      ///< the device refused or is gone: the settings are as they were
};

/// One image of one camera. The pixels stay valid until the next `grab` of the same camera.
struct Frame {
  ImageView image;
  std::uint64_t number = 0;         ///< frame id: the trigger it belongs to
  TimeNs exposure_midpoint_ns = 0;  ///< on-board time
  FrameStatus status = FrameStatus::kMissing;
  CameraSettings settings{};  ///< those it was taken with, as far as the driver knows
};

/// How a camera has done since the start; all zero for a driver that cannot lose anything.
struct CameraHealth {
  bool connected = true;
  std::uint32_t delivered = 0;  ///< frames the device gave
  std::uint32_t gaps = 0;       ///< frames the device numbered but never gave
  std::uint32_t damaged = 0;    ///< frames the device itself called wrong
  std::uint32_t unmatched = 0;  ///< good frames that belong to no trigger, or came too late for it
  std::uint32_t overrun = 0;    ///< good frames nobody had room for
  std::uint32_t losses = 0;     ///< times the device was lost, or its stream started anew after silence
};

/// The last frame id of a camera that goes on for as long as it is asked.
inline constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

class CameraDriver {
 public:
  virtual ~CameraDriver() = default;
  virtual std::string_view driver_name() const = 0;
  /// True when nothing will ever come any more (a recording played to its end).
  virtual bool at_end() const noexcept { return false; }
  /// Frame id of the last frame that will ever come.
  virtual std::uint64_t last_number() const noexcept { return kEndless; }
  /// Wait-free.
  virtual CameraHealth health() const noexcept { return {}; }
  /// Fetches the frame of trigger `number`. Never allocates; waits no longer than its own time-out.
  virtual Frame grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept = 0;

  /// What can be set; all bounds equal where nothing can.
  virtual CameraSettingsRange settings_range() const noexcept { return {}; }
  /// Asks for settings for the frames to come. Called between two `grab`s by the thread that grabs; never
  /// allocates and does not wait (a driver whose device is slow hands it to a thread of its own).
  virtual SettingsResult apply(const CameraSettings& /*settings*/) noexcept {
    return SettingsResult::kNoControl;
  }
};

}  // namespace omma
