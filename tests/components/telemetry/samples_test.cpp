// The components' messages as samples: what is claimed, culled, and how far off it is.
#include "components/telemetry/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "components/telemetry/frame_report.hpp"

namespace omma::telemetry {
namespace {

class Samples : public testing::Test {
 protected:
  Samples() {
    names_.cameras.push_back(Name("left"));
    names_.cameras.push_back(Name("right"));
    names_.bodies.push_back(Name("card"));
    report_ = std::make_unique<FrameReport>(names_);
    lists_ = std::make_unique<DotLists>();
    pairings_ = std::make_unique<Pairings>();
    lists_->frame = 12;
    lists_->time_ns = 1200;
    lists_->cameras.resize(2);
    for (DotList& list : lists_->cameras) list.status = FrameStatus::kFresh;
    lists_->cameras[1].dots.resize(3);
    lists_->cameras[1].dropped = 4;
    lists_->cameras[1].dots[2].pixel = {100.25, 7.5};
    lists_->cameras[1].dots[2].covariance << 0.25, 0.125, 0.125, 0.5;
  }

  std::span<omma_CameraDots> filled_dots() {
    fill(*lists_, 0, report_->dots[0]);
    fill(*lists_, 1, report_->dots[1]);
    return {report_->dots.data(), 2};
  }

  /// A star along x with 1 mrad bearing noise, paired with dot 2 of camera 1.
  static Pairing star_pair() {
    Pairing pair;
    pair.camera = 1;
    pair.dot = 2;
    pair.entry = 424;
    pair.sight.ray = Eigen::Vector3d::UnitX();
    pair.sight.whitener << 0, 1000, 0, 0, 0, 1000;
    pair.sight.point = Eigen::Vector3d::UnitX();
    return pair;
  }

