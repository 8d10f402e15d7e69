// How well a calibration knows its lens, as pixels against the angle off axis.
#include <Eigen/Dense>
#include <cmath>

#include "components/geometry/pose.hpp"
#include "ground/calibrate/sky_adjustment.hpp"

namespace omma::ground {
namespace {

constexpr Eigen::Index kAround = 12;

}  // namespace

std::vector<double> lens_deviations(const LensShape& shape, const Eigen::MatrixXd& covariance,
                                    const std::vector<double>& angles) {
  std::vector<double> deviations(angles.size(), 0.0);
  const std::optional<Lens> lens = shape.lens();
  if (!lens) return deviations;
  const auto size = shape.parameters.size();
  const Eigen::VectorXd steps = shape.steps();
  const auto rows = 2 * kAround * static_cast<Eigen::Index>(angles.size());
  Eigen::MatrixXd by_lens = Eigen::MatrixXd::Zero(rows, size);
  Eigen::MatrixXd by_turn = Eigen::MatrixXd::Zero(rows, 3);
  std::vector<int> seen(angles.size(), 0);
  std::vector<Lens> moved;
  for (Eigen::Index p = 0; p < size; ++p) {
    LensShape up = shape;
    up.parameters[p] += steps[p];
    moved.push_back(up.lens().value_or(*lens));
  }
  for (std::size_t a = 0; a < angles.size(); ++a) {
    for (Eigen::Index k = 0; k < kAround; ++k) {
      const double round = 2 * M_PI * (double(k) + 0.5) / kAround;
      const Eigen::Vector3d direction(std::sin(angles[a]) * std::cos(round),
                                      std::sin(angles[a]) * std::sin(round), std::cos(angles[a]));
      const auto row = 2 * (static_cast<Eigen::Index>(a) * kAround + k);
      Eigen::Vector2d pixel;
      Eigen::Matrix<double, 2, 3> by_direction;
      if (!lens->project(direction, pixel, by_direction)) continue;
      ++seen[a];
      by_turn.block<2, 3>(row, 0) = -by_direction * skew(direction);
      for (Eigen::Index p = 0; p < size; ++p) {
        Eigen::Vector2d other = pixel;
        moved[static_cast<std::size_t>(p)].project(direction, other);
        by_lens.block<2, 1>(row, p) = (other - pixel) / steps[p];
      }
    }
  }
  const Eigen::MatrixXd without_turn = by_lens - by_turn * by_turn.colPivHouseholderQr().solve(by_lens);
  const Eigen::MatrixXd spread = without_turn * covariance * without_turn.transpose();
  for (std::size_t a = 0; a < angles.size(); ++a) {
    if (seen[a] == 0) continue;
    const auto first = 2 * kAround * static_cast<Eigen::Index>(a);
    deviations[a] = std::sqrt(spread.diagonal().segment(first, 2 * kAround).sum() / (2 * seen[a]));
  }
  return deviations;
}

}  // namespace omma::ground
