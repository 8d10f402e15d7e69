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
#include "fsw/kernel/static_vector.hpp"

namespace omma {

/// A dot as identification uses it. In the order of the search: the likeliest bright stars first.
struct SearchDot {
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();  ///< unit bearing, rig frame
  double variance = 0;                             ///< of the bearing, per axis [rad²]
  std::uint16_t faintest = 0;                      ///< it may be one of the stars with an index below this
  std::uint16_t index = 0;                         ///< in the caller's span
  std::uint8_t camera = 0;
};

struct EvidenceMatch {
  std::uint16_t search_dot;
  std::uint16_t star;  ///< index in StarCatalogue::stars()
};

class SkyEvidence {
 public:
  static constexpr std::size_t kDots = 96;  ///< examined for one hypothesis, at most

  /// @param catalogue  must outlive this
  explicit SkyEvidence(const StarCatalogue& catalogue) : catalogue_(catalogue) {}

  /// The two dots that the next hypotheses rest on; they fix how well an attitude made from them predicts the
  /// others.
  void rest_on(std::span<const SearchDot> dots, std::size_t first, std::size_t second) noexcept;

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

  const StarCatalogue& catalogue_;
  std::span<const SearchDot> dots_;
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
