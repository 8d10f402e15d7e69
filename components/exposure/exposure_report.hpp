// What automatic exposure did: what the exposure component writes.
#pragma once

#include "components/exposure/exposure_control.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct CameraExposure {
  CameraSettings settings{};  ///< last accepted
  ExposureStatistics seen{};  ///< of the last frame looked at
  ExposureState state = ExposureState::kGood;
  bool automatic = false;
  std::uint32_t refused = 0;  ///< changes that the camera did not accept
};

struct ExposureReport {
  std::uint64_t frame = 0;
  StaticVector<CameraExposure, limits::kCameras> cameras;  ///< in the order of the rig
};

}  // namespace omma
