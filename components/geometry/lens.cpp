#include "components/geometry/lens.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omma {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

Lens::Lens(int width, int height, const Eigen::Vector2d& centre, const Eigen::Matrix2d& affine)
    : centre_{centre.x(), centre.y()}, width_(width), height_(height) {
  require(width > 0 && height > 0, "a lens needs a positive image size");
  require(centre.allFinite() && affine.allFinite(), "a lens needs finite numbers");
  require(affine.determinant() > 0, "a lens needs positive focal lengths");
  Eigen::Map<Eigen::Matrix2d>(affine_.data()) = affine;
  Eigen::Map<Eigen::Matrix2d>(inverse_affine_.data()) = affine.inverse();
}

// Distance from the optical axis to the farthest corner, on the model's plane.
double Lens::plane_radius() const {
  double radius = 0;
  for (const double u : {-0.5, width_ - 0.5}) {
    for (const double v : {-0.5, height_ - 0.5}) {
      radius = std::max(radius, (inverse_affine() * (Eigen::Vector2d(u, v) - centre())).norm());
    }
  }
  return radius * 1.0001;  // the corner itself is inside
}

void Lens::finish() {
  const double limit = std::visit([](const auto& shape) { return shape.max_angle(); }, shape_);
  require(limit > 0, "the lens model sees nothing");
  Eigen::Vector3d ray;
  Eigen::Matrix<double, 3, 2> jacobian;
  const auto visit = [&](double u, double v) {
    const bool seen = bearing({u, v}, ray);
    max_angle_ = std::max(max_angle_, seen ? std::atan2(ray.head<2>().norm(), ray.z()) : limit);
  };
  for (int u = 0; u < width_; ++u) {
    visit(u, 0);
    visit(u, height_ - 1);
  }
  for (int v = 0; v < height_; ++v) {
    visit(0, v);
    visit(width_ - 1, v);
  }
  const Eigen::Vector2d middle(0.5 * (width_ - 1), 0.5 * (height_ - 1));
  if (bearing(middle, ray, jacobian) || bearing(centre(), ray, jacobian)) {
    pixel_angle_ = std::sqrt(std::sqrt((jacobian.transpose() * jacobian).determinant()));
  }
}

Lens Lens::pinhole(int width, int height, double horizontal_fov) {
  require(horizontal_fov > 0 && horizontal_fov < std::numbers::pi,
          "a pinhole sees between 0 and 180 degrees");
  const double f = 0.5 * width / std::tan(0.5 * horizontal_fov);
  return caltech(width, height, {f, f}, {0.5 * (width - 1), 0.5 * (height - 1)}, 0.0, {});
}

Lens Lens::equidistant(int width, int height, double f, const Eigen::Vector2d& centre, double max_angle) {
  return kannala_brandt(width, height, {f, f}, centre, {}, max_angle);
}

Lens Lens::ocam(int width, int height, const Eigen::Vector2d& centre, const Eigen::Matrix2d& affine,
                std::span<const double> polynomial) {
  require(!polynomial.empty() && polynomial.size() <= OcamModel::kMaxCoefficients,
          "an OCamCalib polynomial needs 1 to 16 coefficients");
  require(all_finite(polynomial) && polynomial[0] > 0, "an OCamCalib polynomial needs F(0) > 0");
  Lens lens(width, height, centre, affine);
  lens.shape_ = OcamModel(polynomial, lens.plane_radius());
  lens.finish();
  return lens;
}

Lens Lens::caltech(int width, int height, const Eigen::Vector2d& focal, const Eigen::Vector2d& centre,
                   double skew, const CaltechModel::Coefficients& distortion) {
  require(focal.allFinite() && focal.minCoeff() > 0, "a lens needs positive focal lengths");
  require(all_finite(distortion) && std::isfinite(skew), "a lens needs finite numbers");
  Eigen::Matrix2d affine;
  affine << focal.x(), skew * focal.x(), 0, focal.y();
  Lens lens(width, height, centre, affine);
  lens.shape_ = CaltechModel(distortion, lens.plane_radius());
  lens.finish();
  return lens;
}

Lens Lens::kannala_brandt(int width, int height, const Eigen::Vector2d& focal, const Eigen::Vector2d& centre,
                          const KannalaBrandtModel::Coefficients& k, double max_angle) {
  require(focal.allFinite() && focal.minCoeff() > 0, "a lens needs positive focal lengths");
  require(all_finite(k) && max_angle > 0, "a lens needs finite numbers and an angle to see to");
  Lens lens(width, height, centre, focal.asDiagonal());
  lens.shape_ = KannalaBrandtModel(k, max_angle, lens.plane_radius());
  lens.finish();
  return lens;
}

LensModel Lens::model() const noexcept {
  if (ocam_model() != nullptr) return LensModel::kOcam;
  return caltech_model() != nullptr ? LensModel::kCaltech : LensModel::kKannalaBrandt;
}

bool Lens::bearing_with(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray,
                        Eigen::Matrix<double, 3, 2>* jacobian) const noexcept {
  const Eigen::Vector2d plane = inverse_affine() * (pixel - centre());
  const bool seen = std::visit(
      [&](const auto& shape) noexcept { return shape.ray_from_plane(plane, ray, jacobian); }, shape_);
  if (seen && jacobian != nullptr) *jacobian = *jacobian * inverse_affine();
  return seen;
}

bool Lens::project_with(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel,
                        Eigen::Matrix<double, 2, 3>* jacobian) const noexcept {
  Eigen::Vector2d plane;
  const bool seen = std::visit(
      [&](const auto& shape) noexcept { return shape.plane_from_ray(direction, plane, jacobian); }, shape_);
  if (!seen) return false;
  pixel = affine() * plane + centre();
  if (jacobian != nullptr) *jacobian = affine() * *jacobian;
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width_ - 0.5 && pixel.y() < height_ - 0.5;
}

bool Lens::bearing(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray) const noexcept {
  return bearing_with(pixel, ray, nullptr);
}

bool Lens::bearing(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray,
                   Eigen::Matrix<double, 3, 2>& jacobian) const noexcept {
  return bearing_with(pixel, ray, &jacobian);
}

bool Lens::project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept {
  return project_with(direction, pixel, nullptr);
}

bool Lens::project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel,
                   Eigen::Matrix<double, 2, 3>& jacobian) const noexcept {
  return project_with(direction, pixel, &jacobian);
}

}  // namespace omma
