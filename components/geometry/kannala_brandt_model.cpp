#include "components/geometry/kannala_brandt_model.hpp"

#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr int kScanSteps = 4096;
constexpr int kMaxNewtonSteps = 12;
constexpr double kLastStep = 1e-8;       // [rad]; Newton squares the error of the last step
constexpr double kSlowestGrowth = 1e-3;  // dr/dθ is 1 on the axis; below this the fold begins

}  // namespace

KannalaBrandtModel::Value KannalaBrandtModel::evaluate(double theta) const noexcept {
  const double t2 = theta * theta;
  const double radius = theta * (1 + t2 * (k_[0] + t2 * (k_[1] + t2 * (k_[2] + t2 * k_[3]))));
  const double slope = 1 + t2 * (3 * k_[0] + t2 * (5 * k_[1] + t2 * (7 * k_[2] + t2 * 9 * k_[3])));
  return {radius, slope};
}

double KannalaBrandtModel::angle_limit(double max_angle, double plane_radius) const noexcept {
  const auto valid = [&](double theta) {
    const Value v = evaluate(theta);
    return v.slope > kSlowestGrowth && v.radius <= plane_radius;
  };
  double good = 0;
  for (int i = 1; i <= kScanSteps; ++i) {
    double bad = max_angle * i / kScanSteps;
    if (valid(bad)) {
      good = bad;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (good + bad);
      (valid(middle) ? good : bad) = middle;
    }
    break;
  }
  return good;
}

KannalaBrandtModel::KannalaBrandtModel(const Coefficients& k, double max_angle, double plane_radius) : k_(k) {
  max_angle_ = angle_limit(std::min(max_angle, std::numbers::pi), plane_radius);
  max_radius_ = evaluate(max_angle_).radius;
  double theta = 0;
  angle_ = MonotoneTable(max_radius_, [&](double radius, double& value, double& slope) {
    double low = theta;  // the nodes come in rising order
    double high = max_angle_;
    for (int i = 0; i < 80; ++i) {
      theta = 0.5 * (low + high);
      (evaluate(theta).radius < radius ? low : high) = theta;
    }
    value = theta;
    slope = 1.0 / evaluate(theta).slope;
  });
}

bool KannalaBrandtModel::ray_from_plane(const Eigen::Vector2d& plane, Eigen::Vector3d& ray,
                                        Eigen::Matrix<double, 3, 2>* jacobian) const noexcept {
  const double r = plane.norm();
  if (!(r <= max_radius_)) return false;
  double theta = angle_(r);
  double slope = 1;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const Value v = evaluate(theta);
    slope = v.slope;
    const double step = (r - v.radius) / slope;
    theta += step;
    if (std::abs(step) < kLastStep) break;
  }
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  const double s = r > 0 ? sine / r : 1.0;
  ray << s * plane, cosine;
  if (jacobian != nullptr) {
    const Eigen::Vector2d outward = r > 0 ? Eigen::Vector2d(plane / r) : Eigen::Vector2d::Zero();
    *jacobian << s * Eigen::Matrix2d::Identity() + (cosine / slope - s) * outward * outward.transpose(),
        -sine / slope * outward.transpose();
  }
  return true;
}

bool KannalaBrandtModel::plane_from_ray(const Eigen::Vector3d& direction, Eigen::Vector2d& plane,
                                        Eigen::Matrix<double, 2, 3>* jacobian) const noexcept {
  const double z = direction.z();
  const double h = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  const double theta = std::atan2(h, z);
  if (!(theta <= max_angle_) || (h == 0 && z <= 0)) return false;
  const Value v = evaluate(theta);
  const double q = h > 0 ? v.radius / h : 1.0 / z;
  plane = q * direction.head<2>();
  if (jacobian != nullptr) {
    const Eigen::Vector2d across = h > 0 ? Eigen::Vector2d(direction.head<2>() / h) : Eigen::Vector2d::Zero();
    const double by_angle =
        v.slope / (h * h + z * z);  // dr/dθ over the squared length: dθ = (z dh − h dz)/n²
    *jacobian << q * Eigen::Matrix2d::Identity() + (z * by_angle - q) * across * across.transpose(),
        -h * by_angle * across;
  }
  return true;
}

}  // namespace omma
