// RigDot: a dot as the rig sees it: a ray from a camera centre, with its uncertainty. What identification
// and tracking work on; the camera it came from no longer matters to them.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "components/extractor/dot.hpp"
#include "components/geometry/rig.hpp"

namespace omma {

struct RigDot {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< camera centre, rig frame [m]
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();    ///< unit bearing, rig frame
  /// 2×3: W Bᵀ as in Sight: whitens the difference of a predicted unit direction and the ray
  Eigen::Matrix<double, 2, 3> whitener = Eigen::Matrix<double, 2, 3>::Zero();
  double sigma = 0;         ///< standard deviation of the bearing, mean of both axes [rad]
  float flux = 0;           ///< [grey levels]
  float snr = 0;            ///< flux over its standard deviation
  float area = 0;           ///< [px]
  std::uint8_t flags = 0;   ///< DotFlag
  std::uint8_t camera = 0;  ///< index in the rig
  std::uint16_t index = 0;  ///< index in the camera's DotList
};

/// @param floor_px  standard deviation added in quadrature to each axis for what the dot's own covariance
/// does
///                  not know (lens calibration) [px]
/// @return false where the lens has no ray for the pixel
bool rig_dot(const Dot& dot, std::uint16_t index, const RigCamera& camera, std::uint8_t camera_index,
             double floor_px, RigDot& out) noexcept;

}  // namespace omma
