// The axis that a platform turns about, from its poses while that axis alone moves (Miller's algorithm 2), by
// least squares over all of the pose: A(t) = turn(u, c, angle(t)) A(0). The dissertation's own way, a circle
// through the trace of a point far out on the platform, gives the start and is told beside it. Sources:
// Miller 2012, algorithm 2; Gander, Golub & Strebel 1994, Least-Squares Fitting of Circles and Ellipses;
// Förstner 1979 (variance components).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ground/compare_motion/timed_poses.hpp"

namespace omma::ground {

/// A line in the frame on the left of the poses: the camera's that watches.
struct Axis {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit; angles are positive about it
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< of the line, nearest to the platform [m]
};

struct AxisFit {
  bool found = false;
  std::string reason;  ///< why not, in a sentence
  Axis axis;
  /// Of two tilts of the direction [rad] and two shifts of the point [m], along tangent_basis(direction).
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  Axis circle;                        ///< the dissertation's way
  double arc = 0;                     ///< from the smallest to the largest angle [rad]
  std::vector<double> times;          ///< of the samples [s]
  std::vector<double> angles;         ///< against the first sample [rad]
  std::vector<Vector6d> residuals;    ///< measured less fitted: small turn [rad], shift [m]
  Vector6d rms = Vector6d::Zero();    ///< of the residuals
  Vector6d sigma = Vector6d::Zero();  ///< of one measured pose, from the residuals and what they leave free

  /// Standard deviation of the direction and of the point across the axis, both directions together.
  double direction_sigma() const { return std::sqrt(covariance.topLeftCorner<2, 2>().trace()); }
  double point_sigma() const { return std::sqrt(covariance.bottomRightCorner<2, 2>().trace()); }
};

inline constexpr double kVirtualPoint = 200 * 0.0254;  ///< the dissertation's distance, 200 inches [m]

/// @param motion  frame_from_platform over time, one axis moving, at least six samples
AxisFit fit_axis(const TimedPoses& motion);

/// The dissertation's circle alone. @param distance  of the virtual point from the platform's origin [m]
Axis circle_axis(const TimedPoses& motion, double distance);

/// An axis moved by two tilts and two shifts along tangent_basis(direction).
Axis moved(const Axis& axis, const Eigen::Vector4d& step);

}  // namespace omma::ground
