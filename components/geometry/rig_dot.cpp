#include "components/geometry/rig_dot.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace omma {

bool rig_dot(const Dot& dot, std::uint16_t index, const RigCamera& camera, std::uint8_t camera_index,
             double floor_px, RigDot& out) noexcept {
  Eigen::Vector3d ray;
  Eigen::Matrix<double, 3, 2> ray_by_pixel;
  if (!camera.lens.bearing(dot.pixel, ray, ray_by_pixel)) return false;
  // Covariance of the bearing in its tangent plane: Σ = (Bᵀ J) Σ_px (Bᵀ J)ᵀ, then WᵀW = Σ⁻¹.
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(ray);
  const Eigen::Matrix2d j = basis.transpose() * ray_by_pixel;
  const Eigen::Matrix2d pixel_covariance = dot.covariance + floor_px * floor_px * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d covariance = j * pixel_covariance * j.transpose();
  const double l00 = std::sqrt(covariance(0, 0));
  const double l10 = covariance(1, 0) / l00;
  const double l11_squared = covariance(1, 1) - l10 * l10;
  if (!(l00 > 0) || !(l11_squared > 0)) return false;
  const double l11 = std::sqrt(l11_squared);
  Eigen::Matrix2d whitening;  // inverse of the Cholesky factor
  whitening << 1 / l00, 0, -l10 / (l00 * l11), 1 / l11;

  const Eigen::Matrix3d rotation = camera.rig_from_camera.rotation.toRotationMatrix();
  out.origin = camera.rig_from_camera.translation;
  out.ray = rotation * ray;
  out.whitener = whitening * basis.transpose() * rotation.transpose();
  out.sigma = std::sqrt(0.5 * covariance.trace());
  out.flux = dot.flux;
  out.snr = dot.snr;
  out.area = static_cast<float>(dot.area);
  out.flags = dot.flags;
  out.camera = camera_index;
  out.index = index;
  return true;
}

}  // namespace omma
