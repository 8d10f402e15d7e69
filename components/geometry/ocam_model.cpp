#include "components/geometry/ocam_model.hpp"

#include <cmath>

namespace omma {
namespace {

constexpr int kFoldScanSteps = 4096;
constexpr int kMaxNewtonSteps = 12;
// A step below this [px] is the last: Newton squares the error, what remains is below 1e-12 px.
constexpr double kLastStep = 1e-6;
// The model ends where the angle grows this much slower with the radius than on the axis: beyond lies the
// fold.
constexpr double kSlowestGrowth = 1e-3;

/// Grows with the angle off axis from 0 (on axis) over 1 (90°) to 2 (180°), without a transcendental
/// function: h is the length of the direction's part across the axis, z the part along it.
double pseudo_angle(double h, double z) {
  return 1.0 - z / (h + std::abs(z));
}

}  // namespace

OcamModel::Value OcamModel::evaluate(double rho) const noexcept {
  double f = 0;
  double slope = 0;
  for (std::size_t i = count_; i-- > 0;) {
    slope = slope * rho + f;
    f = f * rho + coefficients_[i];
  }
  return {f, slope};
}

// The angle off axis θ = atan2(ρ, F) grows while dθ/dρ = (F − ρF') / (ρ² + F²) > 0.
double OcamModel::radius_at_fold(double plane_radius) const noexcept {
  const double least = kSlowestGrowth / coefficients_[0];
  const auto grows = [&](double rho) {
    const Value v = evaluate(rho);
    return (v.f - rho * v.slope) > least * (rho * rho + v.f * v.f);
  };
  double good = 0;
  for (int i = 1; i <= kFoldScanSteps; ++i) {
    double bad = plane_radius * i / kFoldScanSteps;
    if (grows(bad)) {
      good = bad;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (good + bad);
      (grows(middle) ? good : bad) = middle;
    }
    break;
  }
  return good;
}

OcamModel::OcamModel(std::span<const double> polynomial, double plane_radius)
    : count_(std::min(polynomial.size(), kMaxCoefficients)) {
  std::copy_n(polynomial.begin(), count_, coefficients_.begin());
  max_radius_ = radius_at_fold(plane_radius);
  const Value end = evaluate(max_radius_);
  max_angle_ = std::atan2(max_radius_, end.f);
  double rho = 0;
  radius_ = MonotoneTable(pseudo_angle(max_radius_, end.f), [&](double pseudo, double& value, double& slope) {
    double low = rho;  // the nodes come in rising order
    double high = max_radius_;
    for (int k = 0; k < 80; ++k) {
      rho = 0.5 * (low + high);
      (pseudo_angle(rho, evaluate(rho).f) < pseudo ? low : high) = rho;
    }
    const Value v = evaluate(rho);
    const double sum = rho + std::abs(v.f);  // dθ/dp = (h + |z|)² / (h² + z²), dρ/dθ as above
    value = rho;
    slope = sum * sum / (v.f - rho * v.slope);
  });
}

bool OcamModel::ray_from_plane(const Eigen::Vector2d& plane, Eigen::Vector3d& ray,
                               Eigen::Matrix<double, 3, 2>* jacobian) const noexcept {
  const double rho = plane.norm();
  if (!(rho <= max_radius_)) return false;
  const Value v = evaluate(rho);
  const double inverse_length = 1.0 / std::sqrt(rho * rho + v.f * v.f);
  ray = Eigen::Vector3d(plane.x(), plane.y(), v.f) * inverse_length;
  if (jacobian != nullptr) {
    const Eigen::Vector2d outward = rho > 0 ? Eigen::Vector2d(plane / rho) : Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 3, 2> unnormalised;
    unnormalised << Eigen::Matrix2d::Identity(), v.slope * outward.transpose();
    *jacobian = inverse_length * (unnormalised - ray * (ray.transpose() * unnormalised));
  }
  return true;
}

// Solves h F(ρ) = Z ρ for ρ, h = |X, Y|. With q = ρ/h and D = Z − hF' (positive up to the fold):
// (x, y) = q (X, Y), ∂q/∂h = q F'/D, ∂q/∂Z = −q/D.
bool OcamModel::plane_from_ray(const Eigen::Vector3d& direction, Eigen::Vector2d& plane,
                               Eigen::Matrix<double, 2, 3>* jacobian) const noexcept {
  const double z = direction.z();
  const double h = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  const double pseudo = pseudo_angle(h, z);
  if (!(pseudo <= radius_.end())) return false;  // also a direction of zero length or not a number

  double rho = radius_(pseudo);
  double f = 0;
  double slope = 0;
  double d = 0;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const Value v = evaluate(rho);
    slope = v.slope;
    d = z - h * slope;
    const double step = (h * v.f - z * rho) / d;
    rho += step;
    f = v.f + slope * step;
    if (std::abs(step) < kLastStep) break;
  }
  const double q = z > h ? f / z : rho / h;  // both are the same number; each is exact where it is used
  plane = q * direction.head<2>();
  if (jacobian != nullptr) {
    const Eigen::Vector2d across = h > 0 ? Eigen::Vector2d(direction.head<2>() / h) : Eigen::Vector2d::Zero();
    *jacobian << Eigen::Matrix2d::Identity() + plane / q * (slope / d) * across.transpose(), -plane / q / d;
    *jacobian *= q;
  }
  return true;
}

}  // namespace omma
