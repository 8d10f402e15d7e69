// Rigs calibrated on cards: truth recovered with an honest covariance, better than from one image, wrong
// pairs left out, and what cannot be calibrated.
#include <gmock/gmock.h>

#include "components/geometry/rig_file.hpp"
#include "ground/report/statistics.hpp"
#include "tests/bench/room_of_cards.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

Rig dissertation() {
  return read_rig_file(OMMA_SOURCE_DIR "/config/rigs/dissertation.toml");
}

Vector6d error_of(const Pose& found, const Pose& truth) {
  Vector6d error;
  error << rotation_log(truth.rotation * found.rotation.conjugate()), truth.translation - found.translation;
  return error;
}

TEST(RigCalibration, IsFarBetterThanOneImageAndAsGoodAsItSays) {
  std::vector<double> nees;
  double joint = 0;
  double one = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const RoomOfCards room = room_of_cards(dissertation(), 12, 0.1, seed);
    const RigCalibration found = calibrate_rig(room.rig, room.bodies, room.views, {4.0, false});
    ASSERT_TRUE(found.done) << found.reason;
    for (std::size_t c = 1; c < 3; ++c) {
      const Vector6d error = error_of(found.rig.cameras[c].rig_from_camera, room.truth.rig_from_camera[c]);
      nees.push_back(squared_in_sigmas<6>(error, found.adjustment.camera_covariance(c)));
      joint += error.squaredNorm();
      if (found.one_image[c])
        one += error_of(*found.one_image[c], room.truth.rig_from_camera[c]).squaredNorm();
    }
  }
  const MeanNees mean = mean_nees(nees, 6);
  // Two cameras share what camera 0 saw: half as many independent samples as the interval counts on.
  EXPECT_GT(mean.mean, mean.low - 0.5);
  EXPECT_LT(mean.mean, mean.high + 0.5);
  EXPECT_LT(joint, 0.25 * one);
}

TEST(RigCalibration, FindsWhatTheDotsDoNotSayAboutThemselves) {
  RoomOfCards room = room_of_cards(dissertation(), 8, 0.3, 5);
  for (BodyView& view : room.views) {
    for (TargetSight& sight : view.sights) sight.covariance *= 1.0 / 9;  // they say 0.1 px
  }
  const RigCalibration found = calibrate_rig(room.rig, room.bodies, room.views, {});
  ASSERT_TRUE(found.done) << found.reason;
  EXPECT_NEAR(found.adjustment.floor_px, std::sqrt(0.09 - 0.01), 0.03);
  EXPECT_NEAR(found.adjustment.chi2 / found.adjustment.degrees, 1, 0.05);
}

TEST(RigCalibration, LeavesOutDotsTakenForTheWrongTarget) {
  RoomOfCards room = room_of_cards(dissertation(), 8, 0.1, 3);
  room.views[1].sights[4].pixel += Eigen::Vector2d(6, 0);
  room.views[3].sights[9].pixel += Eigen::Vector2d(0, -9);
  const RigCalibration found = calibrate_rig(room.rig, room.bodies, room.views, {});
  ASSERT_TRUE(found.done) << found.reason;
  EXPECT_EQ(found.adjustment.used[16 + 4], 0);
  EXPECT_EQ(found.adjustment.used[3 * 16 + 9], 0);
  EXPECT_LT(
      (found.rig.cameras[1].rig_from_camera.translation - room.truth.rig_from_camera[1].translation).norm(),
      1e-3);
}

TEST(RigCalibration, GoesOnFromTheGuessWhereNoChainTiesTheCameras) {
  const RoomOfCards room = room_of_cards(dissertation(), 12, 0.1, 4);
  // Only one card a set and camera, never one that another camera sees in that set, as with lone cards on the
  // walls.
  std::vector<BodyView> lone;
  for (const BodyView& view : room.views) {
    const bool first = std::none_of(lone.begin(), lone.end(), [&](const BodyView& v) {
      return v.set == view.set && (v.camera == view.camera || v.body == view.body);
    });
    if (first) lone.push_back(view);
  }
  Rig guess = room.rig;
  for (std::size_t c = 1; c < 3; ++c) {
    guess.cameras[c].rig_from_camera.rotation =
        (rotation_exp({0.03, -0.02, 0.01}) * guess.cameras[c].rig_from_camera.rotation).normalized();
    guess.cameras[c].rig_from_camera.translation += Eigen::Vector3d(0.01, 0.02, -0.01);
  }
  const RigCalibration found = calibrate_rig(guess, room.bodies, lone, {});
  ASSERT_TRUE(found.done) << found.reason;
  for (std::size_t c = 1; c < 3; ++c)
    EXPECT_LT(error_of(found.rig.cameras[c].rig_from_camera, room.truth.rig_from_camera[c]).norm(), 3e-3);
}

TEST(RigCalibration, SaysWhichCameraOrCardHangsLoose) {
  const RoomOfCards room = room_of_cards(dissertation(), 6, 0.1, 2);
  std::vector<BodyView> views;
  for (const BodyView& view : room.views)
    if (view.camera != 2) views.push_back(view);
  EXPECT_THAT(calibrate_rig(room.rig, room.bodies, views, {}).reason, testing::HasSubstr("cam2 saw no card"));
  EXPECT_THAT(calibrate_rig(room.rig, room.bodies + 1, room.views, {}).reason, testing::HasSubstr("card 7"));
}

}  // namespace
}  // namespace omma::ground
