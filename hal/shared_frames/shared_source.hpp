// A camera whose frames another program writes into shared memory: the driver "simulated".
#pragma once

#include "hal/camera_setup.hpp"
#include "hal/live/frame_source.hpp"
#include "hal/shared_frames/shared_frames.hpp"

namespace omma {

class SharedSource final : public FrameSource {
 public:
  /// The setup's device is the name of the frames; its controls may be "exposure" [us] and "gain" [percent].
  /// @throws InputError: no size, or another control
  explicit SharedSource(CameraSetup setup);

  std::string_view driver_name() const override { return "simulated"; }
  GreyShape shape() const override { return shape_; }
  void start() override;
  void stop() noexcept override { memory_.close(); }
  Taken take(std::byte* pixels, int timeout_ms) noexcept override;
  CameraSettingsRange settings_range() const override;
  CameraSettings settings() const noexcept override;
  bool apply(const CameraSettings& settings) noexcept override;

 private:
  Taken copy(std::uint32_t written, std::byte* pixels) noexcept;

  CameraSetup setup_;
  GreyShape shape_;
  SharedFramesMemory memory_;
  std::uint32_t next_ = 0;
  std::int32_t exposure_us_ = 0;
  std::int32_t gain_percent_ = 0;
};

}  // namespace omma
