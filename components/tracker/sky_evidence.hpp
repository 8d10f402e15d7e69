// Sky evidence: how much better a hypothetical attitude explains the dots than chance does. A sequential
// likelihood ratio, dot by dot, brightest first, that stops as soon as it is clear either way (Wald 1945; the
// ratio used by Lang et al., Astronomical Journal 139, 2010). Its bound on false matches is proved in
// docs/algorithms/identification.md.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>

#include "components/catalogue/star_catalogue.hpp"
#include "components/tracker/search_dot.hpp"
#include "components/tracker/sparse_sky.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

class SkyEvidence {
 public:
  static constexpr std::size_t kDots = 96;  ///< examined for one hypothesis, at most

  /// @param catalogue  must outlive this
  explicit SkyEvidence(const StarCatalogue& catalogue) : catalogue_(catalogue) {}

  /// The two dots that the next hypotheses rest on; they fix how well an attitude made from them predicts the
  /// others.
  /// @param sparse  has looked at these dots
  void rest_on(std::span<const SearchDot> dots, const SparseSky& sparse, std::size_t first,
               std::size_t second) noexcept;

  /// Weighs the attitude in which the two dots are the stars `first_star` and `second_star`.
  /// @param accept  likelihood ratio at which to stop
  /// @return the ratio reached: `accept` or more, or less where the dots speak against it
  double weigh(const Eigen::Matrix3d& j2000_from_rig, std::uint16_t first_star, std::uint16_t second_star,
               double accept) noexcept;

  /// Dots that were found on a star by the last call of `weigh`, the two it rests on included.
  std::span<const EvidenceMatch> matches() const noexcept { return matches_; }

 private:
  struct Witness {
    double gate = 0;          // [rad]
    double half_inverse = 0;  // 1 / (2 σ²)
    double peak = 0;          // density of the Gaussian part over the density of chance
    double floor = 0;         // density of the flat part over the density of chance
  };

  Witness witness(const SearchDot& dot) const noexcept;

  /// Density of finding the dot where it is, over the density of chance; 0: it is no star that is to be seen.
  double density(const EvidenceMatch& match, double distance2,
                 const Eigen::Matrix3d& j2000_from_rig) const noexcept;

  const StarCatalogue& catalogue_;
  std::span<const SearchDot> dots_;
  const SparseSky* sparse_ = nullptr;
  std::size_t first_ = 0;
  std::size_t second_ = 0;
  Eigen::Matrix3d axes_ =
      Eigen::Matrix3d::Identity();  // rows: axes in which the attitude's errors are independent
  Eigen::Vector3d variances_ = Eigen::Vector3d::Zero();  // about these axes [rad²]
  std::array<Witness, kDots> witnesses_{};
  std::size_t prepared_ = 0;
  StaticVector<EvidenceMatch, kDots + 2> matches_;
  std::array<std::uint32_t, StarCatalogue::kCapacity> claimed_by_{};
  std::uint32_t stamp_ = 0;
};

}  // namespace omma
