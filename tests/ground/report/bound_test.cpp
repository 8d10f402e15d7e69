// The Cramér–Rao bound: closed forms where there are any, and least squares on Gaussian dots, which reaches
// it.
#include "ground/report/bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "components/estimation/least_squares.hpp"
#include "components/geometry/rig_dot.hpp"
#include "ground/report/exposure_shift.hpp"

namespace omma::ground {
namespace {

constexpr double kFocal = 300;  // [px/rad]

const SpotChoice kEverySpot = [](const TruthSpot&) { return true; };

/// Two fisheyes that look apart, away from the rig's origin.
Rig two_cameras() {
  Rig rig;
  const Lens lens = Lens::equidistant(768, 576, kFocal, {383.5, 287.5}, 1.4);
  rig.cameras.push_back({Name("a"), lens, {Eigen::Quaterniond::Identity(), {0.05, 0, 0}}});
  rig.cameras.push_back({Name("b"), lens, {rotation_exp({0.2, 1.3, 0.1}), {-0.1, 0.02, 0.03}}});
  return rig;
}

Eigen::Matrix2d information_of_sigma(double sigma_px, double ratio = 1) {
  return Eigen::Vector2d(1 / (sigma_px * sigma_px), ratio / (sigma_px * sigma_px)).asDiagonal();
}

TruthSpot star_at(int camera, const Eigen::Vector2d& pixel, const Eigen::Matrix2d& information) {
  TruthSpot spot;
  spot.camera = camera;
  spot.pixel = pixel;
  spot.snr = 20;
  spot.information = information;
  return spot;
}

TargetBody card() {
  TargetBody body;
  body.name = Name("card");
  for (int i = 0; i < 12; ++i) {
    Target target;
    target.id = Name("T" + std::to_string(i));
    target.position = {0.05 * (i % 4) - 0.08, 0.05 * (i / 4) - 0.04, i % 5 == 0 ? 0.03 : 0.0};
    body.targets.push_back(target);
  }
  return body;
}

/// The spots of the card's targets in every camera that sees them.
std::vector<TruthSpot> spots_of(const Rig& rig, const TargetBody& body, const Pose& rig_from_body) {
  std::vector<TruthSpot> spots;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    const Pose camera_from_body = rig.cameras[camera].rig_from_camera.inverse() * rig_from_body;
    for (std::size_t i = 0; i < body.targets.size(); ++i) {
      TruthSpot spot;
      if (!rig.cameras[camera].lens.project(camera_from_body * body.targets[i].position, spot.pixel))
        continue;
      spot.kind = TruthSpot::Kind::kTarget;
      spot.camera = static_cast<int>(camera);
      spot.body = body.name.view();
      spot.id = body.targets[i].id.view();
      spot.snr = 20;
      spot.information = information_of_sigma(0.02 + 0.01 * static_cast<double>(i % 3), 0.7);
      spot.information(0, 1) = spot.information(1, 0) = 0.2 * spot.information(0, 0);
      spots.push_back(spot);
    }
  }
  return spots;
}

/// The sight of a dot at the spot's pixel with Gaussian noise of the spot's covariance.
Sight noisy_sight(const Rig& rig, const TruthSpot& spot, const Eigen::Vector3d& point,
                  std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Dot dot;
  dot.covariance = spot.information.inverse();
  const Eigen::Matrix2d spread = dot.covariance.llt().matrixL();
  const double first = normal(random);
  dot.pixel = spot.pixel + spread * Eigen::Vector2d(first, normal(random));
  const auto camera = static_cast<std::size_t>(spot.camera);
  RigDot seen;
  EXPECT_TRUE(rig_dot(dot, 0, rig.cameras[camera], static_cast<std::uint8_t>(camera), 0, seen));
  return {seen.origin, seen.ray, seen.whitener, point};
}

SolveOptions without_cull() {
  SolveOptions options;
  options.gate = 20;
  options.second_minimum = SecondMinimum::kIgnore;
  return options;
}

TEST(AttitudeBound, OfAStarOnTheAxisIsItsPixelErrorOverTheFocalLengthAndNothingAboutRoll) {
  Rig rig;
  rig.cameras.push_back({Name("a"), Lens::equidistant(768, 576, kFocal, {383.5, 287.5}, 1.4), {}});
  const std::vector<TruthSpot> spots{star_at(0, {383.5, 287.5}, information_of_sigma(0.1, 4))};
  const Eigen::Matrix3d information = attitude_information(rig, spots, kEverySpot);
  // A turn about x moves the star along v (with information 4 / 0.1²), about y along u.
  EXPECT_NEAR(information(0, 0), 4 * kFocal * kFocal / 0.01, 1e-3);
  EXPECT_NEAR(information(1, 1), kFocal * kFocal / 0.01, 1e-3);
  EXPECT_NEAR(information(2, 2), 0, 1e-6);
  Eigen::Matrix3d covariance;
  EXPECT_FALSE(bound_of(information, covariance)) << "one star does not fix three angles";
}

TEST(AttitudeBound, IsThatOfACameraTurnedWithItsRig) {
  Rig rig;
  const Eigen::Quaterniond rig_from_camera = rotation_exp({0.3, -0.8, 1.1});
  const Lens lens = Lens::equidistant(768, 576, kFocal, {383.5, 287.5}, 1.4);
  rig.cameras.push_back({Name("a"), lens, {}});
  const std::vector<TruthSpot> spots{star_at(0, {100, 200}, information_of_sigma(0.1)),
                                     star_at(0, {600, 400}, information_of_sigma(0.2))};
  const Eigen::Matrix3d straight = attitude_information(rig, spots, kEverySpot);
  rig.cameras[0].rig_from_camera.rotation = rig_from_camera;
  const Eigen::Matrix3d turned = attitude_information(rig, spots, kEverySpot);
  const Eigen::Matrix3d r = rig_from_camera.toRotationMatrix();
  EXPECT_LT((turned - r * straight * r.transpose()).norm(), 1e-9 * straight.norm());
}

TEST(AttitudeBound, IsReachedByLeastSquaresOnGaussianDots) {
  const Rig rig = two_cameras();
  const Eigen::Quaterniond rig_from_j2000 = rotation_exp({0.4, 2.0, -0.7});
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<TruthSpot> spots;
  for (int i = 0; i < 16; ++i)
    spots.push_back(star_at(i % 2, {120 + 520 * unit(random), 60 + 460 * unit(random)},
                            information_of_sigma(0.02 + 0.1 * unit(random), 0.5 + unit(random))));
  Eigen::Matrix3d bound;
  ASSERT_TRUE(bound_of(attitude_information(rig, spots, kEverySpot), bound));
  constexpr int kTrials = 4000;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Sight> sights;
    for (const TruthSpot& spot : spots) {
      const RigCamera& camera = rig.cameras[static_cast<std::size_t>(spot.camera)];
      Eigen::Vector3d ray;
      ASSERT_TRUE(camera.lens.bearing(spot.pixel, ray));
      const Eigen::Vector3d star = rig_from_j2000.conjugate() * (camera.rig_from_camera.rotation * ray);
      sights.push_back(noisy_sight(rig, spot, star, random));
    }
    const AttitudeSolution solution = solve_attitude(sights, rig_from_j2000, without_cull(), {});
    ASSERT_EQ(solution.status, SolveStatus::kSolved);
    const Eigen::Vector3d error = rotation_log(rig_from_j2000 * solution.rig_from_j2000.conjugate());
    scatter += error * error.transpose() / kTrials;
  }
  // Scatter in units of the bound: the identity within what 4000 trials can tell (1/√4000 is 0.016).
  const Eigen::Matrix3d whitener = Eigen::Matrix3d(bound.llt().matrixL()).inverse();
  EXPECT_LT((whitener * scatter * whitener.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
            0.08);
}

TEST(PoseBound, IsReachedByLeastSquaresOnGaussianDots) {
  const Rig rig = two_cameras();
  const TargetBody body = card();
  const Pose rig_from_body{rotation_exp({2.6, 0.3, -0.2}), {0.5, 0.1, 0.7}};
  const std::vector<TruthSpot> spots = spots_of(rig, body, rig_from_body);
  ASSERT_GT(spots.size(), body.targets.size()) << "seen by both cameras";
  Matrix6d bound;
  ASSERT_TRUE(bound_of(pose_information(rig, spots, body, rig_from_body, kEverySpot), bound));
  std::mt19937_64 random(12);
  constexpr int kTrials = 4000;
  Matrix6d scatter = Matrix6d::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Sight> sights;
    for (const TruthSpot& spot : spots) {
      const auto index = static_cast<std::size_t>(std::stoi(spot.id.substr(1)));
      sights.push_back(noisy_sight(rig, spot, body.targets[index].position, random));
    }
    const PoseSolution solution = solve_pose(sights, rig_from_body, without_cull(), {});
    ASSERT_EQ(solution.status, SolveStatus::kSolved);
    Vector6d error;
    error << rotation_log(rig_from_body.rotation * solution.rig_from_body.rotation.conjugate()),
        rig_from_body.translation - solution.rig_from_body.translation;
    scatter += error * error.transpose() / kTrials;
  }
  const Matrix6d whitener = Matrix6d(bound.llt().matrixL()).inverse();
  EXPECT_LT((whitener * scatter * whitener.transpose() - Matrix6d::Identity()).cwiseAbs().maxCoeff(), 0.1);
}

