// Pairs of bright stars by the angle between them: the database of star identification. Up to 180°, so pairs
// may span cameras. Source of the idea: Mortari's k-vector and pyramid (J. Astronautical Sciences 45, 1997;
// Navigation 51, 2004); a sorted table with binary search does the same work here.
#pragma once

#include <cstdint>
#include <span>

#include "components/catalogue/star_catalogue.hpp"
#include "components/tracker/sky_coverage.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct StarPair {
  float angle;          ///< [rad]
  std::uint16_t first;  ///< index in StarCatalogue::stars(), the brighter
  std::uint16_t second;
};

class StarPairs {
 public:
  static constexpr std::size_t kCapacity = 131072;

  /// Chooses stars that are bright and spread evenly (so that every field of view holds some), as many as the
  /// table has room for, and sorts their pairs by angle.
  void build(const StarCatalogue& catalogue, const SkyCoverage& coverage) noexcept;

  /// Pairs with an angle in [low, high] [rad].
  std::span<const StarPair> between(double low, double high) const noexcept;

  std::size_t stars() const { return star_count_; }
  std::size_t size() const { return pairs_.size(); }
  double largest_angle() const { return largest_angle_; }  ///< of a pair in the table [rad]

 private:
  /// Brightest first, at most `most_within` in a cap of `radius` [rad]; false where more than `wanted` would
  /// be chosen.
  bool choose_stars(const StarCatalogue& catalogue, std::size_t wanted, double radius,
                    std::size_t most_within) noexcept;

  StaticVector<StarPair, kCapacity> pairs_;
  StaticVector<std::uint16_t, StarCatalogue::kCapacity> chosen_;
  std::size_t star_count_ = 0;
  double largest_angle_ = 0;
};

}  // namespace omma
