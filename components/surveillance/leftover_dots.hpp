// Leftover dots: those of one frame set that neither the sky, the planets nor a body claims, and at whose
// place no catalogue star stands, as sightings in J2000 axes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "components/attitude/attitude_estimate.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "components/tracker/pairings.hpp"

namespace omma {

struct LeftoverDot {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();                        ///< unit vector, J2000
  Eigen::Matrix<double, 2, 3> whitener = Eigen::Matrix<double, 2, 3>::Zero();  ///< as RigDot's, J2000 axes
  Eigen::Vector3d ray = Eigen::Vector3d::UnitX();  ///< the same direction, rig frame
  double sigma = 0;                                ///< [rad], mean of both axes
  float flux = 0;                                  ///< [grey levels]
  float snr = 0;
  std::uint8_t camera = 0;
  std::uint16_t dot = 0;  ///< index in the camera's DotList
};

/// Covariance of the direction, J2000 axes [rad²].
Eigen::Matrix3d direction_covariance(const LeftoverDot& dot) noexcept;

/// Work space; static storage.
class LeftoverDots {
 public:
  static constexpr std::size_t kDots = std::size_t{limits::kDotsPerCamera} * limits::kCameras;

  /// @param catalogue  with stars fainter than the tracker pairs: a dot at the place of any is no object
  /// @param floor_px   standard deviation added to each dot for what its own covariance does not know [px]
  /// @param gate_chi2  how near to a star counts as at its place
  /// @pre the attitude is valid
  std::span<const LeftoverDot> find(const DotLists& dots, const Pairings& pairings,
                                    const AttitudeEstimate& attitude, const Rig& rig,
                                    const StarCatalogue& catalogue, double floor_px,
                                    double gate_chi2) noexcept;

 private:
  void mark_claimed(const Pairings& pairings, const AttitudeEstimate& attitude) noexcept;

  std::array<std::array<std::uint8_t, limits::kDotsPerCamera>, limits::kCameras> claimed_{};
  StaticVector<LeftoverDot, kDots> found_;
};

}  // namespace omma
