// The trajectory of one axis: a cubic spline through key points, at rest at both ends.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace omma {

struct KeyPoint {
  double time = 0;   ///< [s]
  double angle = 0;  ///< [rad]
};

/// Where an axis is, and how it moves.
struct AxisState {
  double angle = 0;         ///< [rad]
  double speed = 0;         ///< [rad/s]
  double acceleration = 0;  ///< [rad/s²]
};

/// A value and when it is reached.
struct Extreme {
  double value = 0;
  double time = 0;  ///< [s]
};

/// What a trajectory asks of its axis at most, over all times and not only at samples.
struct AxisExtremes {
  Extreme lowest_angle;          ///< [rad]
  Extreme highest_angle;         ///< [rad]
  Extreme largest_speed;         ///< magnitude [rad/s]
  Extreme largest_acceleration;  ///< magnitude [rad/s²]
};

class AxisSpline {
 public:
  /// Angle, speed and acceleration are continuous; the speed is 0 at the first and last key point. (Clamped
  /// cubic spline: de Boor, A Practical Guide to Splines, 1978, chapter IV.)
  /// @throws std::invalid_argument: fewer than two points, times that do not increase, a value not finite
  explicit AxisSpline(std::span<const KeyPoint> points);

  /// At `time` [s]; before the first and after the last key point the axis rests there. Never allocates.
  AxisState at(double time) const noexcept;
  AxisExtremes extremes() const noexcept;
  double first_time() const noexcept { return pieces_.front().start; }                        ///< [s]
  double last_time() const noexcept { return pieces_.back().start + pieces_.back().length; }  ///< [s]

 private:
  /// angle(s) = a + b s + c s² + d s³, s from the start of the piece
  struct Piece {
    double start = 0, length = 0;
    double a = 0, b = 0, c = 0, d = 0;
    AxisState at(double s) const noexcept {
      return {a + s * (b + s * (c + s * d)), b + s * (2 * c + s * 3 * d), 2 * c + 6 * d * s};
    }
  };
  std::vector<Piece> pieces_;
};

}  // namespace omma
