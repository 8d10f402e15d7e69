#include "ground/methods/object_space_pose.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "ground/methods/absolute_orientation.hpp"

namespace omma {
namespace {

constexpr int kMostIterations = 1000;       // it converges linearly
constexpr double kSmallestProgress = 1e-9;  // of the cost, in one iteration

Eigen::Vector3d gap(const Sight& sight, const Eigen::Vector3d& at) {
  const Eigen::Vector3d d = at - sight.origin;
  return d - sight.ray * sight.ray.dot(d);
}

}  // namespace

double object_space_cost(std::span<const Sight> sights, const Pose& rig_from_body) noexcept {
  double sum = 0;
  for (const Sight& sight : sights) sum += gap(sight, rig_from_body * sight.point).squaredNorm();
  return sum;
}

PoseAnswer object_space_pose(std::span<const Sight> sights, const Pose& initial) {
  PoseAnswer answer;
  answer.rig_from_body = initial;
  if (sights.size() < 3) return answer;
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();  // Σ (I − vvᵀ)
  for (const Sight& sight : sights) across += Eigen::Matrix3d::Identity() - sight.ray * sight.ray.transpose();
  const Eigen::Matrix3d inverse = across.inverse();
  std::vector<Eigen::Vector3d> from, to(sights.size());
  for (const Sight& sight : sights) from.push_back(sight.point);

  Pose& pose = answer.rig_from_body;
  double cost = std::numeric_limits<double>::infinity();
  while (answer.iterations < kMostIterations) {
    ++answer.iterations;
    // The best translation for this rotation, then each target's nearest place on its ray, then the motion
    // that takes the body nearest to those places.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Sight& sight : sights) sum -= gap(sight, pose.rotation * sight.point);
    pose.translation = inverse * sum;
    const double now = object_space_cost(sights, pose);
    if (!std::isfinite(now)) return answer;
    if (!(cost - now > kSmallestProgress * now)) break;
    cost = now;
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const Eigen::Vector3d d = pose * sights[i].point - sights[i].origin;
      to[i] = sights[i].origin + sights[i].ray * sights[i].ray.dot(d);
    }
    pose.rotation = absolute_orientation(from, to).rotation;
  }
  answer.found = true;
  return answer;
}

}  // namespace omma
