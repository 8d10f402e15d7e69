#include "components/tracker/constant_rate.hpp"

#include <algorithm>

namespace omma {
namespace {

double seconds(TimeNs interval_ns) {
  return 1e-9 * static_cast<double>(interval_ns);
}

}  // namespace

void AttitudePrediction::update(TimeNs time_ns, const Eigen::Quaterniond& rig_from_j2000,
                                const Eigen::Matrix3d& covariance) noexcept {
  if (count_ > 0 && time_ns <= last_time_ns_) return;
  if (ready()) {
    const double seen = at(time_ns).rig_from_j2000.angularDistance(rig_from_j2000) / reach(time_ns);
    acceleration_seen_ = acceleration_seen_ == kNeverSeen ? seen : std::max(seen, 0.5 * acceleration_seen_);
  }
  if (count_ > 0) {
    interval_s_ = seconds(time_ns - last_time_ns_);
    turn_ = rotation_log(rig_from_j2000 * last_.conjugate());
    covariance_before_ = covariance_;
  }
  last_ = rig_from_j2000;
  covariance_ = covariance;
  last_time_ns_ = time_ns;
  count_ = count_ == 0 ? 1 : 2;
}

double AttitudePrediction::reach(TimeNs time_ns) const noexcept {
  const double ahead_s = seconds(time_ns - last_time_ns_);
  return 0.5 * ahead_s * (ahead_s + interval_s_);
}

double AttitudePrediction::farthest_seen(TimeNs time_ns) const noexcept {
  return acceleration_seen_ * reach(time_ns);
}

PredictedAttitude AttitudePrediction::at(TimeNs time_ns) const noexcept {
  const double ahead_s = seconds(time_ns - last_time_ns_);
  const double h = ahead_s / interval_s_;
  const double unmodelled = acceleration_sigma_ * reach(time_ns);
  PredictedAttitude prediction;
  prediction.rig_from_j2000 = (rotation_exp(h * turn_) * last_).normalized();
  prediction.covariance = (1 + h) * (1 + h) * covariance_ + h * h * covariance_before_ +
                          unmodelled * unmodelled * Eigen::Matrix3d::Identity();
  return prediction;
}

void PosePrediction::update(TimeNs time_ns, const Pose& rig_from_body, const Matrix6d& covariance) noexcept {
  if (count_ > 0 && time_ns <= last_time_ns_) return;
  if (count_ > 0) {
    interval_s_ = seconds(time_ns - last_time_ns_);
    turn_ = rotation_log(rig_from_body.rotation * last_.rotation.conjugate());
    step_ = rig_from_body.translation - last_.translation;
    covariance_before_ = covariance_;
  }
  last_ = rig_from_body;
  covariance_ = covariance;
  last_time_ns_ = time_ns;
  count_ = count_ == 0 ? 1 : 2;
}

PredictedPose PosePrediction::at(TimeNs time_ns) const noexcept {
  const double ahead_s = seconds(time_ns - last_time_ns_);
  const double h = ahead_s / interval_s_;
  const double reach = 0.5 * ahead_s * (ahead_s + interval_s_);
  PredictedPose prediction;
  prediction.rig_from_body.rotation = (rotation_exp(h * turn_) * last_.rotation).normalized();
  prediction.rig_from_body.translation = last_.translation + h * step_;
  prediction.covariance = (1 + h) * (1 + h) * covariance_ + h * h * covariance_before_;
  for (int i = 0; i < 3; ++i) {
    prediction.covariance(i, i) += angular_sigma_ * angular_sigma_ * reach * reach;
    prediction.covariance(i + 3, i + 3) += linear_sigma_ * linear_sigma_ * reach * reach;
  }
  return prediction;
}

}  // namespace omma
