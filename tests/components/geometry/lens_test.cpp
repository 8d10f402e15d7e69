// The lens models: both directions agree, the Jacobians are the derivatives, nothing folds over.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "components/geometry/lens.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

static_assert(std::is_trivially_copyable_v<Lens>);

struct NamedLens {
  std::string name;
  Lens lens;
};

void PrintTo(const NamedLens& named, std::ostream* out) {  // NOLINT: GoogleTest's name
  *out << named.name;
}

Eigen::Matrix2d affine(double a, double b, double c, double d) {
  Eigen::Matrix2d m;
  m << a, b, c, d;
  return m;
}

std::vector<NamedLens> lenses() {
  const std::vector<double> wide = {259.5395, 0, -1.626945e-03, 2.328091e-06, -6.601777e-09};
  const CaltechModel::Coefficients barrel = {-0.31, 0.12, 0.0011, -0.0008, -0.02};
  return {
      {"pinhole 90", Lens::pinhole(640, 480, 90 * kDegree)},
      {"equidistant 187", Lens::equidistant(1024, 768, 313.7, {511.5, 383.5}, 93.5 * kDegree)},
      {"equidistant 220", Lens::equidistant(800, 800, 200, {399.5, 401.5}, 110 * kDegree)},
      {"ocam 190", Lens::ocam(752, 480, {364.43, 229.58}, affine(1, -0.0016, -0.0012, 1.0003), wide)},
      {"caltech barrel", Lens::caltech(768, 576, {420, 424}, {380.2, 290.7}, 0.002, barrel)},
      {"kb4 kalibr",
       Lens::kannala_brandt(640, 480, {274.5, 275.3}, {313.6, 251.6}, {-0.0274, 0.0951, -0.1128, 0.0512})},
  };
}

class EveryLens : public ::testing::TestWithParam<NamedLens> {};

TEST_P(EveryLens, ProjectUndoesBearingOverTheWholeImage) {
  const Lens& lens = GetParam().lens;
  int seen = 0;
  double worst = 0;
  for (double v = 0; v < lens.height(); v += 3.7) {
    for (double u = 0; u < lens.width(); u += 3.3) {
      Eigen::Vector3d ray;
      if (!lens.bearing({u, v}, ray)) continue;
      ++seen;
      EXPECT_NEAR(ray.norm(), 1.0, 1e-14);
      Eigen::Vector2d pixel;
      ASSERT_TRUE(lens.project(ray, pixel)) << u << " " << v;
      worst = std::max(worst, (pixel - Eigen::Vector2d(u, v)).norm());
    }
  }
  EXPECT_GT(seen, 10000);
  EXPECT_LT(worst, 1e-9);
}

TEST_P(EveryLens, JacobiansAreTheDerivatives) {
  const Lens& lens = GetParam().lens;
  for (double v = 2; v < lens.height() - 2; v += 31.3) {
    for (double u = 2; u < lens.width() - 2; u += 29.7) {
      Eigen::Vector3d ray;
      Eigen::Vector3d plus;
      Eigen::Vector3d minus;
      Eigen::Matrix<double, 3, 2> by_pixel;
      if (!lens.bearing({u, v}, ray, by_pixel)) continue;
      const double step = 1e-3;
      for (int i = 0; i < 2; ++i) {
        Eigen::Vector2d shift = Eigen::Vector2d::Zero();
        shift[i] = step;
        if (!lens.bearing(Eigen::Vector2d(u, v) + shift, plus)) continue;
        if (!lens.bearing(Eigen::Vector2d(u, v) - shift, minus)) continue;
        EXPECT_LT((by_pixel.col(i) - (plus - minus) / (2 * step)).norm(), 1e-5 * by_pixel.norm())
            << u << " " << v;
      }
      Eigen::Vector2d pixel;
      Eigen::Matrix<double, 2, 3> by_direction;
      ASSERT_TRUE(lens.project(ray, pixel, by_direction));
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d shift = 1e-6 * Eigen::Vector3d::Unit(i);
        Eigen::Vector2d a;
        Eigen::Vector2d b;
        if (!lens.project(ray + shift, a) || !lens.project(ray - shift, b)) continue;
        EXPECT_LT((by_direction.col(i) - (a - b) / 2e-6).norm(), 1e-4) << u << " " << v;
      }
      EXPECT_LT((by_direction * ray).norm(), 1e-9);
      EXPECT_LT((by_direction * by_pixel - Eigen::Matrix2d::Identity()).norm(), 1e-6);
    }
  }
}

