#include "ground/calibrate/normal_equations.hpp"

#include <Eigen/Cholesky>

namespace omma::ground {

bool solve_scaled(const NormalEquations& sums, double damping, Eigen::VectorXd& step,
                  Eigen::MatrixXd* covariance) {
  const Eigen::VectorXd diagonal = sums.information.diagonal();
  if (!(diagonal.minCoeff() > 0)) return false;
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * sums.information * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  const Eigen::LDLT<Eigen::MatrixXd> factor(scaled);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-14)) return false;
  step = scale.asDiagonal() * factor.solve(scale.asDiagonal() * sums.gradient);
  if (covariance != nullptr) {
    *covariance = scale.asDiagonal() * factor.solve(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols())) *
                  scale.asDiagonal();
  }
  return step.allFinite();
}

}  // namespace omma::ground
