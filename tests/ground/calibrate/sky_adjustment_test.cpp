// Lenses and rigs adjusted to stars: simulated dots with known truth and noise.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "components/catalogue/star_catalogue.hpp"
#include "components/geometry/lens_file.hpp"
#include "components/geometry/pose.hpp"
#include "ground/calibrate/sky_adjustment.hpp"
#include "ground/design/even_sphere.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = M_PI / 180;

LensShape true_kb4() {
  LensShape shape = equidistant_shape(1024, 768, 273, 95 * kDegree);
  shape.parameters << 509.3, 385.8, 273.4, 1.0007, -0.02, 0.004, -0.001, 0.0002;
  return shape;
}

SkyRig true_rig(int cameras, int frames) {
  SkyRig rig;
  const auto attitudes = even_attitudes(17);
  for (int c = 0; c < cameras; ++c) {
    rig.lenses.push_back(true_kb4());
    rig.camera_from_rig.push_back(c == 0 ? Eigen::Quaterniond::Identity()
                                         : rotation_exp(Eigen::Vector3d(1.9 * c, 0.2, -0.1)));
  }
  for (int f = 0; f < frames; ++f) rig.rig_from_j2000.push_back(attitudes[static_cast<std::size_t>(f + 3)]);
  return rig;
}

std::vector<StarSight> seen_by(const SkyRig& rig, double magnitude, double sigma, unsigned seed) {
  const StarCatalogue catalogue({}, {static_cast<float>(magnitude), 0});
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<StarSight> sights;
  for (std::size_t f = 0; f < rig.rig_from_j2000.size(); ++f) {
    for (std::size_t c = 0; c < rig.lenses.size(); ++c) {
      const Lens lens = rig.lenses[c].lens().value();
      for (const SkyStar& star : catalogue.stars()) {
        Eigen::Vector2d pixel;
        if (!lens.project(rig.camera_from_rig[c] * (rig.rig_from_j2000[f] * star.direction), pixel)) continue;
        pixel += sigma * Eigen::Vector2d(normal(random), normal(random));
        sights.push_back({static_cast<int>(f), static_cast<int>(c), star.hr, star.direction, pixel,
                          sigma * sigma * Eigen::Matrix2d::Identity(), 50});
      }
    }
  }
  return sights;
}

SkyRig disturbed(const SkyRig& truth) {
  SkyRig rig = truth;
  for (LensShape& shape : rig.lenses) {
    shape = equidistant_shape(shape.width, shape.height, 268, shape.max_angle);
  }
  for (std::size_t c = 1; c < rig.camera_from_rig.size(); ++c)
    rig.camera_from_rig[c] = rotation_exp(Eigen::Vector3d(0.01, -0.02, 0.015)) * rig.camera_from_rig[c];
  for (Eigen::Quaterniond& q : rig.rig_from_j2000) q = rotation_exp(Eigen::Vector3d(-0.01, 0.006, 0.01)) * q;
  return rig;
}

// The estimate's error in the order of the covariance, true minus estimated.
Eigen::VectorXd error_of(const SkyRig& truth, const SkyRig& found, Eigen::Index size) {
  Eigen::VectorXd error(size);
  Eigen::Index at = 0;
  for (std::size_t c = 0; c < truth.lenses.size(); ++c) {
    const auto count = truth.lenses[c].parameters.size();
    error.segment(at, count) = truth.lenses[c].parameters - found.lenses[c].parameters;
    at += count;
  }
  for (std::size_t c = 1; c < truth.camera_from_rig.size(); ++c, at += 3)
    error.segment<3>(at) = rotation_log(truth.camera_from_rig[c] * found.camera_from_rig[c].conjugate());
  for (std::size_t f = 0; f < truth.rig_from_j2000.size(); ++f, at += 3)
    error.segment<3>(at) = rotation_log(truth.rig_from_j2000[f] * found.rig_from_j2000[f].conjugate());
  return error;
}

TEST(SkyAdjustment, FindsALensFromAPlainEquidistantStart) {
  const SkyRig truth = true_rig(1, 1);
  const auto sights = seen_by(truth, 5, 0, 1);
  SkyAdjustment found = adjust_to_sky(disturbed(truth), sights, {});
  ASSERT_TRUE(found.converged);
  EXPECT_LT(found.rms_px, 1e-4);
  EXPECT_LT((found.rig.lenses[0].parameters - truth.lenses[0].parameters).cwiseAbs().maxCoeff(), 1e-2);
}