TEST_P(EveryLens, JacobiansAreFiniteOnTheAxis) {
  const Lens& lens = GetParam().lens;
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_direction;
  ASSERT_TRUE(lens.project(Eigen::Vector3d::UnitZ(), pixel, by_direction));
  EXPECT_LT((pixel - lens.centre()).norm(), 1e-12);
  Eigen::Vector3d ray;
  Eigen::Matrix<double, 3, 2> by_pixel;
  ASSERT_TRUE(lens.bearing(pixel, ray, by_pixel));
  EXPECT_LT((ray - Eigen::Vector3d::UnitZ()).norm(), 1e-14);
  EXPECT_LT((by_direction * by_pixel - Eigen::Matrix2d::Identity()).norm(), 1e-12);
}

TEST_P(EveryLens, RightIsPositiveXAndDownIsPositiveY) {
  const Lens& lens = GetParam().lens;
  Eigen::Vector3d ray;
  ASSERT_TRUE(lens.bearing(lens.centre() + Eigen::Vector2d(50, 0), ray));
  EXPECT_GT(ray.x(), 0.05);
  EXPECT_NEAR(ray.y(), 0, 0.01);
  ASSERT_TRUE(lens.bearing(lens.centre() + Eigen::Vector2d(0, 50), ray));
  EXPECT_GT(ray.y(), 0.05);
  EXPECT_GT(ray.z(), 0.5);
}

TEST_P(EveryLens, SeesNothingBeyondItsLargestAngle) {
  const Lens& lens = GetParam().lens;
  EXPECT_GT(lens.max_angle(), 0.3);
  for (int i = 0; i < 360; ++i) {
    for (double theta = lens.max_angle() + 0.002; theta < std::numbers::pi; theta += 0.01) {
      const Eigen::Vector3d direction(std::sin(theta) * std::cos(i * kDegree),
                                      std::sin(theta) * std::sin(i * kDegree), std::cos(theta));
      Eigen::Vector2d pixel;
      EXPECT_FALSE(lens.project(direction, pixel)) << theta;
    }
  }
}

TEST_P(EveryLens, RefusesDirectionsThatAreNone) {
  const Lens& lens = GetParam().lens;
  const double nan = std::nan("");
  Eigen::Vector2d pixel;
  Eigen::Vector3d ray;
  EXPECT_FALSE(lens.project({0, 0, 0}, pixel));
  EXPECT_FALSE(lens.project({nan, 0, 1}, pixel));
  EXPECT_FALSE(lens.project({0, 0, nan}, pixel));
  EXPECT_FALSE(lens.bearing({nan, 0}, ray));
  EXPECT_FALSE(lens.bearing({1e300, 1e300}, ray));
}

INSTANTIATE_TEST_SUITE_P(Lens, EveryLens, ::testing::ValuesIn(lenses()), [](const auto& instance) {
  std::string name = instance.param.name;
  for (char& c : name) {
    if (c == ' ') c = '_';
  }
  return name;
});

TEST(Lens, EquidistantRadiusIsFocalTimesAngleBeyondNinetyDegrees) {
  const Lens lens = Lens::equidistant(1024, 768, 200, {511.5, 383.5}, 110 * kDegree);
  for (const double theta : {0.0, 0.3, 1.2, 1.7, 1.9}) {
    Eigen::Vector2d pixel;
    ASSERT_TRUE(lens.project({-std::sin(theta), 0, std::cos(theta)}, pixel));
    EXPECT_NEAR(pixel.x(), 511.5 - 200 * theta, 1e-10);
    EXPECT_NEAR(pixel.y(), 383.5, 1e-10);
  }
  EXPECT_NEAR(lens.max_angle(), 110 * kDegree, 1e-9);
}

