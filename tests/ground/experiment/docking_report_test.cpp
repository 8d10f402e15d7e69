// The spread of trials: means, deviations between trials, and what chance makes of them.
#include <gtest/gtest.h>

#include <cmath>

#include "fsw/kernel/input_error.hpp"
#include "ground/experiment/docking.hpp"

namespace omma::ground {
namespace {

DockingTrial trial(double rms, double bound, std::size_t frames) {
  DockingTrial t;
  t.pose.rms = Vector6d::Constant(rms);
  t.pose.bound_rms = Vector6d::Constant(bound);
  t.pose.points.resize(frames);
  t.attitude.rms = Eigen::Vector3d::Constant(3 * rms);
  t.attitude.bound_rms = Eigen::Vector3d::Constant(3 * bound);
  return t;
}

TEST(TrialSpread, IsMeanAndDeviationOfTheTrials) {
  const TrialSpread s = trial_spread({trial(1, 0.6, 50), trial(2, 0.8, 50), trial(3, 0.8, 50)});
  EXPECT_EQ(s.rms.size(), 3U);
  EXPECT_DOUBLE_EQ(s.mean[0], 2);
  EXPECT_DOUBLE_EQ(s.deviation[3], 1);
  EXPECT_NEAR(s.bound[5], std::sqrt((0.36 + 0.64 + 0.64) / 3), 1e-12);
  EXPECT_NEAR(s.expected_deviation[1], 2 / std::sqrt(100.0), 1e-12);
  EXPECT_DOUBLE_EQ(s.mean[8], 6);  // the attitude
  EXPECT_DOUBLE_EQ(s.deviation[6], 3);
}

TEST(DockingTrial, OfARunWithoutABodyIsRefused) {
  EXPECT_THROW(docking_trial(ChainRun{}), InputError);
  ChainRun run;
  run.evaluation.poses.emplace_back();
  EXPECT_THROW(docking_trial(run), InputError);
}

TEST(DockingPage, TellsEveryAxis) {
  const std::string page = docking_page(trial(1, 0.5, 1), {}, {});
  for (const char* axis : {"position along rig x", "rotation about rig z", "attitude about rig y"})
    EXPECT_NE(page.find(axis), std::string::npos) << axis;
}

}  // namespace
}  // namespace omma::ground
