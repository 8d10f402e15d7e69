#include "ground/methods/ranges_pose.hpp"

#include <unsupported/Eigen/NonLinearOptimization>

#include "components/geometry/angles.hpp"

namespace omma {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Eigen::Quaterniond turn(double angle, const Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

Pose pose_of(const VectorXd& p) {
  Pose pose;
  pose.rotation =
      turn(p(0), Vector3d::UnitZ()) * turn(p(1), Vector3d::UnitY()) * turn(p(2), Vector3d::UnitX());
  pose.translation = p.segment<3>(3);
  return pose;
}

/// p = (yaw, pitch, roll, x, y, z, d₁ … d_N); three residuals a target.
struct GapToTheRay {
  std::span<const Sight> sights;

  int inputs() const { return static_cast<int>(6 + sights.size()); }
  int values() const { return static_cast<int>(3 * sights.size()); }

  int operator()(const VectorXd& p, VectorXd& residuals) const {
    const Pose pose = pose_of(p);
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const Index k = static_cast<Index>(i);
      residuals.segment<3>(3 * k) = pose * sights[i].point - sights[i].origin - p(6 + k) * sights[i].ray;
    }
    return 0;
  }

  int df(const VectorXd& p, MatrixXd& jacobian) const {
    const Pose pose = pose_of(p);
    const Eigen::Quaterniond yaw = turn(p(0), Vector3d::UnitZ());
    const Vector3d axes[3] = {Vector3d::UnitZ(), yaw * Vector3d::UnitY(),
                              yaw * turn(p(1), Vector3d::UnitY()) * Vector3d::UnitX()};
    jacobian.setZero();
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const Index k = static_cast<Index>(i);
      const Vector3d turned = pose.rotation * sights[i].point;
      for (Index a = 0; a < 3; ++a) jacobian.block<3, 1>(3 * k, a) = axes[a].cross(turned);
      jacobian.block<3, 3>(3 * k, 3).setIdentity();
      jacobian.block<3, 1>(3 * k, 6 + k) = -sights[i].ray;
    }
    return 0;
  }
};

}  // namespace

PoseAnswer ranges_pose(std::span<const Sight> sights, const Pose& initial) {
  PoseAnswer answer;
  answer.rig_from_body = initial;
  if (sights.size() < 3) return answer;
  GapToTheRay problem{sights};
  VectorXd p(problem.inputs());
  const YawPitchRoll angles = yaw_pitch_roll(initial.rotation);
  p.head<6>() << angles.yaw, angles.pitch, angles.roll, initial.translation;
  for (std::size_t i = 0; i < sights.size(); ++i)
    p(static_cast<Index>(6 + i)) = sights[i].ray.dot(initial * sights[i].point - sights[i].origin);
  Eigen::LevenbergMarquardt<GapToTheRay> descent(problem);
  descent.parameters.maxfev = 400;
  const auto status = descent.minimize(p);
  answer.iterations = static_cast<int>(descent.iter);
  answer.rig_from_body = pose_of(p);
  answer.found = status > 0 && p.allFinite();
  return answer;
}

}  // namespace omma
