#include "ground/calibrate/axis_shims.hpp"

#include <Eigen/LU>
#include <cmath>

namespace omma::ground {
namespace {

constexpr double kStep = 1e-6;      // of differences [rad, m]
constexpr double kParallel = 1e-3;  // sine of an angle between axes that share no point worth telling [rad]

Eigen::Matrix3d across(const Axis& axis) {
  return Eigen::Matrix3d::Identity() - axis.direction * axis.direction.transpose();
}

// The point nearest to all lines, or the one on line `keep` nearest to the others.
Eigen::Vector3d common_point(const std::vector<Axis>& axes, std::optional<std::size_t> keep) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (keep == i) continue;
    matrix += across(axes[i]);
    right += across(axes[i]) * axes[i].point;
  }
  if (!keep) return matrix.lu().solve(right);
  const Axis& kept = axes[*keep];
  const double along =
      kept.direction.dot(right - matrix * kept.point) / kept.direction.dot(matrix * kept.direction);
  return kept.point + along * kept.direction;
}

double line_distance(const Axis& a, const Axis& b) {
  const Eigen::Vector3d normal = a.direction.cross(b.direction);
  return std::abs(normal.normalized().dot(b.point - a.point));
}

// Angle between lines, not above 90 degrees.
double line_angle(const Axis& a, const Axis& b) {
  return std::atan2(a.direction.cross(b.direction).norm(), std::abs(a.direction.dot(b.direction)));
}

// Point, moves, and the pairs' angles and distances, one below the other.
Eigen::VectorXd all_of(const std::vector<Axis>& axes, std::optional<std::size_t> keep) {
  const auto count = static_cast<Eigen::Index>(axes.size());
  Eigen::VectorXd all(3 + 3 * count + count * (count - 1));
  const Eigen::Vector3d point = common_point(axes, keep);
  all.head<3>() = point;
  Eigen::Index at = 3;
  for (const Axis& axis : axes) {
    all.segment<3>(at) = across(axis) * (point - axis.point);
    at += 3;
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t k = i + 1; k < axes.size(); ++k) {
      all[at++] = line_angle(axes[i], axes[k]);
      all[at++] = line_distance(axes[i], axes[k]);
    }
  }
  return all;
}

// Covariance of all of it: each axis's own carried through, by differences.
Eigen::MatrixXd covariance_of(const std::vector<NamedAxis>& named, const std::vector<Axis>& axes,
                              std::optional<std::size_t> keep) {
  const Eigen::Index size = all_of(axes, keep).size();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Eigen::MatrixXd jacobian(size, 4);
    for (int k = 0; k < 4; ++k) {
      std::vector<Axis> ahead = axes;
      std::vector<Axis> behind = axes;
      ahead[i] = moved(axes[i], kStep * Eigen::Vector4d::Unit(k));
      behind[i] = moved(axes[i], -kStep * Eigen::Vector4d::Unit(k));
      jacobian.col(k) = (all_of(ahead, keep) - all_of(behind, keep)) / (2 * kStep);
    }
    covariance += jacobian * named[i].fit.covariance * jacobian.transpose();
  }
  return covariance;
}

}  // namespace

double Shim::length_sigma() const {
  const double whole = std::sqrt(covariance.trace());
  if (!(length() > whole)) return whole;
  return std::sqrt(move.normalized().dot(covariance * move.normalized()));
}

std::optional<AxisShims> axis_shims(const std::vector<NamedAxis>& named, std::optional<std::size_t> keep) {
  std::vector<Axis> axes;
  axes.reserve(named.size());
  for (const NamedAxis& one : named) axes.push_back(one.fit.axis);
  double widest = 0;
  for (const Axis& a : axes)
    for (const Axis& b : axes) widest = std::max(widest, line_angle(a, b));
  if (widest < kParallel) return std::nullopt;
  const Eigen::VectorXd all = all_of(axes, keep);
  const Eigen::MatrixXd covariance = covariance_of(named, axes, keep);
  AxisShims result;
  result.point = all.head<3>();
  result.covariance = covariance.topLeftCorner<3, 3>();
  Eigen::Index at = 3;
  for (std::size_t i = 0; i < axes.size(); ++i, at += 3)
    result.shims.push_back({all.segment<3>(at), covariance.block<3, 3>(at, at)});
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t k = i + 1; k < axes.size(); ++k, at += 2) {
      result.pairs.push_back({static_cast<int>(i), static_cast<int>(k), all[at],
                              std::sqrt(covariance(at, at)), all[at + 1],
                              std::sqrt(covariance(at + 1, at + 1))});
    }
  }
  return result;
}

}  // namespace omma::ground
