// SearchDot: a dot as star identification uses it.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace omma {

/// In the order of the search: the likeliest bright stars first.
struct SearchDot {
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();  ///< unit bearing, rig frame
  double variance = 0;                             ///< of the bearing, per axis [rad²]
  float magnitude = 0;                             ///< of its flux; each camera has its own zero
  std::uint16_t faintest = 0;                      ///< it may be one of the stars with an index below this
  std::uint16_t index = 0;                         ///< in the caller's span
  std::uint8_t camera = 0;
};

struct EvidenceMatch {
  std::uint16_t search_dot;
  std::uint16_t star;  ///< index in StarCatalogue::stars()
};

}  // namespace omma
