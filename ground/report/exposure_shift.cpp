#include "ground/report/exposure_shift.hpp"

#include "ground/report/bound.hpp"

namespace omma::ground {
namespace {

SpotChoice of_camera(std::size_t camera) {
  return [camera](const TruthSpot& spot) { return spot.camera == static_cast<int>(camera); };
}

// −(Σ I)⁻¹ Σ I s, cameras with information I and shift s each.
template <class Vector, class Information, class Shift>
Vector weighted(std::size_t cameras, Information&& information, Shift&& shift) {
  using Matrix = Eigen::Matrix<double, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime>;
  Matrix all = Matrix::Zero();
  Vector sum = Vector::Zero();
  for (std::size_t c = 0; c < cameras; ++c) {
    const Matrix one = information(of_camera(c));
    all += one;
    sum += one * shift(c);
  }
  Matrix covariance;
  if (!bound_of(all, covariance)) return Vector::Zero();
  return -(covariance * sum);
}

}  // namespace

Eigen::Vector3d attitude_shift(const Rig& rig, const TruthFrame& truth, std::span<const TruthSpot> used) {
  return weighted<Eigen::Vector3d>(
      truth.exposures.size(),
      [&](const SpotChoice& camera) { return attitude_information(rig, used, camera); },
      [&](std::size_t c) -> const Eigen::Vector3d& { return truth.exposures[c].turn; });
}

Vector6d pose_shift(const Rig& rig, const TruthFrame& truth, std::span<const TruthSpot> used,
                    const TargetBody& body, std::size_t index) {
  const Pose& pose = truth.bodies[index].rig_from_body;
  return weighted<Vector6d>(
      truth.exposures.size(),
      [&](const SpotChoice& camera) { return pose_information(rig, used, body, pose, camera); },
      [&](std::size_t c) -> const Vector6d& { return truth.exposures[c].bodies[index]; });
}

}  // namespace omma::ground
