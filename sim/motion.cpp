#include "sim/motion.hpp"

#include <algorithm>
#include <utility>

namespace omma::sim {

Motion Motion::constant(const Pose& start, const Eigen::Vector3d& velocity, const Eigen::Vector3d& rate) {
  Motion motion;
  motion.start_ = start;
  motion.velocity_ = velocity;
  motion.rate_ = rate;
  return motion;
}

Motion Motion::tumbling(std::shared_ptr<const Tumbling> turn, const Eigen::Vector3d& start,
                        const Eigen::Vector3d& velocity) {
  Motion motion;
  motion.tumbling_ = std::move(turn);
  motion.start_.translation = start;
  motion.velocity_ = velocity;
  return motion;
}

Motion Motion::through(std::vector<PoseKey> keys) {
  Motion motion;
  motion.keys_ = std::move(keys);
  return motion;
}

// Index of the key at or before `time`; the last segment also serves the times after it.
std::size_t Motion::segment(double time) const {
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), time,
                                      [](double t, const PoseKey& key) { return t < key.time; });
  const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - keys_.begin() - 1));
  return std::min(index, keys_.size() - 2);
}

Eigen::Vector3d Motion::tangent(std::size_t key) const {
  const std::size_t before = key == 0 ? 0 : key - 1;
  const std::size_t after = std::min(key + 1, keys_.size() - 1);
  return (keys_[after].pose.translation - keys_[before].pose.translation) /
         (keys_[after].time - keys_[before].time);
}

Pose Motion::at(double time) const {
  if (tumbling_) return {tumbling_->at(time).rotation, start_.translation + velocity_ * time};
  if (keys_.empty()) {
    return {(start_.rotation * rotation_exp(rate_ * time)).normalized(),
            start_.translation + velocity_ * time};
  }
  if (keys_.size() == 1 || time <= keys_.front().time) return keys_.front().pose;
  if (time >= keys_.back().time) return keys_.back().pose;
  const std::size_t k = segment(time);
  const PoseKey& a = keys_[k];
  const PoseKey& b = keys_[k + 1];
  const double span = b.time - a.time;
  const double s = (time - a.time) / span;
  const double s2 = s * s;
  const double s3 = s2 * s;
  const Eigen::Vector3d position = (2 * s3 - 3 * s2 + 1) * a.pose.translation +
                                   (s3 - 2 * s2 + s) * span * tangent(k) +
                                   (3 * s2 - 2 * s3) * b.pose.translation + (s3 - s2) * span * tangent(k + 1);
  return {a.pose.rotation.slerp(s, b.pose.rotation).normalized(), position};
}

Eigen::Vector3d Motion::rate(double time) const {
  if (tumbling_) return tumbling_->at(time).rate;
  if (keys_.empty()) return rate_;
  if (keys_.size() == 1 || time < keys_.front().time || time > keys_.back().time)
    return Eigen::Vector3d::Zero();
  const std::size_t k = segment(time);
  return rotation_log(keys_[k].pose.rotation.conjugate() * keys_[k + 1].pose.rotation) /
         (keys_[k + 1].time - keys_[k].time);
}

}  // namespace omma::sim
