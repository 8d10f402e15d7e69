#include "components/geometry/caltech_model.hpp"

#include <cmath>
#include <numbers>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr int kScanSteps = 2048;
constexpr int kScanDirections = 32;
constexpr int kMaxNewtonSteps = 20;
constexpr double kLastStep = 1e-10;      // [focal lengths]; Newton squares the error of the last step
constexpr double kSlowestGrowth = 1e-3;  // 1 on the axis; below this the fold begins
constexpr double kWidestAngle = 1.5533;  // 89°: a pinhole sees less than 90° off axis

}  // namespace

// Bouguet: x_d = (1 + k1 r² + k2 r⁴ + k3 r⁶) x + (2 p1 x y + p2 (r² + 2x²), p1 (r² + 2y²) + 2 p2 x y).
Eigen::Vector2d CaltechModel::distort(const Eigen::Vector2d& point,
                                      Eigen::Matrix2d& jacobian) const noexcept {
  const auto [k1, k2, p1, p2, k3] = kc_;
  const double x = point.x();
  const double y = point.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double radial_slope =
      2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // d radial = radial_slope (x dx + y dy)
  const double mixed = radial_slope * x * y + 2 * (p1 * x + p2 * y);
  jacobian << radial + radial_slope * x * x + 2 * p1 * y + 6 * p2 * x, mixed,  //
      mixed, radial + radial_slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return {radial * x + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          radial * y + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

// The distortion is one to one on a disc where its (symmetric) Jacobian is positive definite, so the model
// ends at the first circle where it is not, or where the whole circle has left the image.
double CaltechModel::radius_limit(double plane_radius) const noexcept {
  double good = 0;
  for (int i = 1; i <= kScanSteps; ++i) {
    const double r = std::tan(kWidestAngle * i / kScanSteps);
    bool outside = true;
    for (int k = 0; k < kScanDirections; ++k) {
      const double angle = 2 * std::numbers::pi * k / kScanDirections;
      Eigen::Matrix2d j;
      const Eigen::Vector2d seen = distort({r * std::cos(angle), r * std::sin(angle)}, j);
      const double least_eigenvalue =
          0.5 * (j(0, 0) + j(1, 1)) - root_sum_square(0.5 * (j(0, 0) - j(1, 1)), j(0, 1));
      if (!(least_eigenvalue > kSlowestGrowth)) return good;
      outside = outside && seen.norm() > plane_radius;
    }
    good = r;
    if (outside) break;
  }
  return good;
}

CaltechModel::CaltechModel(const Coefficients& kc, double plane_radius) : kc_(kc) {
  max_radius_ = radius_limit(plane_radius);
  max_angle_ = std::atan(max_radius_);
  const auto radial = [&](double r, double& slope) {
    const double r2 = r * r;
    slope = 1 + r2 * (3 * kc_[0] + r2 * (5 * kc_[1] + r2 * 7 * kc_[4]));
    return r * (1 + r2 * (kc_[0] + r2 * (kc_[1] + r2 * kc_[4])));
  };
  double slope = 0;
  double r = 0;
  radius_ = MonotoneTable(radial(max_radius_, slope), [&](double seen, double& value, double& value_slope) {
    double low = r;  // the nodes come in rising order
    double high = max_radius_;
    for (int i = 0; i < 80; ++i) {
      r = 0.5 * (low + high);
      (radial(r, slope) < seen ? low : high) = r;
    }
    radial(r, slope);
    value = r;
    value_slope = 1.0 / slope;
  });
}

bool CaltechModel::ray_from_plane(const Eigen::Vector2d& plane, Eigen::Vector3d& ray,
                                  Eigen::Matrix<double, 3, 2>* jacobian) const noexcept {
  const double seen = plane.norm();
  if (!(seen < 1e6)) return false;
  Eigen::Vector2d point = seen > 0 ? Eigen::Vector2d(plane * (radius_(seen) / seen)) : plane;
  Eigen::Matrix2d inverse;
  bool converged = false;
  for (int i = 0; i < kMaxNewtonSteps && !converged; ++i) {
    Eigen::Matrix2d j;
    const Eigen::Vector2d miss = plane - distort(point, j);
    const double determinant = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    if (!(std::abs(determinant) > 1e-12)) return false;
    inverse << j(1, 1), -j(0, 1), -j(1, 0), j(0, 0);
    inverse /= determinant;
    const Eigen::Vector2d step = inverse * miss;
    point += step;
    converged = step.squaredNorm() < kLastStep * kLastStep;
  }
  if (!converged || !(point.squaredNorm() <= max_radius_ * max_radius_)) return false;
  const double inverse_length = 1.0 / std::sqrt(1.0 + point.squaredNorm());
  ray = inverse_length * Eigen::Vector3d(point.x(), point.y(), 1);
  if (jacobian != nullptr) {
    Eigen::Matrix<double, 3, 2> unnormalised;
    unnormalised << inverse, Eigen::RowVector2d::Zero();
    *jacobian = inverse_length * (unnormalised - ray * (ray.transpose() * unnormalised));
  }
  return true;
}

bool CaltechModel::plane_from_ray(const Eigen::Vector3d& direction, Eigen::Vector2d& plane,
                                  Eigen::Matrix<double, 2, 3>* jacobian) const noexcept {
  if (!(direction.z() > 0)) return false;
  const double inverse_z = 1.0 / direction.z();
  const Eigen::Vector2d point = direction.head<2>() * inverse_z;
  if (!(point.squaredNorm() <= max_radius_ * max_radius_)) return false;
  Eigen::Matrix2d by_point;
  plane = distort(point, by_point);
  if (jacobian != nullptr) {
    Eigen::Matrix<double, 2, 3> point_by_direction;
    point_by_direction << inverse_z * Eigen::Matrix2d::Identity(), -inverse_z * point;
    *jacobian = by_point * point_by_direction;
  }
  return true;
}

}  // namespace omma
