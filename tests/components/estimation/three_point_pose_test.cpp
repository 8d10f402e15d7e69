#include "components/estimation/three_point_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "components/estimation/generalised_three_point.hpp"

namespace omma {
namespace {

struct Scene {
  ThreePoints sights;
  Pose truth;
};

Scene random_scene(std::mt19937_64& random, double baseline) {
  std::normal_distribution<double> gauss;
  const auto vector = [&](double size) {
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    return Eigen::Vector3d(size * x, size * y, size * z);
  };
  Scene scene;
  scene.truth.rotation = rotation_exp(vector(1.5));
  scene.truth.translation = vector(0.3) + Eigen::Vector3d(0, 0, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    scene.sights.point[i] = vector(0.3);
    scene.sights.origin[i] = vector(baseline);
    scene.sights.ray[i] = (scene.truth * scene.sights.point[i] - scene.sights.origin[i]).normalized();
  }
  return scene;
}

double distance(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + a.rotation.angularDistance(b.rotation);
}

template <std::size_t kMost, class Solver>
int solved_of(int trials, double baseline, Solver&& solver) {
  std::mt19937_64 random(5);
  int solved = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Scene scene = random_scene(random, baseline);
    std::array<Pose, kMost> poses;
    const int count = solver(scene.sights, poses);
    double nearest = 1e9;
    for (int i = 0; i < count; ++i) {
      const Pose& pose = poses[static_cast<std::size_t>(i)];
      nearest = std::min(nearest, distance(pose, scene.truth));
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d seen = pose * scene.sights.point[k] - scene.sights.origin[k];
        EXPECT_LT((seen.normalized() - scene.sights.ray[k]).norm(), 1e-5);
      }
    }
    solved += nearest < 1e-5 ? 1 : 0;
  }
  return solved;
}

TEST(ThreePointPose, OneCameraFindsTheTruePoseAndOnlyPosesThatFit) {
  EXPECT_GE(solved_of<kMostThreePointPoses>(20000, 0.0, central_three_point), 19950);
}

TEST(ThreePointPose, ARigOfAnySizeFindsTheTruePose) {
  // Centres from a hair's breadth apart to half the range: solutions that one camera in the middle would not
  // have are found as well.
  for (const double baseline : {1e-7, 1e-4, 0.005, 0.05, 0.2, 1.5})
    EXPECT_GE(solved_of<kMostGeneralisedPoses>(2000, baseline, generalised_three_point), 1980) << baseline;
}

TEST(ThreePointPose, RaysFromOneCentreAreTheCentralProblem) {
  EXPECT_GE(solved_of<kMostGeneralisedPoses>(2000, 0.0, generalised_three_point), 1995);
}

TEST(ThreePointPose, PointsInLineGiveNoPose) {
  ThreePoints sights;
  for (std::size_t i = 0; i < 3; ++i) {
    sights.origin[i].setZero();
    sights.point[i] = Eigen::Vector3d(0.1 * static_cast<double>(i), 0, 0);
    sights.ray[i] = (sights.point[i] + Eigen::Vector3d(0, 0, 1)).normalized();
  }
  std::array<Pose, kMostThreePointPoses> poses;
  EXPECT_EQ(central_three_point(sights, poses), 0);
  sights.origin[1].x() = 0.1;
  std::array<Pose, kMostGeneralisedPoses> more;
  EXPECT_EQ(generalised_three_point(sights, more), 0);
  sights.point[1].y() = std::nan("");
  EXPECT_EQ(generalised_three_point(sights, more), 0);
}

}  // namespace
}  // namespace omma
