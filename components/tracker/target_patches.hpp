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
  std::size_t matching_solid(const DotPatch& patch, std::span<PatchLabels> out) const noexcept;

  bool flat() const { return flat_; }
  bool has_planar() const { return !planar_.empty(); }
  /// Ordered triples of targets compared with every foursome of dots.
  std::size_t triples() const { return triples_.size(); }

 private:
  struct Triple {
    std::array<std::uint8_t, 3> targets;
    float g11, g12, g22;  ///< inner products of the two edges [m²]
    float area;           ///< |e1 × e2| [m²]
    std::uint32_t first;  ///< its fourths
    std::uint32_t count;
    /// Of the face that all three are on, against e1 × e2; 0: on no face, or not on one.
    std::int8_t front;
  };
  struct Fourth {
    float alpha, beta, gamma;  ///< fourth = first + α e1 + β e2 + γ n, n their unit normal, γ in m
    std::uint32_t triple;
    std::uint8_t target;
  };

  /// How three targets lie in space where three dots show them: edges and unit normal (one metre) at the
  /// scale of the image with the first of them at depth 1.
  struct Alignment {
    Eigen::Vector2d u, v;
    double z1, z2;
    Eigen::Vector3d normal;
  };

  static Alignment aligned(const DotPatch& patch, const Triple& triple, double sign) noexcept;
  void add_triple(const TargetBody& body, std::span<const std::uint8_t> neighbours, std::uint8_t i,
                  std::uint8_t j, std::uint8_t k);

  double tilt_factor_;
  bool flat_ = false;
  std::vector<Triple> triples_;
  std::vector<Fourth> fourths_;  ///< by triple; none of a card
  std::vector<Fourth> planar_;   ///< those in the plane of their triple, by α
};

}  // namespace omma