// Lens, camera turns and attitudes together: their errors are as large as the covariance says.
TEST(SkyAdjustment, OfARigHasHonestCovariance) {
  const SkyRig truth = true_rig(2, 2);
  double sum = 0;
  constexpr int kTrials = 12;
  Eigen::Index unknowns = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto sights = seen_by(truth, 4, 0.1, 100U + static_cast<unsigned>(trial));
    const SkyAdjustment found = adjust_to_sky(disturbed(truth), sights, {});
    ASSERT_TRUE(found.converged);
    EXPECT_LT(found.floor_px, 0.03);  // nothing beyond the dots' own noise
    unknowns = found.covariance.rows();
    const Eigen::VectorXd error = error_of(truth, found.rig, unknowns);
    const Eigen::VectorXd scale = found.covariance.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd correlation = scale.asDiagonal() * found.covariance * scale.asDiagonal();
    const Eigen::VectorXd scaled = scale.cwiseProduct(error);
    sum += scaled.dot(correlation.ldlt().solve(scaled));
  }
  EXPECT_EQ(unknowns, 8 + 8 + 3 + 6);
  const double nees = sum / kTrials;  // mean 25, standard deviation √(50 / 12) = 2.0
  EXPECT_GT(nees, 25 - 3.5 * 2.05);
  EXPECT_LT(nees, 25 + 3.5 * 2.05);
}

TEST(SkyAdjustment, TellsTheErrorThatDotsDoNotKnowOf) {
  const SkyRig truth = true_rig(1, 1);
  auto sights = seen_by(truth, 5, 0.2, 7);
  for (StarSight& sight : sights) sight.covariance = 0.02 * 0.02 * Eigen::Matrix2d::Identity();
  const SkyAdjustment found = adjust_to_sky(disturbed(truth), sights, {});
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.floor_px, 0.2, 0.02);
  EXPECT_NEAR(found.chi2 / found.degrees, 1, 0.05);
}

TEST(SkyAdjustment, LeavesWrongPairsOut) {
  const SkyRig truth = true_rig(1, 1);
  auto sights = seen_by(truth, 5, 0.1, 8);
  for (std::size_t i = 0; i < sights.size(); i += 15) sights[i].pixel += Eigen::Vector2d(3, -2);
  const SkyAdjustment found = adjust_to_sky(disturbed(truth), sights, {});
  ASSERT_TRUE(found.converged);
  for (std::size_t i = 0; i < sights.size(); i += 15) EXPECT_EQ(found.used[i], 0) << i;
  EXPECT_LT(found.rms_px, 0.17);
}

TEST(SkyAdjustment, OfTooFewStarsIsNotCalledConverged) {
  const SkyRig truth = true_rig(1, 1);
  auto sights = seen_by(truth, 5, 0.1, 8);
  sights.resize(4);
  EXPECT_FALSE(adjust_to_sky(truth, sights, {}).converged);
}

TEST(LensShape, OfOneModelIsNearTheOtherOverTheWholeImage) {
  const LensShape kb4 = true_kb4();
  const LensShape ocam = nearest_shape(kb4.lens().value(), LensModel::kOcam, 95 * kDegree);
  const Lens a = kb4.lens().value();
  const Lens b = ocam.lens().value();
  const LensShape back = nearest_shape(b, LensModel::kKannalaBrandt, 95 * kDegree);
  const Lens c = back.lens().value();
  for (int angle = 1; angle <= 90; angle += 4) {
    for (const double round : {0.0, 1.1, 2.2, 3.3, 4.4, 5.5}) {
      const double theta = angle * kDegree;
      const Eigen::Vector3d ray(std::sin(theta) * std::cos(round), std::sin(theta) * std::sin(round),
                                std::cos(theta));
      Eigen::Vector2d at_a;
      Eigen::Vector2d at_b;
      Eigen::Vector2d at_c;
      if (!a.project(ray, at_a)) continue;
      ASSERT_TRUE(b.project(ray, at_b) && c.project(ray, at_c));
      EXPECT_LT((at_a - at_b).norm(), 0.05) << angle;
      EXPECT_LT((at_a - at_c).norm(), 0.05) << angle;
    }
  }
}

TEST(LensFileText, IsReadBackAsTheSameLens) {
  const Lens kb4 = true_kb4().lens().value();
  LensShape shape = nearest_shape(kb4, LensModel::kOcam, 95 * kDegree);
  shape.parameters[3] = 2e-4;  // skew
  const Lens ocam = shape.lens().value();
  const Lens kb4_back = lens_from_kalibr(lens_file_text(kb4), "kb4.yaml", "");
  const Lens ocam_back = lens_from_ocamcalib(lens_file_text(ocam), "ocam.txt");
  for (int angle = 0; angle <= 85; angle += 5) {
    const Eigen::Vector3d ray(std::sin(angle * kDegree) * 0.6, std::sin(angle * kDegree) * 0.8,
                              std::cos(angle * kDegree));
    for (const auto& [one, other] : {std::pair{&kb4, &kb4_back}, std::pair{&ocam, &ocam_back}}) {
      Eigen::Vector2d at;
      Eigen::Vector2d at_back;
      if (!one->project(ray, at)) continue;
      ASSERT_TRUE(other->project(ray, at_back));
      EXPECT_LT((at - at_back).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace omma::ground
