#include "ground/design/needed_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "components/geometry/pose.hpp"
#include "ground/design/even_sphere.hpp"

namespace omma::ground {
namespace {

constexpr int kDirections = 20'000;  // 1.4 degrees apart
constexpr int kStarts = 24;          // climbed from, best first
constexpr double kStartStep = 0.02;  // [rad]
constexpr double kLastStep = 1e-8;
constexpr int kRound = 12;  // directions tried about a point

// Climbs to the top nearby. The function has creases, where two cameras see alike, and along a crease only
// few directions lead up: many are tried, and turned each time.
double climb(std::span<const CameraPlace> places, double distance, Eigen::Vector3d& direction) {
  double best = smallest_angle(places, direction, distance);
  double phase = 0;
  for (double step = kStartStep; step > kLastStep;) {
    const Eigen::Matrix<double, 3, 2> basis = tangent_basis(direction);
    Eigen::Vector3d next = direction;
    for (int k = 0; k < kRound; ++k) {
      const double angle = phase + 2 * std::numbers::pi * k / kRound;
      const Eigen::Vector3d trial =
          (direction + step * (basis * Eigen::Vector2d(std::cos(angle), std::sin(angle)))).normalized();
      const double value = smallest_angle(places, trial, distance);
      if (value <= best) continue;
      best = value;
      next = trial;
    }
    if (next == direction) step *= 0.7;
    direction = next;
    phase += 0.37;
  }
  return best;
}

}  // namespace

double smallest_angle(std::span<const CameraPlace> places, const Eigen::Vector3d& direction,
                      double distance) {
  double smallest = std::numbers::pi;
  for (const CameraPlace& place : places) {
    const Eigen::Vector3d to_point =
        std::isinf(distance) ? direction : Eigen::Vector3d(distance * direction - place.centre);
    const double across = to_point.cross(place.axis).norm();
    smallest = std::min(smallest, std::atan2(across, to_point.dot(place.axis)));
  }
  return smallest;
}

NeededField needed_field(std::span<const CameraPlace> places, double distance) {
  std::vector<std::pair<double, Eigen::Vector3d>> starts;
  for (const Eigen::Vector3d& direction : even_directions(kDirections))
    starts.emplace_back(smallest_angle(places, direction, distance), direction);
  std::partial_sort(starts.begin(), starts.begin() + kStarts, starts.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
  NeededField needed;
  for (int k = 0; k < kStarts; ++k) {
    Eigen::Vector3d direction = starts[static_cast<std::size_t>(k)].second;
    const double half = climb(places, distance, direction);
    if (2 * half > needed.field) needed = {2 * half, direction};
  }
  return needed;
}

}  // namespace omma::ground
