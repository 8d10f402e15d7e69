// Lens: pixel ↔ bearing for one camera, in both directions, beyond 180° where the model allows it.
// Models: OCamCalib polynomial (Scaramuzza), Caltech/Bouguet pinhole with distortion, Kannala–Brandt with
// four coefficients (Kalibr "equidistant"). Camera frame: x right, y down, z forward; pixel (0,0) is the
// centre of the top-left pixel, u right, v down.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <numbers>
#include <span>
#include <variant>

#include "components/geometry/caltech_model.hpp"
#include "components/geometry/kannala_brandt_model.hpp"
#include "components/geometry/ocam_model.hpp"

namespace omma {

enum class LensModel : std::uint8_t { kOcam, kCaltech, kKannalaBrandt };

/// A value type without heap memory, trivially copyable; construct with the readers in lens_file.hpp or the
/// functions below. A default-constructed lens sees nothing.
///
/// A pixel is `centre + affine · m`, m a point on the model's image plane; the model knows m ↔ ray.
/// The constructing functions throw std::invalid_argument where a number is not finite, a focal length or a
/// size is not positive, or the model sees nothing.
class Lens {
 public:
  Lens() = default;

  LensModel model() const noexcept;
  int width() const noexcept { return width_; }    ///< [px]
  int height() const noexcept { return height_; }  ///< [px]
  /// Largest angle off the optical axis that any image pixel sees [rad].
  double max_angle() const noexcept { return max_angle_; }
  /// Angle seen by one pixel at the centre of the image [rad/px].
  double pixel_angle() const noexcept { return pixel_angle_; }
  /// Pixel of the optical axis.
  Eigen::Vector2d centre() const noexcept { return {centre_[0], centre_[1]}; }
  /// ∂pixel/∂m: focal lengths and skew, or OCamCalib's affine part.
  Eigen::Matrix2d affine() const noexcept { return Eigen::Map<const Eigen::Matrix2d>(affine_.data()); }
  /// The parameters of the model; null where the lens has another one.
  const OcamModel* ocam_model() const noexcept { return std::get_if<OcamModel>(&shape_); }
  const CaltechModel* caltech_model() const noexcept { return std::get_if<CaltechModel>(&shape_); }
  const KannalaBrandtModel* kannala_brandt_model() const noexcept {
    return std::get_if<KannalaBrandtModel>(&shape_);
  }

  /// Unit bearing (camera frame) seen by `pixel`; false where the model has no ray for it.
  bool bearing(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray) const noexcept;
  /// The same with the Jacobian ∂ray/∂pixel (3×2).
  bool bearing(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray,
               Eigen::Matrix<double, 3, 2>& jacobian) const noexcept;
  /// Pixel where the direction (of any length) is seen; false when it is outside the lens or the image.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept;
  /// The same with the Jacobian ∂pixel/∂direction (2×3); a change of the direction's length changes nothing.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel,
               Eigen::Matrix<double, 2, 3>& jacobian) const noexcept;

  /// Pinhole without distortion from the horizontal field of view [rad], centre in the middle of the image.
  static Lens pinhole(int width, int height, double horizontal_fov);
  /// Equidistant fisheye r = f θ, `f` [px per rad], centre in pixels, seeing to `max_angle` off axis.
  static Lens equidistant(int width, int height, double f, const Eigen::Vector2d& centre, double max_angle);
  /// OCamCalib: ray of m is (m, F(|m|)), F > 0 on the axis, increasing powers, m in pixels.
  static Lens ocam(int width, int height, const Eigen::Vector2d& centre, const Eigen::Matrix2d& affine,
                   std::span<const double> polynomial);
  /// Caltech: focal lengths [px], skew coefficient alpha_c, distortion in Bouguet's order.
  static Lens caltech(int width, int height, const Eigen::Vector2d& focal, const Eigen::Vector2d& centre,
                      double skew, const CaltechModel::Coefficients& distortion);
  /// Kannala–Brandt: focal lengths [px], seeing to `max_angle` off axis [rad] (or to the edge of the image).
  static Lens kannala_brandt(int width, int height, const Eigen::Vector2d& focal,
                             const Eigen::Vector2d& centre, const KannalaBrandtModel::Coefficients& k,
                             double max_angle = std::numbers::pi);

 private:
  Lens(int width, int height, const Eigen::Vector2d& centre, const Eigen::Matrix2d& affine);
  Eigen::Matrix2d inverse_affine() const noexcept {
    return Eigen::Map<const Eigen::Matrix2d>(inverse_affine_.data());
  }
  double plane_radius() const;
  void finish();
  bool bearing_with(const Eigen::Vector2d& pixel, Eigen::Vector3d& ray,
                    Eigen::Matrix<double, 3, 2>* jacobian) const noexcept;
  bool project_with(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel,
                    Eigen::Matrix<double, 2, 3>* jacobian) const noexcept;

  // Plain arrays, because Eigen's own types are not trivially copyable; matrices column by column.
  std::array<double, 2> centre_{};
  std::array<double, 4> affine_{1, 0, 0, 1};
  std::array<double, 4> inverse_affine_{1, 0, 0, 1};
  double max_angle_ = 0;
  double pixel_angle_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::variant<CaltechModel, OcamModel, KannalaBrandtModel> shape_;
};

}  // namespace omma
