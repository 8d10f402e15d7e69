// Motion of a body through time: constant velocity and turn, free tumbling, or key poses with a spline
// between them. The rig is such a body in J2000, a docking card one in the rig's frame or in J2000.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "components/geometry/pose.hpp"
#include "sim/tumbling.hpp"

namespace omma::sim {

struct PoseKey {
  double time = 0;  ///< [s] since the first frame
  Pose pose;        ///< frame_from_body
};

class Motion {
 public:
  Motion() = default;
  /// @param start     frame_from_body at time 0
  /// @param velocity  of the body's origin, in the frame [m/s]
  /// @param rate      turn of the body against the frame, body axes [rad/s]
  static Motion constant(const Pose& start, const Eigen::Vector3d& velocity, const Eigen::Vector3d& rate);
  /// A rigid body without torque; the frame is inertial.
  /// @param start     of the body's origin at time 0 [m]
  /// @param velocity  of it, in the frame [m/s]
  static Motion tumbling(std::shared_ptr<const Tumbling> turn, const Eigen::Vector3d& start,
                         const Eigen::Vector3d& velocity);
  /// Through keys with rising times, at least one: cubic Hermite in the position (finite-difference
  /// tangents), spherical linear between the rotations; held before the first and after the last.
  static Motion through(std::vector<PoseKey> keys);

  /// frame_from_body at `time` [s].
  Pose at(double time) const;
  /// Turn of the body against the frame, body axes [rad/s].
  Eigen::Vector3d rate(double time) const;

 private:
  std::size_t segment(double time) const;
  Eigen::Vector3d tangent(std::size_t key) const;

  Pose start_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  std::shared_ptr<const Tumbling> tumbling_;
  std::vector<PoseKey> keys_;
};

}  // namespace omma::sim
