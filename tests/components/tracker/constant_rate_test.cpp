// Prediction at constant rate, and how well it knows what it predicts.
#include "components/tracker/constant_rate.hpp"

#include <gtest/gtest.h>

#include <random>

namespace omma {
namespace {

constexpr TimeNs kStep = 100'000'000;  // 0.1 s

TEST(AttitudePrediction, IsReadyOnceTheRateIsKnownAndNotAfterAReset) {
  AttitudePrediction prediction(0.01);
  const Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  EXPECT_FALSE(prediction.ready());
  prediction.update(kStep, q, Eigen::Matrix3d::Zero());
  EXPECT_FALSE(prediction.ready());
  prediction.update(kStep, q, Eigen::Matrix3d::Zero());  // the same instant again says nothing new
  EXPECT_FALSE(prediction.ready());
  prediction.update(2 * kStep, q, Eigen::Matrix3d::Zero());
  EXPECT_TRUE(prediction.ready());
  prediction.reset();
  EXPECT_FALSE(prediction.ready());
}

TEST(AttitudePrediction, FollowsAConstantTurnExactly) {
  const Eigen::Quaterniond start = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
  const Eigen::Vector3d rate(0.2, -0.4, 0.1);  // rad/s, rig frame
  const auto truth = [&](TimeNs t) { return rotation_exp(1e-9 * double(t) * rate) * start; };
  AttitudePrediction prediction(0);
  prediction.update(kStep, truth(kStep), Eigen::Matrix3d::Zero());
  prediction.update(2 * kStep, truth(2 * kStep), Eigen::Matrix3d::Zero());
  for (const TimeNs t : {3 * kStep, 5 * kStep, 20 * kStep}) {
    EXPECT_LT(prediction.at(t).rig_from_j2000.angularDistance(truth(t)), 1e-12);
    EXPECT_EQ(prediction.at(t).covariance, Eigen::Matrix3d::Zero());
  }
}

TEST(AttitudePrediction, SaysHowFarTheRigMayGoByWhatItWasSeenToDo) {
  AttitudePrediction prediction(1.0);
  const auto at = [](double t) { return rotation_exp({0, 0, 0.5 * 0.02 * t * t}); };  // 0.02 rad/s²
  for (int k = 1; k <= 3; ++k) {
    EXPECT_TRUE(std::isinf(prediction.farthest_seen(k * kStep)));
    prediction.update(k * kStep, Eigen::Quaterniond(at(0.1 * k)), Eigen::Matrix3d::Zero());
  }
  EXPECT_NEAR(prediction.farthest_seen(4 * kStep), 0.02 * 0.1 * 0.1, 1e-9);
  // At rest from now on: the first step stops it, the second halves what is remembered of that.
  const double stopping = prediction.at(4 * kStep).rig_from_j2000.angularDistance(at(0.3));
  for (int k = 4; k <= 6; ++k)
    prediction.update(k * kStep, Eigen::Quaterniond(at(0.3)), Eigen::Matrix3d::Zero());
  EXPECT_NEAR(prediction.farthest_seen(7 * kStep), 0.25 * stopping, 1e-9);
  prediction.reset();
  EXPECT_TRUE(std::isinf(prediction.farthest_seen(7 * kStep)));
}

TEST(AttitudePrediction, CovarianceIsThatOfTheErrorsOfManyTrials) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> gauss;
  constexpr double kSigma = 1e-4;
  const Eigen::Matrix3d covariance = kSigma * kSigma * Eigen::Matrix3d::Identity();
  const auto noisy = [&] {
    const double x = gauss(random);
    const double y = gauss(random);
    const double z = gauss(random);
    return rotation_exp(kSigma * Eigen::Vector3d(x, y, z));
  };
  constexpr int kTrials = 4000;
  double nees = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    AttitudePrediction prediction(0);
    prediction.update(kStep, noisy(), covariance);
    prediction.update(2 * kStep, noisy(), covariance);
    const PredictedAttitude ahead = prediction.at(3 * kStep + kStep / 2);
    const Eigen::Vector3d error = rotation_log(ahead.rig_from_j2000);
    nees += error.dot(ahead.covariance.inverse() * error);
  }
  // χ² with 3 degrees of freedom; the mean of 4000 has a standard deviation of 0.039.
  EXPECT_NEAR(nees / kTrials, 3, 0.16);
}

TEST(AttitudePrediction, CountsWithTheAccelerationItDoesNotModel) {
  constexpr double kAcceleration = 0.02;  // rad/s²
  AttitudePrediction prediction(kAcceleration);
  const auto truth = [](double t) { return rotation_exp({0.5 * kAcceleration * t * t, 0, 0}); };
  prediction.update(kStep, truth(0.1), Eigen::Matrix3d::Zero());
  prediction.update(2 * kStep, truth(0.2), Eigen::Matrix3d::Zero());
  const PredictedAttitude ahead = prediction.at(5 * kStep);
  const double error = ahead.rig_from_j2000.angularDistance(truth(0.5));
  EXPECT_NEAR(error, std::sqrt(ahead.covariance(0, 0)),
              1e-9);  // one sigma of acceleration, one sigma of error
}

TEST(PosePrediction, FollowsAConstantMotionExactly) {
  const Eigen::Vector3d rate(0.1, 0.3, -0.2);
  const Eigen::Vector3d velocity(0.05, -0.02, -0.4);
  const auto truth = [&](TimeNs t) {
    const double s = 1e-9 * double(t);
    return Pose{rotation_exp(s * rate), Eigen::Vector3d(1, 2, 5) + s * velocity};
  };
  PosePrediction prediction(0, 0);
  prediction.update(kStep, truth(kStep), Matrix6d::Zero());
  EXPECT_FALSE(prediction.ready());
  prediction.update(2 * kStep, truth(2 * kStep), Matrix6d::Zero());
  ASSERT_TRUE(prediction.ready());
  const PredictedPose ahead = prediction.at(6 * kStep);
  EXPECT_LT(ahead.rig_from_body.rotation.angularDistance(truth(6 * kStep).rotation), 1e-12);
  EXPECT_LT((ahead.rig_from_body.translation - truth(6 * kStep).translation).norm(), 1e-12);
}

}  // namespace
}  // namespace omma
