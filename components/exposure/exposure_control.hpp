// Automatic exposure of one camera: one knob, the product of exposure time and gain, turned so that the sky
// is neither lost in the rounding to grey levels nor washed out, and the black level so that noise is not cut
// off. Rule, hysteresis and limits in docs/algorithms/exposure.md.
#pragma once

#include <cstdint>

#include "components/exposure/exposure_statistics.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "hal/camera.hpp"

namespace omma {

inline constexpr std::size_t kMostBracketed = 4;

struct ExposureParameters {
  bool automatic = false;
  TimeNs shortest_ns = 10'000;      ///< exposure
  TimeNs longest_ns = 100'000'000;  ///< the blur that the mission's rates allow sets it
  double most_gain = 1000;          ///< the camera's own limit applies too
  double dark = 0.03;               ///< background over black, share of the range: darker is too dark …
  double enough_noise = 2.0;  ///< … unless a pixel's noise is so large [grey levels]: then light adds nothing
  double target = 0.10;       ///< where the background is led to
  double bright = 0.30;       ///< brighter is too bright
  double most_full = 0.02;    ///< share of full pixels
  int settle = 3;             ///< frames that a change is waited for, where the camera does not tell
  int patience = 100;         ///< frames before light is added again after full pixels made it be taken away
  /// Exposures in turn, one a frame set, to be fused (components/imaging); not together with `automatic`.
  StaticVector<TimeNs, kMostBracketed> bracket_ns;
};

enum class ExposureState : std::uint8_t {
  kGood,     ///< within the bounds
  kWaiting,  ///< a change is on its way
  kAtLimit,  ///< too dark or too bright, and nothing left to turn
  kBracket,  ///< not turned: several exposures in turn
};

class ExposureControl {
 public:
  /// The camera's range and the parameters' limits hold together.
  ExposureControl(const ExposureParameters& parameters, const CameraSettingsRange& range);

  /// Settings to begin with: the longest exposure, the least gain, the black level in the middle of its
  /// range.
  CameraSettings first() const;
  /// Looks at the frame taken with `taken` (exposure 0: the camera does not say).
  /// @return true where `wanted` is to be asked of the camera
  bool decide(const ExposureStatistics& frame, const CameraSettings& taken, CameraSettings& wanted) noexcept;
  /// The settings last asked for were accepted, or not: then they are as before.
  void answered(bool accepted) noexcept;

  const CameraSettings& settings() const { return now_; }
  ExposureState state() const { return state_; }

 private:
  double wanted_ratio(const ExposureStatistics& frame) noexcept;
  double wanted_black_level(const ExposureStatistics& frame) const noexcept;
  bool still_on_its_way(const CameraSettings& taken) noexcept;
  CameraSettings with_sensitivity(double sensitivity) const;

  ExposureParameters parameters_;
  CameraSettingsRange range_;
  CameraSettings now_, asked_;
  ExposureState state_ = ExposureState::kWaiting;
  int waited_ = 0;
  double ceiling_ = 0;  // sensitivity at which pixels were full; 0: none known
  int since_full_ = 0;  // frames
};

}  // namespace omma
