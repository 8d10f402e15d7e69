#include "ground/methods/absolute_orientation.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace omma {

Pose absolute_orientation(std::span<const Eigen::Vector3d> from,
                          std::span<const Eigen::Vector3d> to) noexcept {
  Eigen::Vector3d middle_from = Eigen::Vector3d::Zero(), middle_to = Eigen::Vector3d::Zero();
  const auto n = static_cast<double>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    middle_from += from[i] / n;
    middle_to += to[i] / n;
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
    spread += (to[i] - middle_to) * (from[i] - middle_from).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return {};
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1.0 : 1.0;
  const Eigen::Matrix3d rotation =
      svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  Pose pose;
  pose.rotation = Eigen::Quaterniond(rotation).normalized();
  pose.translation = middle_to - pose.rotation * middle_from;
  return pose;
}

}  // namespace omma
