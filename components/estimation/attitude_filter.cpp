#include "components/estimation/attitude_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace omma {
namespace {

/// Weakest axis of a prediction beyond which an attitude is not compared with it: whole turns could be
/// missing between them [rad].
constexpr double kNoPrediction = 1.0;

double largest_variance(const Eigen::Matrix3d& covariance) noexcept {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[2];
}

/// ∫ exp(−[ω]× τ) dτ over the interval, with a = ω dt.
Eigen::Matrix3d integrated_turn(const Eigen::Vector3d& a, double interval_s) noexcept {
  const double angle2 = a.squaredNorm();
  const Eigen::Matrix3d across = skew(a);
  if (angle2 < 1e-8)
    return interval_s * (Eigen::Matrix3d::Identity() - 0.5 * across + (1.0 / 6) * across * across);
  const double angle = std::sqrt(angle2);
  return interval_s * (Eigen::Matrix3d::Identity() - (1 - std::cos(angle)) / angle2 * across +
                       (angle - std::sin(angle)) / (angle2 * angle) * across * across);
}

}  // namespace

void AttitudeFilter::start(const Eigen::Quaterniond& rig_from_j2000,
                           const Eigen::Matrix3d& covariance) noexcept {
  const Eigen::Quaterniond before = attitude_;
  const double sigma = parameters_.gyro ? parameters_.first_bias_sigma : parameters_.first_rate_sigma;
  attitude_ = rig_from_j2000;
  if (attitude_.dot(before) < 0) attitude_.coeffs() = -attitude_.coeffs();
  drift_.setZero();
  covariance_.setZero();
  covariance_.topLeftCorner<3, 3>() = covariance;
  covariance_.bottomRightCorner<3, 3>() = sigma * sigma * Eigen::Matrix3d::Identity();
  running_ = true;
  refused_ = 0;
}

void AttitudeFilter::predict(double interval_s) noexcept {
  if (!running_ || !(interval_s > 0)) return;
  const double q = parameters_.acceleration_density * parameters_.acceleration_density;
  if (!parameters_.gyro) {
    carry(interval_s, 0, q);
    return;
  }
  if (measured_over_s_ == 0) {  // the gyro has not said a word yet: nothing carries the attitude
    running_ = false;
    return;
  }
  // A gyro that is silent leaves its last rate, which is a random walk away from the true one: the angle
  // gains q ((T + t)³ − T³) / 3 after a silence of T, as if what it gained before told nothing of it.
  const double t = interval_s, before = silent_s_;
  carry(interval_s, q * (before * before + before * t + t * t / 3),
        parameters_.gyro_bias_walk * parameters_.gyro_bias_walk);
  silent_s_ += interval_s;
}

void AttitudeFilter::predict(double interval_s, const Eigen::Vector3d& measured_rate) noexcept {
  measured_rate_ = measured_rate;
  measured_over_s_ = interval_s;
  silent_s_ = 0.5 * interval_s;  // a mean rate is that of the interval's middle
  carry(interval_s, parameters_.gyro_noise * parameters_.gyro_noise,
        parameters_.gyro_bias_walk * parameters_.gyro_bias_walk);
}

// δθ' = −ω × δθ − δs − noise, δs' = noise.
void AttitudeFilter::carry(double interval_s, double angle_density, double drift_density) noexcept {
  if (!running_ || !(interval_s > 0)) return;
  const Eigen::Vector3d turn = rate() * interval_s;
  const Eigen::Quaterniond step = rotation_exp(-turn);
  attitude_ = (step * attitude_).normalized();
  Matrix6d transition = Matrix6d::Identity();
  transition.topLeftCorner<3, 3>() = step.toRotationMatrix();
  transition.topRightCorner<3, 3>() = -integrated_turn(turn, interval_s);
  const double t = interval_s;
  Matrix6d noise = Matrix6d::Zero();
  noise.topLeftCorner<3, 3>().diagonal().setConstant(angle_density * t + drift_density * t * t * t / 3);
  noise.topRightCorner<3, 3>().diagonal().setConstant(-drift_density * t * t / 2);
  noise.bottomLeftCorner<3, 3>() = noise.topRightCorner<3, 3>();
  noise.bottomRightCorner<3, 3>().diagonal().setConstant(drift_density * t);
  const Matrix6d carried = transition * covariance_ * transition.transpose() + noise;
  covariance_ = 0.5 * (carried + carried.transpose());
}

FilterUpdate AttitudeFilter::update(const Eigen::Quaterniond& rig_from_j2000,
                                    const Eigen::Matrix3d& covariance) noexcept {
  if (!covariance.allFinite() || !rig_from_j2000.coeffs().allFinite()) return FilterUpdate::kRefused;
  if (!running_ || !(largest_variance(attitude_covariance()) < kNoPrediction * kNoPrediction)) {
    start(rig_from_j2000, covariance);
    return FilterUpdate::kStarted;
  }
  const Eigen::Vector3d innovation = rotation_log(rig_from_j2000 * attitude_.conjugate());
  const Eigen::Matrix3d expected = covariance_.topLeftCorner<3, 3>() + covariance;
  const Eigen::LLT<Eigen::Matrix3d> factor(expected);
  innovation_chi2_ = innovation.dot(factor.solve(innovation));
  if (factor.info() != Eigen::Success || !(innovation_chi2_ <= parameters_.gate_chi2)) {
    if (++refused_ < parameters_.patience) return FilterUpdate::kRefused;
    start(rig_from_j2000, covariance);
    return FilterUpdate::kStarted;
  }
  refused_ = 0;
  const Eigen::Matrix<double, 6, 3> gain =
      factor.solve(covariance_.topRows<3>()).transpose();  // P Hᵀ S⁻¹, H = [I 0]
  const Vector6d correction = gain * innovation;
  // Joseph's form: stays positive whatever the gain's rounding.
  Matrix6d kept = Matrix6d::Identity();
  kept.leftCols<3>() -= gain;
  const Matrix6d updated = kept * covariance_ * kept.transpose() + gain * covariance * gain.transpose();
  covariance_ = 0.5 * (updated + updated.transpose());
  attitude_ = (rotation_exp(correction.head<3>()) * attitude_).normalized();
  drift_ += correction.tail<3>();
  return FilterUpdate::kUsed;
}

bool AttitudeFilter::valid() const noexcept {
  const double limit = parameters_.largest_rotation_sigma;
  return running_ && largest_variance(attitude_covariance()) <= limit * limit;
}

Eigen::Matrix3d AttitudeFilter::rate_covariance() const noexcept {
  Eigen::Matrix3d covariance = covariance_.bottomRightCorner<3, 3>();
  if (measured_over_s_ > 0)
    covariance.diagonal().array() += parameters_.gyro_noise * parameters_.gyro_noise / measured_over_s_;
  return covariance;
}

}  // namespace omma