  TelemetryNames names_;
  std::unique_ptr<FrameReport> report_;
  std::unique_ptr<DotLists> lists_;
  std::unique_ptr<Pairings> pairings_;
};

TEST_F(Samples, FrameSetTellsHowEachImageWasExposed) {
  Frames frames;
  frames.cameras.resize(2);
  frames.cameras[1].settings = {.exposure_ns = 2'500'000, .gain = 4, .black_level = 16};
  ExposureReport exposure;
  exposure.cameras.resize(2);
  exposure.cameras[1].automatic = true;
  exposure.cameras[1].state = ExposureState::kAtLimit;
  exposure.cameras[1].seen.full = 0.25;
  exposure.cameras[1].refused = 3;
  fill(frames, *lists_, *pairings_, report_->frame_set);
  EXPECT_EQ(report_->frame_set.cameras._buffer[1].exposure_state, omma_EXPOSURE_FIXED);
  fill(exposure, report_->frame_set);
  const omma_CameraStatus& right = report_->frame_set.cameras._buffer[1];
  EXPECT_FLOAT_EQ(right.exposure_ms, 2.5F);
  EXPECT_EQ(right.gain, 4);
  EXPECT_EQ(right.black_level_levels, 16);
  EXPECT_EQ(right.exposure_state, omma_EXPOSURE_AT_LIMIT);
  EXPECT_EQ(right.full_share, 0.25F);
  EXPECT_EQ(right.exposures_refused, 3U);
  EXPECT_EQ(report_->frame_set.cameras._buffer[0].exposure_state, omma_EXPOSURE_FIXED);
}

TEST_F(Samples, FrameSetCountsDotsAndPairsPerCamera) {
  Frames frames;
  frames.cameras.resize(2);
  frames.cameras[0].status = FrameStatus::kStuck;
  frames.cameras[1].status = FrameStatus::kFresh;
  frames.cameras[1].number = 12;
  pairings_->sky.state = TrackState::kTracking;
  pairings_->sky.pairs.push_back(star_pair());
  pairings_->unclaimed_dots = 2;
  BodyPairings body;
  body.pairs.push_back(Pairing{});
  pairings_->bodies.push_back(body);
  fill(frames, *lists_, *pairings_, report_->frame_set);
  const omma_FrameSet& out = report_->frame_set;
  EXPECT_EQ(out.frame, 12U);
  EXPECT_EQ(out.time_ns, 1200);
  EXPECT_EQ(out.sky_state, omma_TRACK_TRACKING);
  EXPECT_EQ(out.stars_paired, 1U);
  EXPECT_EQ(out.targets_paired, 1U);
  EXPECT_EQ(out.unclaimed_dots, 2U);
  ASSERT_EQ(out.cameras._length, 2U);
  EXPECT_STREQ(out.cameras._buffer[1].name, "right");
  EXPECT_EQ(out.cameras._buffer[0].state, omma_FRAME_STUCK);
  EXPECT_EQ(out.cameras._buffer[0].targets_paired, 1U);
  EXPECT_EQ(out.cameras._buffer[1].stars_paired, 1U);
  EXPECT_EQ(out.cameras._buffer[1].image_number, 12U);
  EXPECT_EQ(out.cameras._buffer[1].dots_kept, 3U);
  EXPECT_EQ(out.cameras._buffer[1].dots_found, 7U);
}

TEST_F(Samples, DotsOfAFrameThatIsNotFreshAreNotValid) {
  lists_->cameras[0].status = FrameStatus::kLate;
  filled_dots();
  EXPECT_FALSE(report_->dots[0].valid);
  EXPECT_TRUE(report_->dots[1].valid);
  EXPECT_EQ(report_->dots[1].camera, 1);
  EXPECT_EQ(report_->dots[1].dots._buffer[2].u_px, 100.25F);
  EXPECT_EQ(report_->dots[1].dots._buffer[2].covariance_vv_px2, 0.5F);
  EXPECT_EQ(report_->dots[1].dots._buffer[2].role, omma_DOT_UNPAIRED);
}

TEST_F(Samples, StarsResidualIsInSigmaAtThePublishedAttitude) {
  const auto cameras = filled_dots();
  pairings_->sky.pairs.push_back(star_pair());
  AttitudeEstimate attitude;
  attitude.valid = true;
  attitude.solution.rig_from_j2000 = rotation_exp({0, 0, 0.002});  // 2 mrad off, at 1 mrad σ
  attitude.used.push_back(0);
  claim(pairings_->sky, attitude, cameras);
  const omma_Dot& dot = cameras[1].dots._buffer[2];
  EXPECT_EQ(dot.role, omma_DOT_STAR);
  EXPECT_EQ(dot.entry, 424);
  EXPECT_TRUE(dot.culled);
  EXPECT_NEAR(dot.residual_sigma, 2.0, 1e-5);
  EXPECT_EQ(cameras[1].dots._buffer[1].role, omma_DOT_UNPAIRED);
}

TEST_F(Samples, PlanetsAndObjectsNameTheirDots) {
  const auto cameras = filled_dots();
  Pairing planet = star_pair();
  planet.dot = 1;
  planet.entry = 3;
  planet.persistence = 7;
  planet.since_ns = lists_->time_ns - 2'000'000'000;
  lists_->cameras[1].time_ns = lists_->time_ns;
  pairings_->sky.solar.push_back(planet);
  AttitudeEstimate attitude;
  claim(pairings_->sky, attitude, filled_dots());
  UnknownObjects objects;
  UnknownObject object;
  object.number = 42;
  object.sightings = 9;
  object.bearing.seen = true;
  object.bearing.dot.fill(-1);
  object.bearing.dot[1] = 0;
  object.bearing.flux = 12;
  objects.frame = 12;
  objects.valid = true;
  objects.objects.push_back(object);
  claim(objects, cameras);
  const omma_Dot* dots = cameras[1].dots._buffer;
  EXPECT_EQ(dots[1].role, omma_DOT_SOLAR_BODY);
  EXPECT_EQ(dots[1].entry, 3);
  EXPECT_EQ(dots[1].persistence, 7U);
  EXPECT_NEAR(dots[1].age_s, 2, 1e-6);
  EXPECT_EQ(dots[0].role, omma_DOT_OBJECT);
  EXPECT_EQ(dots[0].entry, 42);
  fill(objects, report_->objects);
  ASSERT_EQ(report_->objects.objects._length, 1U);
  EXPECT_EQ(report_->objects.objects._buffer[0].number, 42U);
  EXPECT_EQ(report_->objects.objects._buffer[0].cameras, 2);
  EXPECT_TRUE(report_->objects.objects._buffer[0].seen);
}

TEST_F(Samples, TargetsResidualIsSeenFromTheCamera) {
  const auto cameras = filled_dots();
  BodyPairings body;
  body.body = 0;
  Pairing pair = star_pair();
  pair.sight.origin = {1, 0, 0};
  pair.sight.point = {0, 0.003, 0};
  body.pairs.push_back(pair);
  PoseEstimate pose;
  pose.valid = true;
  pose.solution.rig_from_body.translation = {2, 0, 0};
  pose.used.push_back(1);
  claim(body, &pose, cameras);
  const omma_Dot& dot = cameras[1].dots._buffer[2];
  EXPECT_EQ(dot.role, omma_DOT_TARGET);
  EXPECT_FALSE(dot.culled);
  EXPECT_NEAR(dot.residual_sigma, 3.0, 1e-4);  // 3 mm at 1 m, at 1 mrad σ
}

TEST_F(Samples, WithoutASolutionADotIsPairedButNotJudged) {
  const auto cameras = filled_dots();
  pairings_->sky.pairs.push_back(star_pair());
  claim(pairings_->sky, AttitudeEstimate{}, cameras);
  EXPECT_EQ(cameras[1].dots._buffer[2].role, omma_DOT_STAR);
  EXPECT_FALSE(cameras[1].dots._buffer[2].culled);
  EXPECT_EQ(cameras[1].dots._buffer[2].residual_sigma, 0.0F);
}

TEST_F(Samples, PairOfADotThatIsNotThereIsPassedOver) {
  const auto cameras = filled_dots();
  Pairing pair = star_pair();
  pair.dot = 3;
  pairings_->sky.pairs.push_back(pair);
  pair.camera = 5;
  pairings_->sky.pairs.push_back(pair);
  claim(pairings_->sky, AttitudeEstimate{}, cameras);
  for (const omma_CameraDots& dots : cameras)
    for (std::uint32_t i = 0; i < dots.dots._length; ++i)
      EXPECT_EQ(dots.dots._buffer[i].role, omma_DOT_UNPAIRED);
}

TEST_F(Samples, MatricesAreRowAfterRow) {
  PoseEstimate pose;
  pose.valid = true;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) pose.integrity.rig.covariance(row, column) = 10 * row + column;
  omma_RelativePose out{};
  fill(pose, "card", out);
  EXPECT_EQ(out.covariance[1], 1.0);
  EXPECT_EQ(out.covariance[6], 10.0);
  EXPECT_EQ(out.covariance[35], 55.0);
  EXPECT_STREQ(out.body_name, "card");
}

TEST_F(Samples, PositionMayBeValidWhereTheRotationIsNot) {
  PoseEstimate pose;
  pose.position_valid = true;
  pose.solution.rig_from_body.translation = {0, 0, 40};
  pose.integrity.state = IntegrityState::kSound;
  pose.integrity.rig.protection_level << 1, 2, 3, 4, 5, 6;
  pose.integrity.suspect_dot = {2, 17};
  omma_RelativePose out{};
  fill(pose, "card", out);
  EXPECT_TRUE(out.valid);
  EXPECT_FALSE(out.rotation_valid);
  EXPECT_EQ(out.rig_position_m.z, -40);
  EXPECT_EQ(out.integrity.state, omma_INTEGRITY_SOUND);
  EXPECT_EQ(out.integrity.protection_rad.z, 3);
  EXPECT_EQ(out.integrity.protection_m.x, 4);
  EXPECT_EQ(out.integrity.suspect_dot_camera, 2);
  EXPECT_EQ(out.integrity.suspect_dot_entry, 17);
}

TEST_F(Samples, MotionSinceTheFirstPoseIsGivenWithItsFrame) {
  PoseEstimate pose;
  pose.motion.valid = true;
  pose.motion.first_frame = 12;
  pose.motion.since_first.translation = {1, 2, 3};
  pose.motion.since_first.rotation = Eigen::Quaterniond(0, 0, 1, 0);
  pose.motion.covariance(0, 1) = 5;
  omma_RelativePose out{};
  fill(pose, "card", out);
  EXPECT_TRUE(out.motion_valid);
  EXPECT_EQ(out.first_frame, 12U);
  EXPECT_EQ(out.motion.y, 1);
  EXPECT_EQ(out.motion_m.z, 3);
  EXPECT_EQ(out.motion_covariance[1], 5);
}

TEST_F(Samples, AttitudesCovarianceIsGivenInBothFrames) {
  AttitudeEstimate attitude;
  attitude.valid = true;
  attitude.solution.rig_from_j2000 = rotation_exp({0, 0, M_PI / 2});  // x of J2000 is y of the rig
  attitude.integrity.rig.covariance(1, 1) = 4;
  omma_Attitude out{};
  fill(attitude, out);
  EXPECT_EQ(out.covariance_rad2[4], 4);
  EXPECT_NEAR(out.covariance_j2000_rad2[0], 4, 1e-12);
  EXPECT_NEAR(out.covariance_j2000_rad2[4], 0, 1e-12);
}

TEST(SetText, IsCutToWhatFits) {
  char text[4];
  set_text(text, "abcdef");
  EXPECT_STREQ(text, "abc");
  set_text(text, "");
  EXPECT_STREQ(text, "");
}

TEST_F(Samples, MotionTellsEachAxisUnderItsName) {
  names_.axes.push_back(Name("z"));
  names_.axes.push_back(Name("y"));
  FrameReport report(names_);
  MotionReport motion;
  motion.valid = true;
  motion.time_ns = 77;
  motion.mode = MotionMode::kHoming;
  motion.late_ticks = 3;
  motion.board_lost = true;
  motion.axes.resize(2);
  motion.axes[1].state.angle = 0.5;
  motion.axes[1].goal.angle = 0.75;
  motion.axes[1].pulse = 6001;
  fill(motion, report.motion);
  EXPECT_EQ(report.motion.time_ns, 77);
  EXPECT_EQ(report.motion.mode, omma_MOTION_HOMING);
  EXPECT_EQ(report.motion.late_ticks, 3U);
  EXPECT_TRUE(report.motion.board_lost);
  ASSERT_EQ(report.motion.axes._length, 2U);
  EXPECT_STREQ(report.motion.axes._buffer[1].name, "y");
  EXPECT_EQ(report.motion.axes._buffer[1].angle_rad, 0.5);
  EXPECT_EQ(report.motion.axes._buffer[1].goal_rad, 0.75);
  EXPECT_EQ(report.motion.axes._buffer[1].pulse_quarter_us, 6001);
}

}  // namespace
}  // namespace omma::telemetry
