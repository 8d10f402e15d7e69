// Star matching: from a hypothesis that was accepted to the final attitude and all dots it explains: match,
// solve Wahba's problem, match again with the better attitude, until nothing changes.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>

#include "components/catalogue/star_catalogue.hpp"
#include "components/estimation/wahba.hpp"
#include "components/tracker/sky_evidence.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct StarMatch {
  std::uint16_t dot = 0;   ///< index in the caller's dots
  std::uint16_t star = 0;  ///< index in StarCatalogue::stars()
  std::uint16_t hr = 0;
  float sigmas = 0;  ///< distance over its standard deviation
};

class StarMatching {
 public:
  /// @param catalogue  must outlive this
  explicit StarMatching(const StarCatalogue& catalogue) : catalogue_(catalogue) {}

  struct Result {
    bool consistent = false;  ///< enough of the dots that proved the hypothesis are still on their stars
    WahbaSolution attitude;
    double rms = 0;  ///< [rad]
  };

  /// @param seeds  the matches that the hypothesis was accepted for
  /// @param matches  the brightest kStarPairs of the dots that are on stars, best first in the search order;
  ///                 untouched unless consistent
  Result refine(std::span<const SearchDot> dots, std::span<const EvidenceMatch> seeds,
                StaticVector<StarMatch, limits::kStarPairs>& matches) noexcept;

 private:
  void match(std::span<const SearchDot> dots, const WahbaSolution& attitude) noexcept;
  WahbaSolution solve(std::span<const SearchDot> dots) const noexcept;
  bool still_there(std::span<const EvidenceMatch> seeds) const noexcept;

  static constexpr std::size_t kDots = limits::kDotsPerCamera * limits::kCameras;
  struct Candidate {
    float sigmas;
    std::uint16_t search_dot;
    std::uint16_t star;
  };
  const StarCatalogue& catalogue_;
  StaticVector<Candidate, 2 * kDots> candidates_;
  StaticVector<Candidate, kDots> pairs_;  // one to one
  std::array<bool, StarCatalogue::kCapacity> star_taken_{};
  std::array<bool, kDots> dot_taken_{};
};

}  // namespace omma