TEST(PoseBound, TwiceTheRangeIsFourTimesTheErrorAlongTheLineOfSight) {
  Rig rig;
  rig.cameras.push_back({Name("a"), Lens::equidistant(768, 576, kFocal, {383.5, 287.5}, 1.4), {}});
  TargetBody body = card();
  for (Target& target : body.targets) target.position *= 0.1;  // small against the range: the far-field laws
  const auto sigma = [&](double range) {
    const Pose pose{rotation_exp({2.2, 0.4, 0.0}), {0, 0, range}};
    std::vector<TruthSpot> spots = spots_of(rig, body, pose);
    for (TruthSpot& spot : spots) spot.information = information_of_sigma(0.05);
    Matrix6d bound;
    EXPECT_TRUE(bound_of(pose_information(rig, spots, body, pose, kEverySpot), bound));
    return Vector6d(bound.diagonal().cwiseSqrt());
  };
  const Vector6d near = sigma(1);
  const Vector6d far = sigma(2);
  EXPECT_NEAR(far[5] / near[5], 4, 0.1) << "along";
  EXPECT_NEAR(far[3] / near[3], 2, 0.05) << "across";
}

TEST(Bound, CountsOnlyTheSpotsChosen) {
  const Rig rig = two_cameras();
  std::vector<TruthSpot> spots{star_at(0, {100, 100}, information_of_sigma(0.1)),
                               star_at(0, {600, 300}, information_of_sigma(0.1)),
                               star_at(1, {300, 500}, information_of_sigma(0.1))};
  const SpotChoice choice = detectable({5, 7});
  const Eigen::Matrix3d all = attitude_information(rig, spots, choice);
  spots[0].snr = 4.99;
  spots[2].snr = 6.99;
  const Eigen::Matrix3d one = attitude_information(rig, {spots.data() + 1, 1}, kEverySpot);
  EXPECT_TRUE(attitude_information(rig, spots, choice).isApprox(one));
  EXPECT_FALSE(all.isApprox(one));
  spots[1].kind = TruthSpot::Kind::kMoon;
  EXPECT_TRUE(attitude_information(rig, spots, choice).isZero()) << "the Moon is no star";
}

