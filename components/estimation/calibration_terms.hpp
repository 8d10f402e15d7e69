// What errors of calibration and survey add to a covariance: consider terms. They are not estimated; the
// solution's sensitivity to them, P Σ Jᵀ B, carries their covariance into its own.
#pragma once

#include <array>

#include "components/estimation/linearised_sight.hpp"

namespace omma {

template <int kUnknowns>
class CalibrationTerms {
 public:
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  CalibrationTerms(const CalibrationError& sigma, const CameraAxes& axes) noexcept
      : sigma_(sigma), axes_(axes) {
    for (auto& camera : by_camera_) camera.setZero();
    for (auto& camera : by_scale_) camera.setZero();
    if (sigma_.survey > 0)
      for (auto& target : by_target_) target.setZero();
  }

  void add(const LinearisedSight<kUnknowns>& seen, const SightSource& source,
           const Eigen::Matrix3d& rotation) noexcept {
    const std::size_t camera = camera_of(source);
    const auto transposed = seen.jacobian.transpose();
    by_camera_[camera] += transposed * seen.by_camera(axes_[camera], sigma_);
    if constexpr (kUnknowns == kAttitudeUnknowns) return;
    by_scale_[camera] += transposed * (seen.by_point * (sigma_.survey_scale * seen.turned));
    if (sigma_.survey > 0) {
      const std::size_t target = std::min<std::size_t>(source.entry, limits::kTargetsPerBody - 1);
      by_target_[target] += transposed * (seen.by_point * (sigma_.survey * rotation));
    }
  }

  /// What the errors add to the variance of the sight's whitened residual, both rows together.
  double variance(const LinearisedSight<kUnknowns>& seen, const SightSource& source) const noexcept {
    double sum = seen.by_camera(axes_[camera_of(source)], sigma_).squaredNorm();
    if constexpr (kUnknowns == kPoseUnknowns)
      sum += (seen.by_point * (sigma_.survey_scale * seen.turned)).squaredNorm() +
             sigma_.survey * sigma_.survey * seen.by_point.squaredNorm();
    return sum;
  }

  /// Σ Jᵀ B C Bᵀ J over all errors; P · this · P is what they add to the covariance P.
  Matrix spread() const noexcept {
    Matrix sum = Matrix::Zero();
    Vector scale = Vector::Zero();
    for (const auto& camera : by_camera_) sum += camera * camera.transpose();
    for (const Vector& camera : by_scale_) scale += camera;
    sum += scale * scale.transpose();
    if (kUnknowns == kPoseUnknowns && sigma_.survey > 0)
      for (const auto& target : by_target_) sum += target * target.transpose();
    return sum;
  }

  /// The same without what one camera is wrong by. (Its share of the targets' survey stays: a little too
  /// much.)
  Matrix spread_without(std::size_t camera) const noexcept {
    Matrix sum = spread() - by_camera_[camera] * by_camera_[camera].transpose();
    Vector scale = Vector::Zero();
    for (const Vector& one : by_scale_) scale += one;
    const Vector others = scale - by_scale_[camera];
    return sum - scale * scale.transpose() + others * others.transpose();
  }

  /// Covariance that the errors give to `gain` x − `other_gain` y, where x and y are solutions that were both
  /// made with them: what they do to both alike cancels. The gains are times each solution's own covariance.
  Matrix spread_of_difference(const Matrix& gain, const CalibrationTerms& other,
                              const Matrix& other_gain) const noexcept {
    Matrix sum = Matrix::Zero();
    const auto add_square = [&](const auto& here, const auto& there) {
      const auto difference = (gain * here - other_gain * there).eval();
      sum += difference * difference.transpose();
    };
    Vector scale = Vector::Zero(), other_scale = Vector::Zero();
    for (std::size_t c = 0; c < by_camera_.size(); ++c) {
      add_square(by_camera_[c], other.by_camera_[c]);
      scale += by_scale_[c];
      other_scale += other.by_scale_[c];
    }
    add_square(scale, other_scale);
    if (kUnknowns == kPoseUnknowns && sigma_.survey > 0)
      for (std::size_t t = 0; t < by_target_.size(); ++t) add_square(by_target_[t], other.by_target_[t]);
    return sum;
  }

 private:
  static std::size_t camera_of(const SightSource& source) {
    return std::min<std::size_t>(source.camera, limits::kCameras - 1);
  }

  CalibrationError sigma_;
  CameraAxes axes_;
  std::array<Eigen::Matrix<double, kUnknowns, kCameraErrors>, limits::kCameras> by_camera_;
  std::array<Vector, limits::kCameras> by_scale_;
  std::array<Eigen::Matrix<double, kUnknowns, 3>, limits::kTargetsPerBody> by_target_;
};

}  // namespace omma
