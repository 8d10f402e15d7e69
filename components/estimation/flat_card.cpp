#include "components/estimation/flat_card.hpp"

#include <Eigen/Eigenvalues>

namespace omma {
namespace {

/// Thickness over width (standard deviations, squared) below which the mirror image is a contender.
constexpr double kFlatRatio = 0.2 * 0.2;

}  // namespace

CardShape card_shape(std::span<const Sight> sights, std::span<const double> weights) noexcept {
  CardShape shape;
  double n = 0;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (!weights.empty() && weights[i] == 0) continue;
    shape.centroid += sights[i].point;
    shape.viewpoint += sights[i].origin;
    n += 1;
  }
  if (n < 3) return shape;
  shape.centroid /= n;
  shape.viewpoint /= n;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (!weights.empty() && weights[i] == 0) continue;
    const Eigen::Vector3d offset = sights[i].point - shape.centroid;
    scatter += offset * offset.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scatter);  // ascending
  shape.normal = eigen.eigenvectors().col(0).normalized();
  shape.flat = eigen.eigenvalues()[0] < kFlatRatio * eigen.eigenvalues()[1];
  return shape;
}

Pose mirrored_pose(const CardShape& shape, const Pose& rig_from_body) noexcept {
  const Eigen::Vector3d centre = rig_from_body * shape.centroid;
  const Eigen::Vector3d s = (centre - shape.viewpoint).normalized();
  const Eigen::Vector3d& n = shape.normal;
  // Mirror the rig across the plane at right angles to the line of sight, and the body across its own plane
  // (which leaves the card where it is): two reflections make a rotation.
  const Eigen::Matrix3d across_sight = Eigen::Matrix3d::Identity() - 2 * s * s.transpose();
  const Eigen::Matrix3d across_card = Eigen::Matrix3d::Identity() - 2 * n * n.transpose();
  const Eigen::Matrix3d rotation = across_sight * rig_from_body.rotation.toRotationMatrix() * across_card;
  Pose mirrored;
  mirrored.rotation = Eigen::Quaterniond(rotation).normalized();
  mirrored.translation = centre - mirrored.rotation * shape.centroid;
  return mirrored;
}

}  // namespace omma
