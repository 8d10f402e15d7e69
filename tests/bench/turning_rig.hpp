// A rig that turns with known truth: attitudes of single frame sets with their noise, and a gyro with bias.
#pragma once

#include <random>
#include <vector>

#include "components/estimation/attitude_filter.hpp"

namespace omma {

struct TurningRigOptions {
  double interval_s = 0.1;                           ///< between frame sets
  double first_rate_sigma = 0.05;                    ///< of the true rate at the start, each axis [rad/s]
  double acceleration_density = 1e-3;                ///< white angular acceleration, each axis [rad/s^1.5]
  Eigen::Vector3d attitude_sigma{5e-5, 7e-5, 3e-4};  ///< about the rig's axes [rad]
  bool gyro = false;
  int gyro_steps = 1;               ///< measurements between two frame sets
  double gyro_noise = 4e-5;         ///< [rad/s^0.5]
  double gyro_bias_walk = 1e-5;     ///< [rad/s^1.5]
  double first_bias_sigma = 0.005;  ///< [rad/s]
};

struct GyroStep {
  double interval_s;
  Eigen::Vector3d rate;  ///< measured mean [rad/s]
};

class TurningRig {
 public:
  TurningRig(const TurningRigOptions& options, std::uint64_t seed);

  /// To the next frame set; returns what the gyro measured on the way (without a gyro the true intervals).
  const std::vector<GyroStep>& advance();
  /// The attitude as a single frame set gives it, with noise drawn anew.
  Eigen::Quaterniond measured_attitude();
  Eigen::Matrix3d attitude_covariance() const;

  const Eigen::Quaterniond& attitude() const { return attitude_; }  ///< rig_from_j2000, the truth
  const Eigen::Vector3d& rate() const { return rate_; }             ///< rig frame [rad/s]
  const Eigen::Vector3d& bias() const { return bias_; }             ///< what the gyro adds

  /// The filter parameters that tell the truth about this rig.
  AttitudeFilterParameters filter_parameters() const;

 private:
  Eigen::Vector3d gauss();

  TurningRigOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Quaterniond attitude_;
  Eigen::Vector3d rate_;
  Eigen::Vector3d bias_;
  std::vector<GyroStep> measured_;
};

/// Error of the filter: (δθ, δs) as its covariance means them.
Vector6d filter_error(const AttitudeFilter& filter, const TurningRig& rig, bool gyro);

}  // namespace omma
