// A direction that is as likely as any other.
#pragma once

#include <Eigen/Core>
#include <random>

namespace omma {

inline Eigen::Vector3d random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const double x = gauss(random);
  const double y = gauss(random);
  const double z = gauss(random);
  return Eigen::Vector3d(x, y, z).normalized();
}

}  // namespace omma
