// The reference methods for pose: exact without noise, at the same minimum where they share a cost.
#include <gtest/gtest.h>

#include <cmath>

#include "ground/methods/absolute_orientation.hpp"
#include "ground/methods/four_light_pose.hpp"
#include "ground/methods/map_ransac_pose.hpp"
#include "ground/methods/object_space_pose.hpp"
#include "ground/methods/ranges_pose.hpp"
#include "ground/methods/three_point_alone.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

RigProblemOptions without_noise(int cameras) {
  RigProblemOptions options;
  options.cameras = cameras;
  options.depth = 0.05;
  options.sigma_deg = 1e-9;
  return options;
}

double rotation_error(const PoseAnswer& answer, const RigProblem& problem) {
  return pose_error(answer.rig_from_body, problem.truth).head<3>().norm();
}

double position_error(const PoseAnswer& answer, const RigProblem& problem) {
  return pose_error(answer.rig_from_body, problem.truth).tail<3>().norm();
}

TEST(ReferencePose, IsExactWithoutNoise) {
  for (const int cameras : {1, 3}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const RigProblem problem = make_rig_problem(without_noise(cameras), seed);
      const PoseAnswer answers[] = {ranges_pose(problem.sights, problem.prior),
                                    object_space_pose(problem.sights, problem.prior),
                                    three_point_alone(problem.sights)};
      for (const PoseAnswer& answer : answers) {
        ASSERT_TRUE(answer.found);
        const std::ptrdiff_t which = &answer - answers;
        EXPECT_LT(rotation_error(answer, problem), 1e-4) << which << " seed " << seed;
        EXPECT_LT(position_error(answer, problem), 1e-4) << which << " seed " << seed;
      }
    }
  }
}

TEST(ReferencePose, RangesAsUnknownsAndObjectSpaceShareOneMinimum) {
  RigProblemOptions options;
  options.depth = 0.1;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RigProblem problem = make_rig_problem(options, seed);
    const PoseAnswer ranges = ranges_pose(problem.sights, problem.prior);
    const PoseAnswer eliminated = object_space_pose(problem.sights, problem.prior);
    ASSERT_TRUE(ranges.found && eliminated.found);
    const double cost = object_space_cost(problem.sights, eliminated.rig_from_body);
    EXPECT_NEAR(object_space_cost(problem.sights, ranges.rig_from_body) / cost, 1.0, 1e-5) << seed;
    EXPECT_LT(cost, object_space_cost(problem.sights, problem.truth));
  }
}

TEST(ReferencePose, FourLightsInAPlaneAreExactWithoutNoise) {
  RigProblemOptions options = without_noise(1);
  options.depth = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RigProblem problem = make_rig_problem(options, seed);
    std::array<Sight, 4> lights;
    ASSERT_TRUE(outermost_four(problem.sights, lights));
    const PoseAnswer answer = four_light_pose(lights);
    ASSERT_TRUE(answer.found);
    EXPECT_LT(rotation_error(answer, problem), 1e-6) << seed;
    EXPECT_LT(position_error(answer, problem), 1e-6) << seed;
  }
}

TEST(ReferencePose, FourLightsAreForOneCamera) {
  std::array<Sight, 4> lights;
  EXPECT_FALSE(outermost_four(make_rig_problem({}, 1).sights, lights));
  RigProblemOptions three;
  three.cameras = 1;
  three.targets = 3;
  EXPECT_FALSE(outermost_four(make_rig_problem(three, 1).sights, lights));
}

TEST(ReferencePose, MapRansacLeavesWrongPairsOutAndRepeatsItself) {
  RigProblemOptions options;
  options.outlier_fraction = 0.2;
  int near = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RigProblem problem = make_rig_problem(options, seed);
    MapRansacOptions refined;
    refined.refine = true;
    const PoseAnswer answer = map_ransac_pose(problem.sights, problem.prior, refined);
    const PoseAnswer again = map_ransac_pose(problem.sights, problem.prior, refined);
    EXPECT_EQ(answer.rig_from_body.translation, again.rig_from_body.translation);
    const double bound = std::sqrt(problem.bound.bottomRightCorner<3, 3>().trace());
    near += answer.found && position_error(answer, problem) < 6 * bound ? 1 : 0;
  }
  EXPECT_GE(near, 98);
}

TEST(ReferencePose, TwoPairsAreTooFew) {
  const RigProblem problem = make_rig_problem({}, 1);
  const auto two = std::span<const Sight>(problem.sights).first(2);
  EXPECT_FALSE(ranges_pose(two, problem.prior).found);
  EXPECT_FALSE(object_space_pose(two, problem.prior).found);
  EXPECT_FALSE(map_ransac_pose(two, problem.prior, {}).found);
  EXPECT_FALSE(three_point_alone(two).found);
}

TEST(AbsoluteOrientation, FindsTheMotionOfAFlatSet) {
  const Pose truth{rotation_exp({0.4, -2.0, 0.3}), {1, -2, 3}};
  const Eigen::Vector3d from[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-1, 1, 0}};
  Eigen::Vector3d to[4];
  for (std::size_t i = 0; i < 4; ++i) to[i] = truth * from[i];
  const Pose found = absolute_orientation(from, to);
  EXPECT_LT(pose_error(found, truth).norm(), 1e-12);
}

}  // namespace
}  // namespace omma
