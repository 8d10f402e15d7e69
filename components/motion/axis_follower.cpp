#include "components/motion/axis_follower.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// Braking is planned with this part of the largest acceleration; the goal's own acceleration needs the rest.
constexpr double kBrakingShare = 0.5;
// A goal missed by no more than this part of what the largest acceleration moves in a period is reached.
constexpr double kReached = 0.1;

}  // namespace

AxisState follow(const AxisState& now, const AxisState& goal, const AxisLimits& limits, double dt) noexcept {
  const double most = limits.acceleration * dt;  // change of speed in a period
  const double relative_speed = now.speed - goal.speed;
  // What is left of the way when the relative speed falls to 0 within this period.
  const double left = goal.angle - now.angle - 0.5 * dt * (now.speed + goal.speed);
  if (std::abs(left) <= kReached * most * dt && std::abs(relative_speed) <= most * (1 + kReached))
    return goal;

  // The relative speed w at the end of the period, from which braking at a takes the whole rest:
  // w²/(2a) = |left| − w dt/2.
  const double a = kBrakingShare * limits.acceleration;
  const double w = -0.5 * a * dt + std::sqrt(0.25 * a * a * dt * dt + 2 * a * std::abs(left));
  double speed = goal.speed + std::copysign(w, left);
  speed = std::clamp(speed, -limits.speed, limits.speed);
  speed = std::clamp(speed, now.speed - most, now.speed + most);
  const double angle = now.angle + 0.5 * dt * (now.speed + speed);
  return {std::clamp(angle, limits.lowest_angle, limits.highest_angle), speed, (speed - now.speed) / dt};
}

}  // namespace omma
