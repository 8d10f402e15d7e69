#include "components/catalogue/orbit.hpp"

#include <cmath>
#include <numbers>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

/// E of M = E − e sin E, by Newton's method from a start that always converges (Vallado, algorithm 2).
double eccentric_anomaly(double mean, double e) {
  mean = std::remainder(mean, 2 * std::numbers::pi);
  double anomaly = mean < 0 ? mean - e : mean + e;
  for (int step = 0; step < 30; ++step) {
    const double change = (mean - anomaly + e * std::sin(anomaly)) / (1 - e * std::cos(anomaly));
    anomaly += change;
    if (std::abs(change) < 1e-15) break;
  }
  return anomaly;
}

}  // namespace

OrbitElements elements_through(const OrbitState& state, bool j2) {
  constexpr double kNone = 1e-11;
  const Eigen::Vector3d& r = state.position;
  const Eigen::Vector3d& v = state.velocity;
  const Eigen::Vector3d normal = r.cross(v).normalized();
  const Eigen::Vector3d to_perigee =
      (v.squaredNorm() / kEarthGravity - 1 / r.norm()) * r - r.dot(v) / kEarthGravity * v;
  Eigen::Vector3d node = Eigen::Vector3d::UnitZ().cross(normal);
  node = node.norm() < kNone ? Eigen::Vector3d::UnitX() : node.normalized();
  const auto angle_from = [&](const Eigen::Vector3d& axis, const Eigen::Vector3d& to) {
    return std::atan2(normal.dot(axis.cross(to)), axis.dot(to));
  };
  OrbitElements elements;
  elements.j2 = j2;
  elements.semi_major_axis = 1 / (2 / r.norm() - v.squaredNorm() / kEarthGravity);
  elements.eccentricity = to_perigee.norm();
  elements.inclination = std::atan2(root_sum_square(normal.x(), normal.y()), normal.z());
  elements.ascending_node = std::atan2(node.y(), node.x());
  const Eigen::Vector3d perigee = elements.eccentricity < kNone ? node : to_perigee.normalized();
  elements.argument_of_perigee = angle_from(node, perigee);
  elements.true_anomaly = angle_from(perigee, r);
  return elements;
}

Orbit::Orbit(const OrbitElements& elements) : elements_(elements) {
  const double e = elements.eccentricity;
  const double half = std::sqrt((1 - e) / (1 + e)) * std::tan(0.5 * elements.true_anomaly);
  const double anomaly = 2 * std::atan(half);
  mean_anomaly_ = anomaly - e * std::sin(anomaly);
  const double a = elements.semi_major_axis;
  const double motion = std::sqrt(kEarthGravity / (a * a * a));
  anomaly_rate_ = motion;
  if (!elements.j2) return;
  const double p = a * (1 - e * e);
  const double drift = 1.5 * kEarthJ2 * std::pow(kEarthRadius / p, 2) * motion;
  const double sine2 = std::pow(std::sin(elements.inclination), 2);
  node_rate_ = -drift * std::cos(elements.inclination);
  perigee_rate_ = drift * (2 - 2.5 * sine2);
  anomaly_rate_ += drift * std::sqrt(1 - e * e) * (1 - 1.5 * sine2);
}

double Orbit::period() const {
  return 2 * std::numbers::pi / anomaly_rate_;
}

OrbitState Orbit::at(double time) const {
  const double e = elements_.eccentricity;
  const double a = elements_.semi_major_axis;
  const double anomaly = eccentric_anomaly(mean_anomaly_ + anomaly_rate_ * time, e);
  const double flat = std::sqrt(1 - e * e);
  const double anomaly_speed = anomaly_rate_ / (1 - e * std::cos(anomaly));
  // In the orbit's plane, x to the perigee.
  const Eigen::Vector3d position(a * (std::cos(anomaly) - e), a * flat * std::sin(anomaly), 0);
  const Eigen::Vector3d velocity =
      a * anomaly_speed * Eigen::Vector3d(-std::sin(anomaly), flat * std::cos(anomaly), 0);
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Eigen::Quaterniond j2000_from_plane =
      AngleAxisd(elements_.ascending_node + node_rate_ * time, Vector3d::UnitZ()) *
      AngleAxisd(elements_.inclination, Vector3d::UnitX()) *
      AngleAxisd(elements_.argument_of_perigee + perigee_rate_ * time, Vector3d::UnitZ());
  OrbitState state;
  state.position = j2000_from_plane * position;
  // The plane itself turns: its node about the Earth's axis, the perigee about its normal.
  state.velocity = j2000_from_plane * (velocity + perigee_rate_ * Vector3d::UnitZ().cross(position)) +
                   node_rate_ * Vector3d::UnitZ().cross(state.position);
  return state;
}

Eigen::Quaterniond orbit_axes(const OrbitState& state) {
  Eigen::Matrix3d axes;
  axes.col(2) = -state.position.normalized();
  axes.col(1) = -state.position.cross(state.velocity).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return Eigen::Quaterniond(axes);
}

Eigen::Vector3d orbit_axes_rate(const OrbitState& state) {
  return {0, -state.position.cross(state.velocity).norm() / state.position.squaredNorm(), 0};
}

}  // namespace omma
