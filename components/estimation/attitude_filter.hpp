// Multiplicative extended Kalman filter for attitude and rate: the attitudes of single frames, each with its
// covariance, smoothed over time. Without a gyro the rate is a state that white angular acceleration moves;
// with one its bias is, and the measured rate carries the attitude from frame to frame. Fixed size, no
// allocation, no loop.
// Source: Lefferts, Markley & Shuster, J. Guidance 5 (1982); Markley & Crassidis, "Fundamentals of Spacecraft
// Attitude Determination and Control", 2014, §6.2. Formulas: docs/algorithms/attitude_filter.md.
#pragma once

#include <cstdint>

#include "components/geometry/pose.hpp"

namespace omma {

struct AttitudeFilterParameters {
  bool gyro = false;
  /// White angular acceleration that nothing measures, density of each axis [rad/s^1.5].
  double acceleration_density = 1e-3;
  double gyro_noise = 1e-5;        ///< angular random walk of each axis [rad/s^0.5]
  double gyro_bias_walk = 1e-7;    ///< rate random walk of each axis [rad/s^1.5]
  double first_rate_sigma = 0.5;   ///< of the rate before it is known; times the interval below 1 rad [rad/s]
  double first_bias_sigma = 0.02;  ///< of the gyro's bias [rad/s]
  double gate_chi2 = 30;           ///< of an attitude against the prediction, 3 degrees of freedom
  int patience = 3;                ///< attitudes refused in a row before the filter starts again
  double largest_rotation_sigma = 0.05;  ///< weakest axis with which a prediction is still an answer [rad]
};

enum class FilterUpdate : std::uint8_t {
  kStarted,  ///< from this attitude alone
  kUsed,
  kRefused,  ///< too far from the prediction; the prediction stands
};

class AttitudeFilter {
 public:
  explicit AttitudeFilter(const AttitudeFilterParameters& parameters) : parameters_(parameters) {}
  void set_acceleration_density(double density) noexcept { parameters_.acceleration_density = density; }

  void stop() noexcept { running_ = false; }
  bool running() const noexcept { return running_; }

  /// To `interval_s` later, without a measured rate: the rate stays as it was but for the acceleration.
  void predict(double interval_s) noexcept;
  /// To `interval_s` later with the gyro's mean rate over the interval, rig frame [rad/s].
  void predict(double interval_s, const Eigen::Vector3d& measured_rate) noexcept;

  /// An attitude of the filter's present time, with the covariance of its small rotation, rig frame [rad²].
  FilterUpdate update(const Eigen::Quaterniond& rig_from_j2000, const Eigen::Matrix3d& covariance) noexcept;

  /// Running, and no axis weaker than allowed.
  bool valid() const noexcept;
  const Eigen::Quaterniond& rig_from_j2000() const noexcept { return attitude_; }
  Eigen::Matrix3d attitude_covariance() const noexcept { return covariance_.topLeftCorner<3, 3>(); }
  /// Of the rig against J2000, rig frame [rad/s]; with a gyro the mean over the last interval.
  Eigen::Vector3d rate() const noexcept { return measured_rate_ + drift_; }
  Eigen::Matrix3d rate_covariance() const noexcept;
  /// What to take off the gyro's rate; zero without a gyro [rad/s].
  Eigen::Vector3d gyro_bias() const noexcept {
    return parameters_.gyro ? Eigen::Vector3d(-drift_) : Eigen::Vector3d::Zero();
  }
  /// Of (δθ, δs), s the rate without a gyro and minus its bias with one.
  const Matrix6d& covariance() const noexcept { return covariance_; }
  /// χ² of the last attitude against the prediction.
  double innovation_chi2() const noexcept { return innovation_chi2_; }

 private:
  void start(const Eigen::Quaterniond& rig_from_j2000, const Eigen::Matrix3d& covariance) noexcept;
  void carry(double interval_s, double angle_density, double drift_density) noexcept;

  AttitudeFilterParameters parameters_;
  bool running_ = false;
  int refused_ = 0;
  double innovation_chi2_ = 0;
  double measured_over_s_ = 0;  // interval of the measured rate; 0: none
  double silent_s_ = 0;         // since the middle of that interval
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d drift_ = Eigen::Vector3d::Zero();          // s: ω = measured + s
  Eigen::Vector3d measured_rate_ = Eigen::Vector3d::Zero();  // zero without a gyro
  Matrix6d covariance_ = Matrix6d::Zero();
};

}  // namespace omma
