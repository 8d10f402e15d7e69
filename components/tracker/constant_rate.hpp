// Constant-rate prediction from the last two estimates, with its covariance (the two estimates' own, and an
// acceleration the model does not know).
//
// With h = (t − t₂)/(t₂ − t₁) the prediction x₂ + h (x₂ − x₁) has covariance (1+h)² P₂ + h² P₁ + Q, where Q
// comes from an acceleration a of standard deviation σ: error ½ a (t − t₂)(t − t₁).
#pragma once

#include <limits>

#include "components/geometry/pose.hpp"
#include "components/tracker/body_pairing.hpp"
#include "components/tracker/sky_pairing.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

class AttitudePrediction {
  static constexpr double kNeverSeen = std::numeric_limits<double>::infinity();

 public:
  /// @param acceleration_sigma  angular acceleration not modelled [rad/s²]
  explicit AttitudePrediction(double acceleration_sigma) : acceleration_sigma_(acceleration_sigma) {}

  void set_acceleration(double sigma) noexcept { acceleration_sigma_ = sigma; }
  void reset() noexcept {
    count_ = 0;
    acceleration_seen_ = kNeverSeen;
  }
  /// A new estimate; one no newer than the last is ignored.
  void update(TimeNs time_ns, const Eigen::Quaterniond& rig_from_j2000,
              const Eigen::Matrix3d& covariance) noexcept;
  /// True once the rate is known.
  bool ready() const noexcept { return count_ == 2; }
  /// True when the attitude is known but not the rate.
  bool without_rate() const noexcept { return count_ == 1; }
  TimeNs last_time_ns() const noexcept { return last_time_ns_; }
  const Eigen::Quaterniond& last() const noexcept { return last_; }
  PredictedAttitude at(TimeNs time_ns) const noexcept;
  /// How far from its prediction an attitude may be if the rig goes on to accelerate no more than it was last
  /// seen to: the largest acceleration that the last estimates showed, each counting half of the one after it
  /// [rad]. Infinite until there were three.
  double farthest_seen(TimeNs time_ns) const noexcept;

 private:
  double reach(TimeNs time_ns) const noexcept;  // turned by a unit acceleration [s²]

  double acceleration_sigma_;
  double acceleration_seen_ = kNeverSeen;  // [rad/s²]
  int count_ = 0;
  TimeNs last_time_ns_ = 0;
  double interval_s_ = 0;  // between the last two estimates
  Eigen::Quaterniond last_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d turn_ =
      Eigen::Vector3d::Zero();  // rotation vector from the one before to the last, rig frame
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance_before_ = Eigen::Matrix3d::Zero();
};

class PosePrediction {
 public:
  /// @param angular_sigma  angular acceleration not modelled [rad/s²]
  /// @param linear_sigma   linear acceleration not modelled, rig frame [m/s²]
  PosePrediction(double angular_sigma, double linear_sigma)
      : angular_sigma_(angular_sigma), linear_sigma_(linear_sigma) {}

  void set_accelerations(double angular_sigma, double linear_sigma) noexcept {
    angular_sigma_ = angular_sigma;
    linear_sigma_ = linear_sigma;
  }
  void reset() noexcept { count_ = 0; }
  void update(TimeNs time_ns, const Pose& rig_from_body, const Matrix6d& covariance) noexcept;
  bool ready() const noexcept { return count_ == 2; }
  TimeNs last_time_ns() const noexcept { return last_time_ns_; }
  PredictedPose at(TimeNs time_ns) const noexcept;

 private:
  double angular_sigma_;
  double linear_sigma_;
  int count_ = 0;
  TimeNs last_time_ns_ = 0;
  double interval_s_ = 0;
  Pose last_;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d step_ = Eigen::Vector3d::Zero();
  Matrix6d covariance_ = Matrix6d::Zero();
  Matrix6d covariance_before_ = Matrix6d::Zero();
};

}  // namespace omma
