#include "sim/ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/catalogue/apparent_place.hpp"

namespace omma::sim {

double Ground::transmission(double cos_zenith) const {
  const double elevation = std::asin(std::clamp(cos_zenith, -1.0, 1.0));
  if (elevation < skyline) return 0;
  return std::pow(10.0, -0.4 * extinction * airmass(elevation));
}

Eigen::Vector3d Ground::apparent(const Eigen::Vector3d& direction, const Eigen::Vector3d& zenith) const {
  if (!refracts) return direction;
  constexpr double kLowest = -std::numbers::pi / 180;  // where the formula ends
  const double sine = std::clamp(direction.dot(zenith), -1.0, 1.0);
  const Eigen::Vector3d level = direction - sine * zenith;
  const double length = level.norm();
  if (length < 1e-9) return direction;
  const double altitude = std::asin(sine);
  // What is below keeps its distance from what is just above.
  const double seen = altitude + refraction(std::max(altitude, kLowest), pressure, temperature);
  return (level * (std::cos(seen) / length) + zenith * std::sin(seen)).normalized();
}

double Ground::airmass(double elevation) {
  const double degrees = std::max(0.0, elevation) * 180 / std::numbers::pi;
  return 1 / (std::sin(std::max(0.0, elevation)) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
}

}  // namespace omma::sim
