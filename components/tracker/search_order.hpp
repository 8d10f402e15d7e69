// Search order: the dots in the order in which identification looks at them, and which stars each may be.
// Brightness is used softly: the order within each camera (photographs saturate, lenses vignette, cameras
// differ); where dots are few, sparse_sky.hpp looks at the flux too.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "components/geometry/rig_dot.hpp"
#include "components/tracker/search_dot.hpp"
#include "components/tracker/sky_coverage.hpp"

namespace omma {

enum class DotOrder : std::uint8_t {
  kBrightness,  ///< the n-th brightest dot of a camera is about the n-th brightest star it sees
  kSpread,      ///< dots that outshine their surroundings first: for lights, trees and text in clusters
};

class SearchOrder {
 public:
  static constexpr std::size_t kCapacity = limits::kDotsPerCamera * limits::kCameras;

  /// @param stars     in the catalogue
  /// @param widening  factor on every dot's sigma
  /// @return the dots to search with, best first
  std::span<const SearchDot> arrange(std::span<const RigDot> dots, const SkyCoverage& coverage,
                                     std::size_t stars, DotOrder order, double widening) noexcept;

 private:
  struct Key {
    float place;  // smaller: earlier
    std::uint16_t dot;
    std::uint16_t faintest;
  };
  StaticVector<std::uint16_t, kCapacity> by_camera_;  // dots grouped by camera, brightest first
  StaticVector<Key, kCapacity> keys_;
  StaticVector<SearchDot, kCapacity> arranged_;
};

}  // namespace omma
