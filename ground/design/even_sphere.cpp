#include "ground/design/even_sphere.hpp"

#include <cmath>
#include <numbers>

namespace omma::ground {

std::vector<Eigen::Vector3d> even_directions(int count) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count;
    const double across = std::sqrt(1 - z * z);
    const double angle = 2 * std::numbers::pi * k / std::numbers::phi;
    directions.emplace_back(across * std::cos(angle), across * std::sin(angle), z);
  }
  return directions;
}

std::vector<Eigen::Quaterniond> even_attitudes(int count) {
  constexpr double kPsi = 1.533751168755204288118041;  // ψ⁴ = ψ + 4
  std::vector<Eigen::Quaterniond> attitudes;
  attitudes.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double s = k + 0.5;
    const double inner = std::sqrt(s / count);
    const double outer = std::sqrt(1 - s / count);
    const double a = 2 * std::numbers::pi * s / std::numbers::sqrt2;
    const double b = 2 * std::numbers::pi * s / kPsi;
    attitudes.emplace_back(outer * std::sin(b), inner * std::sin(a), inner * std::cos(a),
                           outer * std::cos(b));
  }
  return attitudes;
}

}  // namespace omma::ground
