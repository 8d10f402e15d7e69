// A free body: energy and momentum stay, a symmetric top nutates as it should, the middle axis is unstable.
#include "sim/tumbling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "components/geometry/pose.hpp"
#include "sim/motion.hpp"

namespace omma::sim {
namespace {

Eigen::Matrix3d skewed_inertia() {
  Eigen::Matrix3d inertia;
  inertia << 0.05, 0.004, -0.003, 0.004, 0.04, 0.002, -0.003, 0.002, 0.03;
  return inertia;
}

TEST(Tumbling, KeepsEnergyAndAngularMomentum) {
  const Eigen::Matrix3d inertia = skewed_inertia();
  const Tumbling body({rotation_exp({0.3, -1, 0.5}), {0.4, -0.7, 0.2}}, inertia, 600);
  const Tumbling::State start = body.at(0);
  const double energy = start.rate.dot(inertia * start.rate);
  const Eigen::Vector3d momentum = start.rotation * (inertia * start.rate);
  for (double t = 0; t <= 650; t += 37) {  // beyond the table too
    const Tumbling::State state = body.at(t);
    EXPECT_NEAR(state.rate.dot(inertia * state.rate) / energy, 1, 1e-8) << t;
    EXPECT_LT((state.rotation * (inertia * state.rate) - momentum).norm() / momentum.norm(), 1e-8) << t;
  }
}

TEST(Tumbling, RateIsTheTurnOfTheAttitude) {
  const Tumbling body({Eigen::Quaterniond::Identity(), {0.4, -0.7, 0.2}}, skewed_inertia(), 100);
  for (double t = -0.05; t < 90; t += 13.7) {
    const Eigen::Vector3d turn =
        rotation_log(body.at(t - 0.005).rotation.conjugate() * body.at(t + 0.005).rotation);
    EXPECT_LT((turn / 0.01 - body.at(t).rate).norm(), 1e-5) << t;
  }
}

// Goldstein, section 5.6: w goes round the axis of symmetry at (I3 - I1)/I1 w3.
TEST(Tumbling, SymmetricTopNutatesAtItsRate) {
  const Eigen::Matrix3d inertia = Eigen::Vector3d(0.03, 0.03, 0.05).asDiagonal();
  const Tumbling body({Eigen::Quaterniond::Identity(), {0.1, 0, 0.6}}, inertia, 60);
  const double rate = (0.05 - 0.03) / 0.03 * 0.6;
  for (double t = 0; t < 60; t += 7) {
    const Eigen::Vector3d w = body.at(t).rate;
    EXPECT_NEAR(w.x(), 0.1 * std::cos(rate * t), 1e-8);
    EXPECT_NEAR(w.y(), 0.1 * std::sin(rate * t), 1e-8);
    EXPECT_NEAR(w.z(), 0.6, 1e-10);
  }
}

TEST(Tumbling, TurnsOverAboutTheMiddleAxisOnly) {
  const Eigen::Matrix3d inertia = Eigen::Vector3d(0.02, 0.03, 0.04).asDiagonal();
  const auto least = [&](int axis) {
    Eigen::Vector3d rate = Eigen::Vector3d::Constant(1e-3);
    rate[axis] = 1;
    const Tumbling body({Eigen::Quaterniond::Identity(), rate}, inertia, 60);
    double lowest = 1;
    for (double t = 0; t < 60; t += 0.25) lowest = std::min(lowest, body.at(t).rate[axis]);
    return lowest;
  };
  EXPECT_GT(least(0), 0.99);
  EXPECT_LT(least(1), -0.99);
  EXPECT_GT(least(2), 0.99);
}

TEST(Tumbling, IsTheSameWhateverTheDurationOfItsTable) {
  const Tumbling::State start{Eigen::Quaterniond::Identity(), {0.4, -0.7, 0.2}};
  const Tumbling brief(start, skewed_inertia(), 1);
  const Tumbling lasting(start, skewed_inertia(), 100);
  EXPECT_LT((brief.at(50).rate - lasting.at(50).rate).norm(), 1e-9);
  EXPECT_LT(rotation_log(brief.at(50).rotation.conjugate() * lasting.at(50).rotation).norm(), 1e-9);
}

TEST(Inertia, OfABodyIsToldFromOneThatNoBodyHas) {
  EXPECT_TRUE(is_inertia(skewed_inertia()));
  EXPECT_FALSE(is_inertia(Eigen::Vector3d(0.01, 0.01, 0.05).asDiagonal()));  // I3 > I1 + I2
  EXPECT_FALSE(is_inertia(Eigen::Vector3d(-0.01, 0.01, 0.01).asDiagonal()));
  Eigen::Matrix3d lopsided = skewed_inertia();
  lopsided(0, 1) = 0.01;
  EXPECT_FALSE(is_inertia(lopsided));
}

}  // namespace
}  // namespace omma::sim
