// How well a hypothetical pose explains the dots around the patch it came from: the first look at a pose,
// four targets at a time, and the odds that it is no chance. What far-reaching a hit is worth depends on how
// near the dot had to be: a target beside the patch is foretold sharply, one far from it vaguely.
// Source: sequential probability ratio test (Wald 1945), taken over all targets at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "components/catalogue/target.hpp"
#include "components/geometry/pose.hpp"
#include "components/geometry/rig_dot.hpp"
#include "components/tracker/dot_patches.hpp"
#include "components/tracker/target_identification.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

class PatchEvidence {
 public:
  using Hits = StaticVector<TargetPair, DotPatches::kNeighbours + 1>;
  struct Found {
    Hits hits;  ///< near dots, and the target each of them is
    /// How much likelier the hits and misses are at this pose than by chance, the patch's own four dots left
    /// out. Of poses at random, 1 in x has odds of x or more at most.
    double odds = 1;
  };

  /// @param gate  a target is explained by a dot this near [σ]
  PatchEvidence(const TargetBody& body, double gate);

  /// @param near  dots around the patch, of the same camera
  void look_at(std::span<const RigDot> dots, const DotFoursome& foursome,
               std::span<const std::uint16_t> near) noexcept;

  /// Valid until the next call.
  const Found& explained(const Pose& rig_from_body) noexcept;

 private:
  static constexpr std::size_t kTargets = (limits::kTargetsPerBody + 3) / 4 * 4;
  using Row = std::array<float, kTargets>;

  void fill_cells() noexcept;
  /// Bits of the near dots that can be within `reach` of a place, both in cells.
  std::uint32_t near_dots(float x, float y, float reach) const noexcept;

  std::size_t targets_ = 0;
  bool has_faces_ = false;
  double gate_;
  /// Of each target: position, outward normal, and how far along it the target stands; rows filled up with
  /// targets that no pose shows.
  Row x_{}, y_{}, z_{}, nx_{}, ny_{}, nz_{}, height_{}, sided_{};

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle_ = Eigen::Vector3d::UnitZ();
  Eigen::Matrix<double, 3, 2> plane_ = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d affine_from_plane_ = Eigen::Matrix2d::Identity();
  double sigma_ = 0;
  double density_ = 0;  ///< of the near dots in the patch's plane

  StaticVector<std::uint16_t, DotPatches::kNeighbours + 1> near_;
  std::uint32_t own_ = 0;  ///< which of the near dots the pose was made of (a bit each)
  std::array<float, DotPatches::kNeighbours + 1> near_x_{}, near_y_{};
  /// Which of the near dots are within one cell of a cell of the patch's plane (a bit each), and within one
  /// coarse cell of a coarse one.
  static constexpr int kCells = 32, kCoarse = 4;
  template <int kSide>
  using Cells = std::array<std::uint32_t, kSide * kSide>;
  Cells<kCells> near_cell_{};
  Cells<kCells / kCoarse> near_coarse_{};
  Eigen::Vector2d cell_corner_ = Eigen::Vector2d::Zero();
  double cell_side_ = 1;
  Found found_;
};

}  // namespace omma
