// Slopes at the key points from the tridiagonal system of continuous acceleration; pieces in Hermite's form.
#include "components/motion/spline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace omma {
namespace {

void check(std::span<const KeyPoint> points) {
  if (points.size() < 2)
    throw std::invalid_argument("expected at least 2 key points, found " + std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].time) || !std::isfinite(points[i].angle))
      throw std::invalid_argument("key point " + std::to_string(i + 1) + ": expected finite numbers");
    if (i > 0 && points[i].time <= points[i - 1].time)
      throw std::invalid_argument("key point " + std::to_string(i + 1) + ": expected a time after " +
                                  std::to_string(points[i - 1].time) + " s, found " +
                                  std::to_string(points[i].time) + " s");
  }
}

/// The slopes [rad/s] that make the acceleration continuous, 0 at both ends (Thomas' elimination; the system
/// is diagonally dominant).
std::vector<double> slopes(std::span<const KeyPoint> points) {
  const std::size_t n = points.size();
  std::vector<double> slope(n, 0.0);
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = 1 / (points[i].time - points[i - 1].time);
    const double right = 1 / (points[i + 1].time - points[i].time);
    const double side = 3 * (left * left * (points[i].angle - points[i - 1].angle) +
                             right * right * (points[i + 1].angle - points[i].angle));
    const double pivot = 2 * (left + right) - left * upper[i - 1];
    upper[i] = right / pivot;
    slope[i] = (side - left * slope[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) slope[i] -= upper[i] * slope[i + 1];
  return slope;
}

}  // namespace

AxisSpline::AxisSpline(std::span<const KeyPoint> points) {
  check(points);
  const std::vector<double> slope = slopes(points);
  pieces_.reserve(points.size() - 1);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double h = points[i + 1].time - points[i].time;
    const double mean = (points[i + 1].angle - points[i].angle) / h;
    pieces_.push_back({.start = points[i].time,
                       .length = h,
                       .a = points[i].angle,
                       .b = slope[i],
                       .c = (3 * mean - 2 * slope[i] - slope[i + 1]) / h,
                       .d = (slope[i] + slope[i + 1] - 2 * mean) / (h * h)});
  }
}

AxisState AxisSpline::at(double time) const noexcept {
  const Piece& last = pieces_.back();
  if (!(time > pieces_.front().start)) return {pieces_.front().a, 0, 0};
  if (time >= last.start + last.length) return {last.at(last.length).angle, 0, 0};
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), time,
                                     [](double t, const Piece& piece) { return t < piece.start; });
  const Piece& piece = *(next - 1);
  return piece.at(time - piece.start);
}

AxisExtremes AxisSpline::extremes() const noexcept {
  const Piece& first = pieces_.front();
  AxisExtremes result{{first.a, first.start}, {first.a, first.start}, {0, first.start}, {0, first.start}};
  const auto raise = [](Extreme& extreme, double value, double time) {
    if (value > extreme.value) extreme = {value, time};
  };
  for (const Piece& piece : pieces_) {
    const auto visit = [&](double s) {
      if (!(s >= 0 && s <= piece.length)) return;  // also where s is not a number: no such extreme
      const AxisState state = piece.at(s);
      const double time = piece.start + s;
      if (state.angle < result.lowest_angle.value) result.lowest_angle = {state.angle, time};
      raise(result.highest_angle, state.angle, time);
      raise(result.largest_speed, std::abs(state.speed), time);
      raise(result.largest_acceleration, std::abs(state.acceleration), time);
    };
    visit(0);
    visit(piece.length);
    visit(-piece.c / (3 * piece.d));  // no acceleration
    // No speed: b + 2 c s + 3 d s² = 0, by the form that does not cancel.
    const double q =
        -(piece.c + std::copysign(std::sqrt(piece.c * piece.c - 3 * piece.d * piece.b), piece.c));
    visit(q / (3 * piece.d));
    visit(piece.b / q);
  }
  return result;
}

}  // namespace omma
