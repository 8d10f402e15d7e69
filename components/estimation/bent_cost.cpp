#include "components/estimation/bent_cost.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double kReach = 3.0;   // σ along the valley
constexpr double kWidest = 9.0;  // times the variance
/// Holds the turn about the axis along which the valley was entered: times what the sights tell of it.
constexpr double kStiffness = 1e4;
/// The floor leaves the line by the square of the way; of a normal variable x the variance of b x² / k² is
/// b² E[x⁴] / k⁴.
constexpr double kSpreadOfSquare = 3 / (kReach * kReach * kReach * kReach);

}  // namespace

Matrix6d spread_of_bend(const Fit<kPoseUnknowns>& fit, const Matrix6d& covariance) noexcept {
  Matrix6d spread = Matrix6d::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance.topLeftCorner<3, 3>());  // ascending
  const Pose& lowest = fit.descent().pose;
  const double cost = fit.chi2();
  for (const int weak : {2, 1}) {
    const double variance = eigen.eigenvalues()[weak];
    if (!(variance > 0)) continue;
    const Eigen::Vector3d axis = eigen.eigenvectors().col(weak);
    // One σ about the axis, with what the other unknowns do along.
    const Vector6d way = covariance.leftCols<3>() * axis / std::sqrt(variance);
    NormalEquations<kPoseUnknowns> there = fit.equations_at(moved<kPoseUnknowns>(lowest, kReach * way));
    there.information.topLeftCorner<3, 3>() += kStiffness / variance * axis * axis.transpose();
    Vector6d to_floor;
    if (!damped_step<kPoseUnknowns>(there, 0, to_floor)) continue;
    const double rise = there.cost - to_floor.dot(there.information * to_floor) - cost;
    const double other_rise =
        fit.chi2_at(moved<kPoseUnknowns>(lowest, to_floor - kReach * way)) - cost;  // bent alike
    const double lower = std::max(std::min(rise, other_rise), kReach * kReach / kWidest);
    spread += std::max(kReach * kReach / lower - 1, 0.0) * way * way.transpose() +
              kSpreadOfSquare * to_floor * to_floor.transpose();
  }
  return spread;
}

}  // namespace omma
