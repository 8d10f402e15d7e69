#include "sim/disc_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {
namespace {

struct Node {
  double position;  // in (0, 1)
  double weight;    // sum 1
};

// Roots of the Legendre polynomial P_n by Newton's method from Tricomi's estimate, mapped to (0, 1).
std::vector<Node> gauss_legendre(int n) {
  std::vector<Node> nodes(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      double before = 1;
      double value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes[static_cast<std::size_t>(i)] = {0.5 * (1 + x), 1.0 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

std::vector<QuadraturePoint> rule_of(int rings) {
  std::vector<QuadraturePoint> points;
  double sum = 0;
  for (const Node& node : gauss_legendre(rings)) {
    // As dense along the ring as the rings are to each other, and never fewer than six.
    const int count = std::max(6, static_cast<int>(std::ceil(2 * std::numbers::pi * node.position * rings)));
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / count;
      const double weight = 2 * node.position * node.weight / count;
      points.push_back({node.position * Eigen::Vector2d(std::cos(angle), std::sin(angle)), weight});
      sum += weight;
    }
  }
  for (QuadraturePoint& point : points) point.weight /= sum;
  return points;
}

}  // namespace

DiscQuadrature::DiscQuadrature() : rules_(kFinest + 1) {
  for (int rings = 2; rings <= kFinest; ++rings) rules_[static_cast<std::size_t>(rings)] = rule_of(rings);
}

const std::vector<QuadraturePoint>& DiscQuadrature::rule(double radius_in_sigmas) const {
  const double rings = std::clamp(2.0 + radius_in_sigmas / 0.9, 2.0, static_cast<double>(kFinest));
  return rules_[static_cast<std::size_t>(std::ceil(rings))];
}

}  // namespace omma::sim