TEST(Bound, TargetsOfAnotherBodyTellNothing) {
  const Rig rig = two_cameras();
  TargetBody body = card();
  const Pose pose{rotation_exp({2.6, 0.3, -0.2}), {0.5, 0.1, 0.7}};
  const std::vector<TruthSpot> spots = spots_of(rig, body, pose);
  body.name = Name("other");
  EXPECT_TRUE(pose_information(rig, spots, body, pose, kEverySpot).isZero());
}

// Spots all over both images, and what their exposures show of an uneven turn.
TruthFrame swung(const Rig& rig, double information_of_b) {
  TruthFrame frame;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera)
    for (int i = 0; i < 9; ++i)
      frame.spots.push_back(star_at(static_cast<int>(camera), {200.0 + 180 * (i % 3), 120.0 + 170 * (i / 3)},
                                    (camera == 0 ? 1 : information_of_b) * information_of_sigma(0.1)));
  frame.exposures = {{{1e-4, -2e-4, 3e-4}, {}}, {{-5e-4, 1e-4, 2e-4}, {}}};
  return frame;
}

TEST(ExposureShift, FollowsTheCameraThatKnowsMost) {
  const Rig rig = two_cameras();
  TruthFrame frame = swung(rig, 1e-9);
  EXPECT_LT((attitude_shift(rig, frame, frame.spots) + frame.exposures[0].turn).norm(), 1e-10);
  frame = swung(rig, 1e9);
  EXPECT_LT((attitude_shift(rig, frame, frame.spots) + frame.exposures[1].turn).norm(), 1e-10);
  frame = swung(rig, 1);
  frame.exposures[1].turn = frame.exposures[0].turn;
  EXPECT_LT((attitude_shift(rig, frame, frame.spots) + frame.exposures[0].turn).norm(), 1e-10);
  frame.exposures.clear();
  EXPECT_EQ(attitude_shift(rig, frame, frame.spots), Eigen::Vector3d::Zero());
}

TEST(ExposureShift, OfABodyIsItsOwn) {
  const Rig rig = two_cameras();
  const TargetBody body = card();
  TruthFrame frame;
  frame.bodies = {{"card", {rotation_exp({3.0, 0.2, 0.1}), {0.3, 0.1, 1.2}}}};
  frame.spots = spots_of(rig, body, frame.bodies[0].rig_from_body);
  Vector6d move;
  move << 1e-3, -2e-3, 1e-3, 1e-4, 2e-4, -3e-4;
  frame.exposures = {{{}, {move}}, {{}, {move}}};
  EXPECT_LT((pose_shift(rig, frame, frame.spots, body, 0) + move).norm(), 1e-9);
}

}  // namespace
}  // namespace omma::ground
