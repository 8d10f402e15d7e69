// Free turning of a rigid body: Euler's equations without torque, for any inertia, with the attitude that
// goes with it. Source: Goldstein, Poole & Safko, Classical Mechanics, 3rd ed. 2002, section 5.6. Integrated
// by the classical Runge-Kutta method of fourth order in steps of a hundredth of a radian.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace omma::sim {

class Tumbling {
 public:
  struct State {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< frame_from_body, the frame inertial
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();                ///< body axes [rad/s]
  };

  /// @param start     at time 0
  /// @param inertia   about the centre of mass, body axes; positive definite, its scale does not matter
  /// @param duration  times to this [s] are quick to look up; later ones are integrated from there each time
  Tumbling(const State& start, const Eigen::Matrix3d& inertia, double duration);

  State at(double time) const;  ///< [s]

  /// Steps that a duration takes at a rate: what the table's size goes by.
  static double steps(const Eigen::Vector3d& rate, const Eigen::Matrix3d& inertia, double duration);

 private:
  State advance(const State& state, double time) const;
  State one_step(const State& state, double step) const;

  Eigen::Matrix3d inertia_, inverse_;
  double step_;               // [s]
  std::vector<State> nodes_;  // every kStride steps from time 0
};

/// Whether a matrix can be the inertia of a body: symmetric, positive, each principal moment no more than the
/// two others together.
bool is_inertia(const Eigen::Matrix3d& inertia);

}  // namespace omma::sim