TEST(Lens, PinholeSpansItsFieldOfView) {
  const Lens lens = Lens::pinhole(1000, 500, 60 * kDegree);
  Eigen::Vector3d ray;
  ASSERT_TRUE(lens.bearing({999.5, 249.5}, ray));
  EXPECT_NEAR(std::atan2(ray.x(), ray.z()), 30 * kDegree, 1e-12);
  EXPECT_NEAR(lens.pixel_angle(), 2 * std::tan(30 * kDegree) / 1000, 1e-5);
}

TEST(Lens, FoldedPolynomialEndsBeforeTheFold) {
  // F − ρF' = 300 − ρ² / 300 vanishes at ρ = 300: there the angle off axis turns back.
  const std::vector<double> folding = {300, 0, 1.0 / 300};
  const Lens lens = Lens::ocam(1000, 1000, {499.5, 499.5}, Eigen::Matrix2d::Identity(), folding);
  EXPECT_LT(lens.ocam_model()->max_radius(), 300);
  EXPECT_GT(lens.ocam_model()->max_radius(), 290);
  Eigen::Vector3d ray;
  EXPECT_TRUE(lens.bearing({499.5 + 290, 499.5}, ray));
  EXPECT_FALSE(lens.bearing({499.5 + 310, 499.5}, ray));
  double last = 0;
  for (double theta = 0; theta < lens.max_angle(); theta += 0.001) {
    Eigen::Vector2d pixel;
    ASSERT_TRUE(lens.project({std::sin(theta), 0, std::cos(theta)}, pixel));
    EXPECT_GE(pixel.x() - 499.5, last);
    last = pixel.x() - 499.5;
  }
  EXPECT_LT(last, 300);
}

TEST(Lens, StrongBarrelDistortionNeverBringsWideRaysBackIntoTheImage) {
  // r (1 − 0.4 r²) turns back at r = 0.913; without the guard a ray at 57.7° would land on the centre.
  const Lens lens = Lens::caltech(2000, 2000, {500, 500}, {999.5, 999.5}, 0, {-0.4, 0, 0, 0, 0});
  Eigen::Vector2d pixel;
  EXPECT_FALSE(lens.project({std::tan(57.7 * kDegree), 0, 1}, pixel));
  EXPECT_FALSE(lens.project({0.95, 0, 1}, pixel));
  EXPECT_TRUE(lens.project({0.85, 0, 1}, pixel));
  Eigen::Vector3d ray;
  EXPECT_FALSE(lens.bearing({999.5 + 500 * 0.7, 999.5}, ray));
}

TEST(Lens, KannalaBrandtFoldIsCut) {
  const Lens lens = Lens::kannala_brandt(2000, 2000, {500, 500}, {999.5, 999.5}, {-0.2, 0, 0, 0});
  EXPECT_LT(lens.kannala_brandt_model()->max_angle(), std::sqrt(1 / 0.6));
  Eigen::Vector2d pixel;
  EXPECT_FALSE(lens.project({std::sin(1.5), 0, std::cos(1.5)}, pixel));
}

TEST(Lens, NonsenseIsRefused) {
  EXPECT_THROW(Lens::pinhole(0, 480, 1), std::invalid_argument);
  EXPECT_THROW(Lens::pinhole(640, 480, 4), std::invalid_argument);
  EXPECT_THROW(Lens::equidistant(640, 480, 0, {320, 240}, 1), std::invalid_argument);
  EXPECT_THROW(Lens::equidistant(640, 480, std::nan(""), {320, 240}, 1), std::invalid_argument);
  const std::vector<double> backwards = {-300, 0, 1e-3};
  EXPECT_THROW(Lens::ocam(640, 480, {320, 240}, Eigen::Matrix2d::Identity(), backwards),
               std::invalid_argument);
}

TEST(Lens, DefaultLensSeesNothing) {
  const Lens lens;
  Eigen::Vector2d pixel;
  Eigen::Vector3d ray;
  EXPECT_FALSE(lens.project({0, 0, 1}, pixel));
  EXPECT_FALSE(lens.bearing({5, 5}, ray));
}

}  // namespace
}  // namespace omma
