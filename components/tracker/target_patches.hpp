// Patches of a body: every target with its neighbours, as three basis targets and a fourth one in their
// affine coordinates. Built once; asked, for four dots of an image, which foursomes of targets they may be.
// Source: affine coordinates as in geometric hashing (Lamdan & Wolfson 1988); three points in parallel
// projection and the two depths they may have (Huttenlocher & Ullman 1990).
// docs/algorithms/target_identification.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/tracker/four_lanes.hpp"

namespace omma {

/// Four dots of one camera on the plane that touches the sphere of bearings at their middle [rad].
struct DotPatch {
  std::array<Eigen::Vector2d, 4> at;  ///< the four dots
  Eigen::Vector2d u;                  ///< second dot minus first
  Eigen::Vector2d v;                  ///< third dot minus first
  double alpha = 0;                   ///< fourth = first + α u + β v
  double beta = 0;
  double noise = 0;  ///< what the dots' noise may do to the fourth against the three (at the gate) [rad]
  double alpha_noise = 0;  ///< what the dots' noise may do to α and β (at the gate)
  double beta_noise = 0;
};

/// Targets that the four dots may be, in the order of the dots.
using PatchLabels = std::array<std::uint8_t, 4>;

class TargetPatches {
 public:
  /// @param tilt_factor  tan of the largest tilt of a patch against the line of sight that is allowed for
  TargetPatches(const TargetBody& body, double tilt_factor);

  /// Writes the foursomes of targets that agree with the patch, best known first come first written.
  /// `planar`: those that lie in a plane (one face of a body, or a card), which are found much faster;
  /// `solid`: any, of a body that is no card.
  /// @return how many were written, at most out.size()
  std::size_t matching_planar(const DotPatch& patch, std::span<PatchLabels> out) const noexcept;

  /// Room that `out` must have: what four triples of targets may match at most.
  static constexpr std::size_t kMostOfBlock = 48;
  /// @param block  where to go on, 0 at first; the number of blocks at the end
  std::size_t matching_solid(const DotPatch& patch, std::size_t& block,
                             std::span<PatchLabels> out) const noexcept;
  /// Of four ordered triples of targets each, compared with every foursome of dots.
  std::size_t blocks() const { return blocks_.size(); }
  std::size_t solid_triples() const { return kFour * blocks_.size(); }

  bool flat() const { return flat_; }
  bool has_planar() const { return !planar_.empty(); }

 private:
  static constexpr std::size_t kSolidNeighbours = 7;  ///< of a target, that share its solid patches
  static constexpr std::size_t kFourths = kSolidNeighbours - 2;  ///< of a triple
  using Row = std::array<float, kFour>;                          ///< of four triples side by side
  struct Triple {
    std::array<std::uint8_t, 3> targets;
    /// Of the face that all three are on, against e1 × e2; 0: on no face, or not on one.
    std::int8_t front;
  };
  struct Solid {
    Triple triple;
    /// Its fourths: first + α e1 + β e2 + γ n, n the unit normal, γ in m; filled up with NaN.
    std::array<float, kFourths> alpha, beta, gamma;
    std::array<std::uint8_t, kFourths> fourth;
    float g11, g12, g22;                    ///< inner products of the two edges [m²]
    float area;                             ///< |e1 × e2| [m²]
    float size;                             ///< longest side, squared [m²]
    std::array<Eigen::Vector3f, 3> facing;  ///< outward normals of the three in e1, e2, n
  };
  /// Four triples side by side.
  struct Block {
    Row g11, g12, g22, per_gram, per_area;
    std::array<std::array<Row, 3>, 3> facing;
    std::array<Row, kFourths> alpha, beta, gamma;  ///< of each triple's first fourth, then their second ones
    std::array<Triple, kFour> triple;
    std::array<std::array<std::uint8_t, kFour>, kFourths> fourth;  ///< target, as α
  };
  struct PlanarFoursome {
    float alpha, beta;
    std::int8_t front;
    PatchLabels targets;
  };

  void add_triple(const TargetBody& body, std::span<const std::uint8_t> neighbours, std::uint8_t i,
                  std::uint8_t j, std::uint8_t k, std::vector<Solid>& solid);
  void lay_side_by_side(std::vector<Solid>& solid);
  double tilt_factor_;
  bool flat_ = false, has_faces_ = false;
  std::vector<Block> blocks_;           ///< none of a card; the smallest triples first
  std::vector<PlanarFoursome> planar_;  ///< foursomes in a plane, by α
};

}  // namespace omma
