// Lens: pixel ↔ bearing for one camera, in both directions, beyond 180° where the model allows it.
// Models: OCamCalib polynomial (Scaramuzza), Caltech/Bouguet pinhole with distortion, Kannala–Brandt with four
// coefficients (Kalibr "equidistant"). Camera frame: x right, y down, z forward; pixel (0,0) is the
// centre of the top-left pixel, u right, v down.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace omma {

enum class LensModel : std::uint8_t { kOcam, kCaltech, kKannalaBrandt };

/// A value type without heap memory; construct with the readers in lens_file.hpp or the functions below.
class Lens {
 public:
  Lens() = default;

  LensModel model() const { return model_; }
  int width() const { return width_; }    ///< [px]
  int height() const { return height_; }  ///< [px]
  /// Largest angle off the optical axis that any image pixel sees [rad].
  double max_angle() const { return max_angle_; }
  /// Angle seen by one pixel at the centre of the image [rad/px].
  double pixel_angle() const;

  /// Unit bearing (camera frame) seen by `pixel`; false where the model has no ray for it.
  bool bearing(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray) const noexcept;
  /// The same with the Jacobian ∂ray/∂pixel (3×2).
  bool bearing(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray,
               Eigen::Matrix<double, 3, 2>& jacobian) const noexcept;
  /// Pixel where the (unit) direction is seen; false when it is outside the lens or the image.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept;
  /// The same with the Jacobian ∂pixel/∂direction (2×3) for directions kept on the unit sphere.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel,
               Eigen::Matrix<double, 2, 3>& jacobian) const noexcept;

  /// Pinhole without distortion from the horizontal field of view [rad].
  static Lens pinhole(int width, int height, double horizontal_fov);
  /// Equidistant fisheye r = f θ, `f` [px per rad], centre in pixels, seeing to `max_angle` off axis.
  static Lens equidistant(int width, int height, double f, const Eigen::Vector2d& centre, double max_angle);

 private:
  LensModel model_ = LensModel::kCaltech;
  int width_ = 0;
  int height_ = 0;
  double max_angle_ = 0;
};

}  // namespace omma
