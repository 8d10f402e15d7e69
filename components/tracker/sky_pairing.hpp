// Pairs dots with stars when the attitude is roughly known: catalogue projected, gated, assigned one to one.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <span>

#include "components/catalogue/star.hpp"
#include "components/geometry/rig.hpp"
#include "components/tracker/assignment.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"

namespace omma {

struct PredictedAttitude {
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< small rotation, rig frame [rad²]
};

/// A part of the sky, seen from the rig, where no star is to be paired (a body stands before it).
struct HiddenCone {
  Eigen::Vector3d apex = Eigen::Vector3d::Zero();   ///< a camera's centre sees the body along ...
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< ... this unit direction, rig frame
  double cos_half_angle = 1;
  std::uint8_t camera = 0;
};

class SkyPairing {
 public:
  /// Appends the pairs of all cameras to `out`, camera by camera, and marks their dots as claimed. Of each
  /// image the brightest Assigner::kPredictions stars are looked for. Where the cameras have more pairs than
  /// `out` has room for, each gets the same share of it, its brightest stars.
  /// @param stars  apparent places, brightest first; those fainter than `magnitude_limit` are not used
  void pair(SeenDots& dots, const Rig& rig, std::span<const SkyStar> stars,
            const PredictedAttitude& prediction, float magnitude_limit, const AssignmentGate& gate,
            std::span<const HiddenCone> hidden, StaticVector<Pairing, limits::kStarPairs>& out) noexcept;

  /// Pairs the last call would have made, in the mean, of dots at random.
  double chance() const { return chance_; }

 private:
  void predict(const RigCamera& camera, std::size_t camera_index, std::span<const SkyStar> stars,
               const PredictedAttitude& prediction, float magnitude_limit,
               std::span<const HiddenCone> hidden) noexcept;
  std::size_t share_of_each(std::size_t cameras, std::size_t room) const noexcept;

  struct Found {
    std::uint16_t star;  // index in the catalogue, brightest first
    std::uint16_t dot;
  };

  StaticVector<PredictedPoint, Assigner::kPredictions> points_;
  std::array<StaticVector<Found, limits::kDotsPerCamera>, limits::kCameras> found_;
  Assigner assigner_;
  double chance_ = 0;
};

}  // namespace omma
