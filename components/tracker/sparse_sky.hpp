// Sparse sky: what brightness, and the stars that ought to be seen, say about a hypothetical attitude where
// dots are few and their angles alone prove too little. Both enter the evidence as probabilities over stars
// and over hypotheses that sum to one, so that the bound on false matches stands whatever the dots'
// brightness is (docs/algorithms/identification.md).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "components/catalogue/star_catalogue.hpp"
#include "components/tracker/search_dot.hpp"
#include "components/tracker/sky_coverage.hpp"

namespace omma {

class SparseSky {
 public:
  static constexpr std::size_t kMostDots = 8;
  static constexpr double kLeastWeight = 5e-4;

  /// @param catalogue, coverage  must outlive this
  SparseSky(const StarCatalogue& catalogue, const SkyCoverage& coverage) noexcept
      : catalogue_(catalogue), coverage_(coverage) {}

  /// Whether the sky of these dots, from now on, is a sparse one.
  /// @param counts_stars  whether weights look at the number of stars to be seen (takes time)
  bool look_at(std::span<const SearchDot> dots, bool counts_stars) noexcept;
  bool is_sparse() const noexcept { return !dots_.empty(); }

  /// How likely the hypothesis is before any other dot is looked at, up to a factor: two dots of one camera
  /// differ in brightness as their stars do, and as many stars are to be seen as there are dots. From
  /// kLeastWeight to 1.
  double weight(const EvidenceMatch& first, const EvidenceMatch& second,
                const Eigen::Matrix3d& j2000_from_rig) const noexcept;

  /// Another camera sees what an earlier dot has seen: neither proof nor disproof.
  bool repeated(std::size_t dot) const noexcept { return repeated_[dot]; }

  /// Stars per steradian that the dot might be instead of `candidate`: 1/(P Ω) where P is the probability
  /// that the dot, if it is a star that is not taken yet, is this one. Over all stars that a camera sees
  /// (narrow: in its field of Ω; else of the whole sphere) the sum of P is one at most.
  /// @param taken  stars of other dots under this hypothesis; their dots' brightness tells this one's
  double rivals(const EvidenceMatch& candidate, std::span<const EvidenceMatch> taken,
                const Eigen::Matrix3d& j2000_from_rig) const noexcept;

 private:
  bool narrow(std::uint8_t camera) const noexcept;
  template <class Visit>
  void each_in_field(std::uint8_t camera, const Eigen::Matrix3d& j2000_from_rig,
                     Visit&& visit) const noexcept;

  const StarCatalogue& catalogue_;
  const SkyCoverage& coverage_;
  std::span<const SearchDot> dots_;
  bool countable_ = false;  // all cameras that have dots are narrow enough
  std::array<std::uint8_t, limits::kCameras> dots_of_{};
  std::array<bool, kMostDots> repeated_{};
};

}  // namespace omma
