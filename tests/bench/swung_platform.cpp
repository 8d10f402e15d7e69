#include "tests/bench/swung_platform.hpp"

#include <cmath>
#include <random>

namespace omma {

SwungPlatform swung_platform(const Swing& swing, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  SwungPlatform result;
  // The camera looks along z; the gimbal stands 1.4 m before it, turned, its axes not quite square and up to
  // 7 mm apart.
  const Eigen::Quaterniond stand = rotation_exp({0.3, -0.5, 0.2});
  const Eigen::Vector3d middle(0.05, -0.08, 1.4);
  result.axes[0] = {stand * Eigen::Vector3d(0.02, 0.01, 1).normalized(), middle};
  result.axes[1] = {stand * Eigen::Vector3d(0.01, 1, -0.015).normalized(),
                    middle + stand * Eigen::Vector3d(0.004, 0, -0.001)};
  result.axes[2] = {stand * Eigen::Vector3d(1, -0.02, 0.01).normalized(),
                    middle + stand * Eigen::Vector3d(0, -0.003, 0.006)};
  const Pose home{stand * rotation_exp({0.1, 3.0, 0.2}), middle + stand * Eigen::Vector3d(0.03, 0.06, -0.09)};
  for (std::size_t a = 0; a < 3; ++a) {
    ground::TimedPoses& motion = result.motions[a];
    motion.what = "axis";
    for (int k = 0; k < swing.samples; ++k) {
      const double angle = 0.5 * swing.arc * std::sin(2 * M_PI * k / swing.samples);
      const Eigen::Quaterniond turn = rotation_exp(angle * result.axes[a].direction);
      Pose pose{turn * home.rotation,
                turn * (home.translation - result.axes[a].point) + result.axes[a].point};
      pose.rotation =
          rotation_exp(swing.turn_noise * Eigen::Vector3d(normal(random), normal(random), normal(random))) *
          pose.rotation;
      pose.translation +=
          swing.shift_noise * Eigen::Vector3d(normal(random), normal(random), 3 * normal(random));
      motion.samples.push_back({0.54 * k, pose});
    }
  }
  return result;
}

}  // namespace omma
