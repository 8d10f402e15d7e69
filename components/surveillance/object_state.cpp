#include "components/surveillance/object_state.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace omma {

void ObjectState::start(const Eigen::Vector3d& direction, const Eigen::Matrix3d& covariance,
                        double velocity_sigma) noexcept {
  direction_ = direction;
  velocity_.setZero();
  covariance_.setZero();
  covariance_.topLeftCorner<3, 3>() = covariance;
  covariance_.bottomRightCorner<3, 3>() = velocity_sigma * velocity_sigma * Eigen::Matrix3d::Identity();
  stay_on_sphere();
}

void ObjectState::predict(double seconds, double acceleration_sigma, double closing) noexcept {
  const double farther = std::max(1 + closing * seconds, 0.2);  // range then over range now
  const double span = seconds / farther;
  const double slower = 1 / (farther * farther);
  const Eigen::Matrix3d turn = rotation_exp(span * direction_.cross(velocity_)).toRotationMatrix();
  direction_ = turn * direction_;
  velocity_ = slower * (turn * velocity_);
  Matrix6d transition;
  transition << turn, span * turn, Eigen::Matrix3d::Zero(), slower * turn;
  covariance_ = transition * covariance_ * transition.transpose();
  const double variance = acceleration_sigma * acceleration_sigma;
  const double t2 = seconds * seconds;
  for (int i = 0; i < 3; ++i) {
    covariance_(i, i) += 0.25 * t2 * t2 * variance;
    covariance_(i, i + 3) += 0.5 * t2 * seconds * variance;
    covariance_(i + 3, i) += 0.5 * t2 * seconds * variance;
    covariance_(i + 3, i + 3) += t2 * variance;
  }
  stay_on_sphere();
}

Innovation ObjectState::innovation(const Eigen::Matrix<double, 2, 3>& whitener_in_j2000,
                                   const Eigen::Matrix3d& common) const noexcept {
  Innovation result;
  result.difference = whitener_in_j2000 * direction_;  // the whitener has nothing along the dot's ray
  result.design.leftCols<3>() = whitener_in_j2000;
  const Eigen::Matrix<double, 2, 3> by_rotation = whitener_in_j2000 * skew(direction_);
  result.covariance = result.design * covariance_ * result.design.transpose() +
                      by_rotation * common * by_rotation.transpose() + Eigen::Matrix2d::Identity();
  const double determinant = result.covariance.determinant();
  Eigen::Matrix2d inverse;
  inverse << result.covariance(1, 1), -result.covariance(0, 1), -result.covariance(1, 0),
      result.covariance(0, 0);
  result.distance2 = result.difference.dot(inverse * result.difference) / determinant;
  const double density = (whitener_in_j2000 * whitener_in_j2000.transpose()).determinant();
  result.area = std::sqrt(determinant / density);
  return result;
}

void ObjectState::update(const Innovation& innovation) noexcept {
  const Eigen::Matrix<double, 6, 2> gain =
      covariance_ * innovation.design.transpose() * innovation.covariance.inverse();
  const Vector6d correction = -gain * innovation.difference;
  direction_ += correction.head<3>();
  velocity_ += correction.tail<3>();
  covariance_ -= gain * innovation.covariance * gain.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  stay_on_sphere();
}

// Direction of length one, nothing along it in velocity and covariance.
void ObjectState::stay_on_sphere() noexcept {
  direction_.normalize();
  velocity_ -= direction_ * direction_.dot(velocity_);
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - direction_ * direction_.transpose();
  Matrix6d projection = Matrix6d::Zero();
  projection.topLeftCorner<3, 3>() = across;
  projection.bottomRightCorner<3, 3>() = across;
  covariance_ = projection * covariance_ * projection;
}

}  // namespace omma
