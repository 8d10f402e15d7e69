// The dissertation's way to an axis: the trace of a point far out on the platform, its plane by principal
// components, and a circle in that plane.
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "ground/calibrate/axis_fit.hpp"

namespace omma::ground {
namespace {

constexpr int kIterations = 30;

// Direction about which the platform turned: the mean of its turns against the first sample, by length.
Eigen::Vector3d rough_direction(const TimedPoses& motion) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const TimedPose& s : motion.samples) {
    const Eigen::Vector3d turn =
        rotation_log(s.pose.rotation * motion.samples.front().pose.rotation.conjugate());
    sum += turn * turn.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(2);
}

// The circle whose distances to the points are least: algebraic (Kasa), then Gauss-Newton on the distances.
Eigen::Vector2d circle_centre(const std::vector<Eigen::Vector2d>& points) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd right(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)];
    matrix.row(i) << 2 * p.x(), 2 * p.y(), 1;
    right[i] = p.squaredNorm();
  }
  const Eigen::Vector3d algebraic = matrix.colPivHouseholderQr().solve(right);
  Eigen::Vector3d circle(algebraic.x(), algebraic.y(),
                         std::sqrt(std::max(0.0, algebraic.z() + algebraic.head<2>().squaredNorm())));
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      const Eigen::Vector2d out = points[static_cast<std::size_t>(i)] - circle.head<2>();
      matrix.row(i) << -out.normalized().transpose(), -1;
      right[i] = circle.z() - out.norm();
    }
    const Eigen::Vector3d step = matrix.colPivHouseholderQr().solve(right);
    if (!step.allFinite()) break;
    circle += step;
    if (step.norm() < 1e-12 * circle.z()) break;
  }
  return circle.head<2>();
}

}  // namespace

Axis circle_axis(const TimedPoses& motion, double distance) {
  const Eigen::Vector3d about = rough_direction(motion);
  const Eigen::Vector3d out =
      motion.samples.front().pose.rotation.conjugate() * tangent_basis(about).col(0);  // of the platform
  std::vector<Eigen::Vector3d> trace;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const TimedPose& s : motion.samples) {
    trace.push_back(s.pose * (distance * out));
    mean += trace.back() / static_cast<double>(motion.samples.size());
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : trace) spread += (p - mean) * (p - mean).transpose();
  const Eigen::Matrix3d components = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  const Eigen::Matrix<double, 3, 2> plane = components.rightCols<2>();
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(trace.size());
  for (const Eigen::Vector3d& p : trace) flat.emplace_back(plane.transpose() * (p - mean));
  Axis axis;
  axis.direction = components.col(0);
  axis.point = mean + plane * circle_centre(flat);
  // Angles are positive from the first sample to the one farthest from it; of two alike, to the earlier.
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
  for (const TimedPose& s : motion.samples) {
    const Eigen::Vector3d turn =
        rotation_log(s.pose.rotation * motion.samples.front().pose.rotation.conjugate());
    if (turn.norm() > (1 + 1e-6) * farthest.norm()) farthest = turn;
  }
  if (axis.direction.dot(farthest) < 0) axis.direction = -axis.direction;
  return axis;
}

}  // namespace omma::ground
