// The normal equations of a weighted least squares, solved with their unknowns scaled alike: pixels, radians,
// metres and coefficients differ by many orders. Source: Triggs et al. 2000, Bundle Adjustment (Gauss–Newton
// with Levenberg's damping).
#pragma once

#include <Eigen/Core>

namespace omma::ground {

struct NormalEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  double cost = 0;
};

/// @param damping     added to the diagonal of the scaled matrix
/// @param covariance  the inverse of the information where not nullptr
/// @return false where the unknowns do not follow
bool solve_scaled(const NormalEquations& sums, double damping, Eigen::VectorXd& step,
                  Eigen::MatrixXd* covariance);

}  // namespace omma::ground
