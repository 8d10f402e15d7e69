#include "ground/methods/three_point_alone.hpp"

#include <algorithm>
#include <limits>

#include "components/estimation/generalised_three_point.hpp"
#include "components/estimation/normal_equations.hpp"

namespace omma {
namespace {

template <class Score>
std::size_t best(std::span<const Sight> sights, Score&& score) noexcept {
  std::size_t at = 0;
  double highest = -1;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const double value = score(sights[i].point);
    if (!(value > highest)) continue;
    highest = value;
    at = i;
  }
  return at;
}

/// Σ of the squared residuals, none counted for more than a very wrong one.
double misfit(std::span<const Sight> sights, const Pose& pose) noexcept {
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  double sum = 0, squared_angle = 0;
  for (const Sight& sight : sights)
    sum += std::min(1e6, squared_residual<kPoseUnknowns>(sight, rotation, pose.translation, squared_angle));
  return sum;
}

}  // namespace

PoseAnswer three_point_alone(std::span<const Sight> sights) {
  PoseAnswer answer;
  if (sights.size() < 3) return answer;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Sight& sight : sights) middle += sight.point / static_cast<double>(sights.size());
  // Far from the middle, far from that one, and the largest triangle with both.
  const Eigen::Vector3d p =
      sights[best(sights, [&](const Eigen::Vector3d& g) { return (g - middle).squaredNorm(); })].point;
  const auto from_p = [&](const Eigen::Vector3d& g) { return (g - p).squaredNorm(); };
  const Eigen::Vector3d q = sights[best(sights, from_p)].point;
  const auto triangle = [&](const Eigen::Vector3d& g) { return (g - p).cross(q - p).squaredNorm(); };
  const std::size_t corners[3] = {
      best(sights, [&](const Eigen::Vector3d& g) { return -(g - p).squaredNorm(); }), best(sights, from_p),
      best(sights, triangle)};
  ThreePoints three;
  for (std::size_t i = 0; i < 3; ++i) {
    three.origin[i] = sights[corners[i]].origin;
    three.ray[i] = sights[corners[i]].ray;
    three.point[i] = sights[corners[i]].point;
  }
  std::array<Pose, kMostGeneralisedPoses> poses;
  const int found = generalised_three_point(three, poses);
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < found; ++i) {
    const Pose& pose = poses[static_cast<std::size_t>(i)];
    const double value = misfit(sights, pose);
    if (!(value < lowest)) continue;
    lowest = value;
    answer.rig_from_body = pose;
    answer.found = true;
  }
  return answer;
}

}  // namespace omma
