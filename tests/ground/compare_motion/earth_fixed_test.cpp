// A rig at rest on the turning Earth: the Earth's turn is taken out of its attitudes, and measured from them.
#include <gtest/gtest.h>

#include <random>

#include "components/geometry/pose.hpp"
#include "ground/compare_motion/earth_fixed.hpp"
#include "sim/motion.hpp"

namespace omma::ground {
namespace {

const Eigen::Quaterniond kStart = Eigen::Quaterniond(0.8, 0.1, -0.5, 0.3).normalized();

std::vector<TimedAttitude> attitudes(double minutes, double noise, double rate_factor = 1) {
  const sim::Motion motion =
      sim::Motion::constant({kStart.conjugate(), Eigen::Vector3d::Zero()}, Eigen::Vector3d::Zero(),
                            rate_factor * earth_fixed_rate(kStart));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<TimedAttitude> all;
  for (double time = 0; time < 60 * minutes; time += 1) {
    const Eigen::Vector3d turn = noise * Eigen::Vector3d(normal(random), normal(random), normal(random));
    all.push_back({time, rotation_exp(turn) * motion.at(time).rotation.conjugate()});
  }
  return all;
}

TEST(EarthFixed, TheSimulatorsMotionStandsStillWhenDerotated) {
  const StationaryRig rig = stationary_rig(attitudes(10, 0));
  EXPECT_LT(rig.rms.norm(), 1e-10);
  EXPECT_NEAR(rig.rig_from_j2000.angularDistance(kStart), 0, 1e-10);
  EXPECT_NEAR(rig.measured_rate, kEarthRate, 1e-14);
}

TEST(EarthFixed, TheRateIsTheOneOfTheDissertation) {
  EXPECT_NEAR(earth_fixed_rate(kStart).norm() * 180 / M_PI * 60, 0.250684477337699, 1e-12);
}

TEST(EarthFixed, NoiseIsToldAsItIs) {
  const StationaryRig rig = stationary_rig(attitudes(10, 1e-4));
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(rig.rms[axis], 1e-4, 1e-5);
  EXPECT_LT(std::abs(rig.measured_rate - kEarthRate), 4 * rig.measured_rate_sigma);
  EXPECT_NEAR(rig.measured_rate_sigma, 1e-4 / (600 * std::sqrt(600.0 / 12)), 2e-9);
}

TEST(EarthFixed, AnotherRateIsMeasured) {
  const StationaryRig rig = stationary_rig(attitudes(10, 0, 1.01));
  EXPECT_NEAR(rig.measured_rate, 1.01 * kEarthRate, 1e-9 * kEarthRate);
  EXPECT_GT(rig.rms.z(), 1e-5);
}

}  // namespace
}  // namespace omma::ground
