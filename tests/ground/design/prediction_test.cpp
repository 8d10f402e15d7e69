// Prediction: the information of sights on paper is that of the report's bound, and Monte Carlo through the
// flight solver agrees with what is predicted, calibration errors included.
#include "ground/design/prediction.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "components/catalogue/target_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "ground/design/even_sphere.hpp"
#include "ground/design/expected_accuracy.hpp"
#include "ground/report/bound.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kDotSigma = 0.1;

const PaperRig& rig() {
  static const PaperRig paper =
      with_fields(read_rig_file(OMMA_SOURCE_DIR "/config/rigs/dissertation.toml"), {152.8, 187, 187});
  return paper;
}
const TargetBody& card() {
  static const TargetBody body = read_target_file(OMMA_SOURCE_DIR "/config/targets/docking_card.tsv");
  return body;
}
const StarCatalogue& stars() {
  static const StarCatalogue catalogue({}, {4.0F, 0});
  return catalogue;
}

CalibrationError coarse() {
  CalibrationError error;
  error.camera_rotation = 0.02 * kDegree;
  error.camera_position = 5e-4;
  error.lens_scale = 5e-4;
  error.lens_bend = 5e-4;
  error.survey = 2e-4;
  error.survey_scale = 1e-3;
  return error;
}

TEST(Prediction, OfThePoseWithoutCalibrationErrorIsTheReportsBound) {
  const Pose pose = facing_camera(rig(), 0, 1.3, 20 * kDegree, 15 * kDegree);
  const auto predicted = predict_pose(rig(), card(), pose, kDotSigma, {});
  ASSERT_TRUE(predicted);
  std::vector<TruthSpot> spots;
  for (std::size_t c = 0; c < rig().rig.cameras.size(); ++c) {
    const Pose camera_from_body = rig().rig.cameras[c].rig_from_camera.inverse() * pose;
    for (const Target& target : card().targets) {
      TruthSpot spot;
      spot.kind = TruthSpot::Kind::kTarget;
      spot.camera = static_cast<int>(c);
      spot.body = card().name.view();
      spot.id = target.id.view();
      spot.information = Eigen::Matrix2d::Identity() / (kDotSigma * kDotSigma);
      if (rig().sees(c, camera_from_body * target.position, spot.pixel)) spots.push_back(spot);
    }
  }
  Matrix6d bound;
  ASSERT_TRUE(bound_of(
      pose_information(rig().rig, spots, card(), pose, [](const TruthSpot&) { return true; }), bound));
  EXPECT_EQ(predicted->dots, spots.size());
  EXPECT_LT((predicted->noise - bound).norm(), 1e-4 * bound.norm());
  EXPECT_EQ(predicted->noise, predicted->total);
}

TEST(Prediction, OfThePoseIsWhatMonteCarloFinds) {
  const Pose pose = facing_camera(rig(), 0, 1.3, 30 * kDegree);
  for (const CalibrationError& error : {CalibrationError{}, coarse()}) {
    const MonteCarloCheck check = check_pose(rig(), card(), pose, kDotSigma, error, 400, 3);
    EXPECT_EQ(check.solved, 400);
    EXPECT_NEAR(check.position_ratio, 1, 0.1);
    EXPECT_NEAR(check.rotation_ratio, 1, 0.1);
    EXPECT_NEAR(check.nees, 6, 0.7);
  }
}

TEST(Prediction, OfTheAttitudeIsWhatMonteCarloFinds) {
  const std::vector<Eigen::Quaterniond> attitudes = even_attitudes(20);
  for (const CalibrationError& error : {CalibrationError{}, coarse()}) {
    const MonteCarloCheck check = check_attitude(rig(), stars().stars(), attitudes, kDotSigma, error, 400, 5);
    EXPECT_EQ(check.solved, 400);
    EXPECT_NEAR(check.rotation_ratio, 1, 0.08);
    EXPECT_NEAR(check.nees, 3, 0.4);
  }
}

TEST(Prediction, OfABodyOutOfSightIsNone) {
  PaperRig one = rig();
  one.rig.cameras.resize(1);
  EXPECT_FALSE(predict_pose(one, card(), {Eigen::Quaterniond::Identity(), {0, 0, -3}}, kDotSigma, {}));
}

}  // namespace
}  // namespace omma::ground
