// Lenses from views of a board: simulated corners with known truth and noise, for each of the three models.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "components/geometry/lens_file.hpp"
#include "ground/calibrate/board_adjustment.hpp"

namespace omma::ground {
namespace {

LensShape truth_of(LensModel model) {
  LensShape kb4 = equidistant_shape(1280, 960, 300, 3.1);
  kb4.parameters << 645.2, 472.9, 352.4, 1.001, -0.03, 0.004, -0.001, 0.0002;
  if (model == LensModel::kKannalaBrandt) return kb4;
  if (model == LensModel::kOcam) return nearest_shape(kb4.lens().value(), model, 3.0);
  LensShape caltech{LensModel::kCaltech, 1280, 960, 3.1, Eigen::VectorXd(10)};
  caltech.parameters << 645.2, 472.9, 852.4, 1.001, 0.0002, -0.21, 0.08, 0.0004, -0.0003, -0.01;
  return caltech;
}

std::vector<BoardView> views_of(const LensShape& shape, double sigma, unsigned seed) {
  const Lens lens = shape.lens().value();
  const double reach = shape.model == LensModel::kCaltech ? 0.35 : 0.9;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<BoardView> views;
  for (int k = 0; k < 12; ++k) {
    const double round = 0.9 * k;
    const double away = k == 0 ? 0 : reach;
    const Eigen::Vector3d ray(std::sin(away) * std::cos(round), std::sin(away) * std::sin(round),
                              std::cos(away));
    const Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray);
    const Pose pose{
        (facing * rotation_exp({0.5 * std::sin(1.3 * k), 0.5 * std::cos(2.1 * k), 0.7 * k})).normalized(),
        (0.45 + 0.02 * k) * ray};
    BoardView view;
    view.name = "view" + std::to_string(k);
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 9; ++column) {
        const Eigen::Vector3d point(0.03 * (column - 4), 0.03 * (row - 2.5), 0);
        Eigen::Vector2d pixel;
        if (!lens.project(pose * point, pixel)) continue;
        view.points.push_back(point);
        view.pixels.push_back(pixel + sigma * Eigen::Vector2d(normal(random), normal(random)));
      }
    }
    if (view.points.size() >= 12) views.push_back(view);
  }
  return views;
}

class BoardCalibrationOf : public testing::TestWithParam<LensModel> {};

TEST_P(BoardCalibrationOf, FindsTheLensFromTheCornersAlone) {
  const LensShape truth = truth_of(GetParam());
  const auto views = views_of(truth, 0, 1);
  ASSERT_GE(views.size(), 8U);
  const BoardCalibration found = calibrate_from_boards(views, 1280, 960, GetParam());
  ASSERT_EQ(found.reason, "");
  EXPECT_LT(found.adjustment.rms_px, 1e-3);
  EXPECT_NEAR(found.adjustment.shape.parameters[0], 645.2, 0.01);
}

TEST_P(BoardCalibrationOf, HasAnHonestCovariance) {
  const LensShape truth = truth_of(GetParam());
  double sum = 0;
  constexpr int kTrials = 3;
  const auto n = truth.parameters.size();
  for (unsigned trial = 0; trial < kTrials; ++trial) {
    const BoardCalibration found =
        calibrate_from_boards(views_of(truth, 0.1, 50 + trial), 1280, 960, GetParam());
    ASSERT_EQ(found.reason, "");
    EXPECT_NEAR(found.adjustment.rms_px, 0.1 * std::sqrt(2.0), 0.015);
    const Eigen::VectorXd error = found.adjustment.shape.parameters - truth.parameters;
    const Eigen::VectorXd scale = found.adjustment.lens_covariance.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd correlation =
        scale.asDiagonal() * found.adjustment.lens_covariance * scale.asDiagonal();
    const Eigen::VectorXd scaled = scale.cwiseProduct(error);
    sum += scaled.dot(correlation.ldlt().solve(scaled));
  }
  const double deviation = std::sqrt(2.0 * double(n) / kTrials);
  EXPECT_NEAR(sum / kTrials, double(n), 3.5 * deviation);
}

TEST_P(BoardCalibrationOf, WritesALensFileThatIsReadBack) {
  const Lens lens = truth_of(GetParam()).lens().value();
  const std::string text = lens_file_text(lens);
  const Lens back = GetParam() == LensModel::kOcam      ? lens_from_ocamcalib(text, "a.txt")
                    : GetParam() == LensModel::kCaltech ? lens_from_bouguet(text, "a.m")
                                                        : lens_from_kalibr(text, "a.yaml", "");
  for (double angle = 0; angle < 0.4; angle += 0.05) {
    Eigen::Vector2d a;
    Eigen::Vector2d b;
    const Eigen::Vector3d ray(0.6 * std::sin(angle), -0.8 * std::sin(angle), std::cos(angle));
    ASSERT_TRUE(lens.project(ray, a) && back.project(ray, b));
    EXPECT_LT((a - b).norm(), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, BoardCalibrationOf,
                         testing::Values(LensModel::kKannalaBrandt, LensModel::kOcam, LensModel::kCaltech));

TEST(BoardCalibration, OfCornersThatNoLensExplainsSaysSo) {
  std::vector<BoardView> views = views_of(truth_of(LensModel::kKannalaBrandt), 0, 1);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> anywhere(0, 900);
  for (BoardView& view : views) {
    for (Eigen::Vector2d& pixel : view.pixels) pixel = {anywhere(random), anywhere(random)};
  }
  EXPECT_NE(calibrate_from_boards(views, 1280, 960, LensModel::kOcam).reason, "");
}

}  // namespace
}  // namespace omma::ground
