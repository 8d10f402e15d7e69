#include "components/tracker/assignment.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/geometry/root_sum_square.hpp"

namespace omma {

void Assigner::offer(Best& best, Best& second, float distance2, float weight, std::uint16_t index) noexcept {
  if (distance2 < best.distance2) {
    second = best;
    best = {distance2, weight, index};
  } else if (distance2 < second.distance2) {
    second = {distance2, weight, index};
  }
}

namespace {

// Largest standard deviation of a 2×2 covariance.
double largest_sigma(const Eigen::Matrix2d& c) {
  const double half_trace = 0.5 * (c(0, 0) + c(1, 1));
  const double half_difference = 0.5 * (c(0, 0) - c(1, 1));
  return std::sqrt(half_trace + root_sum_square(half_difference, c(0, 1)));
}

double mahalanobis2(const Eigen::Vector2d& d, const Eigen::Matrix2d& c) {
  const double determinant = c(0, 0) * c(1, 1) - c(0, 1) * c(1, 0);
  return (c(1, 1) * d.x() * d.x() - 2 * c(0, 1) * d.x() * d.y() + c(0, 0) * d.y() * d.y()) / determinant;
}

}  // namespace

double chance_pairs(std::span<const PredictedPoint> predictions, const DotList& dots,
                    const AssignmentGate& gate, int width, int height) noexcept {
  if (dots.dots.empty() || predictions.empty()) return 0;
  // However badly a dot is placed, it makes no more than one pair.
  const double largest = static_cast<double>(width) * static_cast<double>(height) /
                         (std::numbers::pi * gate.chi2 * static_cast<double>(predictions.size()));
  double variance = 0;
  for (const Dot& dot : dots.dots) variance += std::min(0.5 * dot.covariance.trace(), largest);
  variance = variance / static_cast<double>(dots.dots.size()) + gate.floor_px * gate.floor_px;
  double area = 0;
  for (const PredictedPoint& point : predictions) {
    const Eigen::Vector2d& at = point.pixel;
    if (at.x() < 0 || at.y() < 0 || at.x() > width - 1 || at.y() > height - 1) continue;
    const Eigen::Matrix2d s = point.covariance + variance * Eigen::Matrix2d::Identity();
    area += std::sqrt(s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0));
  }
  const double density =
      static_cast<double>(dots.dots.size()) / (static_cast<double>(width) * static_cast<double>(height));
  return std::numbers::pi * gate.chi2 * area * density;
}

bool beyond_chance(std::size_t pairs, double chance, int least) noexcept {
  return static_cast<double>(pairs) >= chance + 6 * std::sqrt(chance) + least;
}

std::span<const Assignment> Assigner::assign(std::span<const PredictedPoint> predictions, const DotList& dots,
                                             const DotGrid& grid, const AssignmentGate& gate,
                                             std::span<const std::uint8_t> taken) noexcept {
  const std::size_t count = std::min(predictions.size(), kPredictions);
  dot_of_prediction_.resize(count);
  second_dot_of_prediction_.resize(count);
  prediction_of_dot_.resize(dots.dots.size());
  second_prediction_of_dot_.resize(dots.dots.size());
  for (auto* list : {&dot_of_prediction_, &second_dot_of_prediction_}) {
    for (Best& best : *list) best.reset();
  }
  for (auto* list : {&prediction_of_dot_, &second_prediction_of_dot_}) {
    for (Best& best : *list) best.reset();
  }
  assignments_.clear();

  const Eigen::Matrix2d floor = gate.floor_px * gate.floor_px * Eigen::Matrix2d::Identity();
  for (std::size_t i = 0; i < count; ++i) {
    const PredictedPoint& point = predictions[i];
    // A dot's own standard deviation is a pixel at most where it is worth pairing.
    const double radius = std::sqrt(gate.chi2) * (largest_sigma(point.covariance + floor) + 1.0);
    grid.near(point.pixel, radius, [&](std::uint16_t d) {
      if (!taken.empty() && taken[d] != 0) return;
      const Dot& dot = dots.dots[d];
      const double distance2 =
          mahalanobis2(dot.pixel - point.pixel, point.covariance + dot.covariance + floor);
      // Rivals are looked for a little beyond the gate, so that a pair at its edge is not taken for the only
      // one.
      if (distance2 > gate.chi2 + gate.ambiguity) return;
      const auto d2 = static_cast<float>(distance2);
      offer(dot_of_prediction_[i], second_dot_of_prediction_[i], d2, dot.flux, d);
      offer(prediction_of_dot_[d], second_prediction_of_dot_[d], d2, point.weight,
            static_cast<std::uint16_t>(i));
    });
  }

  const auto ambiguous = [&](const Best& best, const Best& second) {
    return second.distance2 - best.distance2 < gate.ambiguity && best.weight < gate.dominance * second.weight;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Best& dot = dot_of_prediction_[i];
    if (dot.distance2 > gate.chi2) continue;
    const Best& back = prediction_of_dot_[dot.index];
    if (back.index != i) continue;
    if (ambiguous(dot, second_dot_of_prediction_[i])) continue;
    if (ambiguous(back, second_prediction_of_dot_[dot.index])) continue;
    if (!assignments_.push_back({static_cast<std::uint16_t>(i), dot.index, dot.distance2})) break;
  }
  return assignments_;
}

}  // namespace omma
