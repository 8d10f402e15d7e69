// Spot: the image of one star, target, Moon or Sun in one camera, as the points of light it is drawn with.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "components/catalogue/solar_system.hpp"
#include "sim/point_spread.hpp"

namespace omma::sim {

enum class SpotKind : std::uint8_t { kStar, kTarget, kMoon, kSun, kPlanet };

struct Spot {
  SpotKind kind = SpotKind::kStar;
  std::uint16_t hr = 0;  ///< star: number in the Bright Star Catalogue
  SolarBody planet = SolarBody::kVenus;
  std::uint16_t card = 0;    ///< target: index in Scenario::cards
  std::uint16_t target = 0;  ///< target: index in the card's body
  /// Image of the star, or of the disc's centre, at the exposure midpoint [px]. Perspective and the lens put
  /// it beside the centroid of the disc's image: this is the truth, not that.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  std::size_t first_point = 0;  ///< in SpotList::points
  std::size_t points = 0;
};

struct SpotList {
  std::vector<Spot> spots;
  std::vector<PointSource> points;

  void clear() {
    spots.clear();
    points.clear();
  }
  std::span<const PointSource> points_of(const Spot& spot) const {
    return {points.data() + spot.first_point, spot.points};
  }
  /// Appends a spot of the points added since `first`; nothing where there are none.
  void close(Spot spot, std::size_t first) {
    if (points.size() == first) return;
    spot.first_point = first;
    spot.points = points.size() - first;
    spots.push_back(spot);
  }
};

}  // namespace omma::sim
