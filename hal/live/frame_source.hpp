// A device that delivers frames by itself: what a live driver implements. LiveCamera makes a camera of it:
// its thread calls `take` in a loop and `start` again after a loss.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fsw/kernel/tick.hpp"
#include "hal/camera.hpp"
#include "hal/live/pixel_layout.hpp"

namespace omma {

enum class TakeStatus : std::uint8_t {
  kFrame,
  kSilence,  ///< none came in time
  kDamaged,  ///< one came that the device itself calls wrong, or that is cut short
  kGone,     ///< the device does not answer any more: unplugged, or its driver failed
};

struct Taken {
  TakeStatus status = TakeStatus::kSilence;
  TimeNs time_ns = 0;          ///< the device driver's stamp, CLOCK_MONOTONIC
  std::uint32_t sequence = 0;  ///< the device's own count of frames, those it lost included
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::string_view driver_name() const = 0;
  /// The shape of every frame, known before the device is there.
  virtual GreyShape shape() const = 0;
  /// Opens the device, sets it up and starts the stream. Allocates.
  /// @throws InputError: no such device, or one that cannot do what the setup asks; then nothing is open
  virtual void start() = 0;
  /// Gives everything back; may be called at any time.
  virtual void stop() noexcept = 0;
  /// Waits for the next frame, no longer than `timeout_ms`, and converts it into `pixels` (shape().bytes()).
  /// Between `start` and `stop` only. Allocates nothing.
  virtual Taken take(std::byte* pixels, int timeout_ms) noexcept = 0;
  /// What can be set while it runs; known after the first `start`.
  virtual CameraSettingsRange settings_range() const { return {}; }
  /// Those in effect as far as the driver knows. Between `start` and `stop` only.
  virtual CameraSettings settings() const noexcept { return {}; }
  /// Sets what lies in the range; on the thread that takes. Allocates nothing. @return false where the device
  /// refused
  virtual bool apply(const CameraSettings& /*settings*/) noexcept { return false; }
};

}  // namespace omma
