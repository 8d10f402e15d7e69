// Drift of a rig out of the stars of a flight: known drifts come back within their deviations, and a rig that
// does not drift is said not to.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "components/catalogue/star_catalogue.hpp"
#include "ground/calibrate/drift_report.hpp"
#include "ground/design/even_sphere.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kPeriod = 60;  // between frame sets [s]

// Of two cameras: centre [px], focal length [part], turn [rad], in a second.
struct Drift {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // of the first
  double focal = 0;                                  // of the second
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();    // of the second
};

LensShape lens_shape() {
  LensShape shape = equidistant_shape(1024, 768, 273, 95 * kDegree);
  shape.parameters << 509.3, 385.8, 273.4, 1.0007, -0.02, 0.004, -0.001, 0.0002;
  return shape;
}

Rig guessed_rig() {
  Rig rig;
  rig.name = Name("pair");
  for (const char* name : {"cam0", "cam1"}) {
    RigCamera camera;
    camera.name = Name(name);
    camera.lens = lens_shape().lens().value();
    rig.cameras.push_back(camera);
  }
  rig.cameras[1].rig_from_camera.rotation = rotation_exp({1.9, 0.2, -0.1}).conjugate();
  return rig;
}

std::vector<FlightSet> flown(int count, const Drift& drift, double noise, unsigned seed) {
  const Rig rig = guessed_rig();
  const StarCatalogue catalogue({}, {3.2F, 0});
  const auto attitudes = even_attitudes(17);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<FlightSet> sets;
  for (int k = 0; k < count; ++k) {
    FlightSet set;
    set.time = kPeriod * k;
    set.rig_from_j2000 = attitudes[static_cast<std::size_t>(k) % attitudes.size()];
    const double t = set.time - 0.5 * kPeriod * (count - 1);
    for (int c = 0; c < 2; ++c) {
      LensShape shape = lens_shape();
      if (c == 0) shape.parameters.head<2>() += t * drift.centre;
      if (c == 1) shape.parameters[2] *= 1 + t * drift.focal;
      const Lens lens = shape.lens().value();
      Eigen::Quaterniond camera_from_rig =
          rig.cameras[static_cast<std::size_t>(c)].rig_from_camera.rotation.conjugate();
      if (c == 1) camera_from_rig = rotation_exp(t * drift.turn) * camera_from_rig;
      for (const SkyStar& star : catalogue.stars()) {
        Eigen::Vector2d pixel;
        const Eigen::Vector3d direction = camera_from_rig * (set.rig_from_j2000 * star.direction);
        if (direction.z() < 0.05 || !lens.project(direction, pixel)) continue;
        pixel += noise * Eigen::Vector2d(normal(random), normal(random));
        set.sights.push_back(
            {0, c, star.hr, star.direction, pixel, noise * noise * Eigen::Matrix2d::Identity(), 50});
        set.magnitudes.push_back(3);
      }
    }
    sets.push_back(set);
  }
  return sets;
}

DriftOptions options() {
  DriftOptions options;
  options.model = LensModel::kKannalaBrandt;
  options.windows = 6;
  options.max_angle = 95 * kDegree;
  return options;
}

constexpr double kHour = 3600;

TEST(SkyDrift, FindsWhatDriftsAndHowFast) {
  const Drift truth{Eigen::Vector2d(0.2, -0.1) / kHour, 3e-4 / kHour,
                    Eigen::Vector3d(2e-3, 0, -1e-3) / kHour};
  Eigen::VectorXd rate(9);
  rate << truth.centre, 0, 0, 0, truth.focal, truth.turn;
  double squares = 0;
  constexpr int kTrials = 4;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const SkyDrift found = drift_from_flight(guessed_rig(), {flown(36, truth, 0.1, seed)}, options());
    ASSERT_TRUE(found.done) << found.reason;
    const Eigen::VectorXd error = found.rate - rate;
    const Eigen::VectorXd scale = found.covariance.diagonal().tail(9).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd correlation =
        scale.asDiagonal() * found.covariance.bottomRightCorner(9, 9) * scale.asDiagonal();
    squares += scale.cwiseProduct(error).dot(correlation.ldlt().solve(scale.cwiseProduct(error))) / kTrials;
    EXPECT_GT(found.squared_in_sigmas_of(DriftLayout::lens_at(0)), kSeenDrift);
    EXPECT_GT(found.squared_in_sigmas_of(DriftLayout::lens_at(1)), kSeenDrift);
    EXPECT_GT(found.squared_in_sigmas_of(found.layout.turn_at(1)), kSeenDrift);
    EXPECT_LT(found.rate_sigma(0) * kHour, 0.05);
  }
  EXPECT_GT(squares, 4);  // chi-square of 9, mean of four
  EXPECT_LT(squares, 16);
}

TEST(SkyDrift, SeesNoneWhereThereIsNone) {
  const SkyDrift found = drift_from_flight(guessed_rig(), {flown(36, {}, 0.1, 9)}, options());
  ASSERT_TRUE(found.done) << found.reason;
  for (const Eigen::Index at : {DriftLayout::lens_at(0), DriftLayout::lens_at(1), found.layout.turn_at(1)})
    EXPECT_LT(found.squared_in_sigmas_of(at), kSeenDrift);
  EXPECT_NEAR(found.scatter, 1, 0.6);
  EXPECT_NE(drift_text(found).find("no drift seen"), std::string::npos);
  EXPECT_EQ(drift_text(found).find("it drifts"), std::string::npos);
}

TEST(SkyDrift, TwoRecordingsADayApartTellWhatChangedBetween) {
  std::vector<FlightSet> later = flown(6, {}, 0.1, 4);
  // A camera that was knocked: 300 arcsec about x.
  const Eigen::Quaterniond knock = rotation_exp({300 * kDegree / 3600, 0, 0});
  const Rig rig = guessed_rig();
  const Lens lens = lens_shape().lens().value();
  const Eigen::Quaterniond camera = knock * rig.cameras[1].rig_from_camera.rotation.conjugate();
  for (FlightSet& set : later) {
    set.time += 86400;
    for (StarSight& s : set.sights) {
      Eigen::Vector2d was, is;
      if (s.camera != 1) continue;
      if (!lens.project(knock.conjugate() * camera * (set.rig_from_j2000 * s.star), was)) continue;
      if (lens.project(camera * (set.rig_from_j2000 * s.star), is)) s.pixel += is - was;
    }
  }
  DriftOptions one = options();
  one.windows = 1;
  const SkyDrift found = drift_from_flight(guessed_rig(), {flown(6, {}, 0.1, 5), later}, one);
  ASSERT_TRUE(found.done) << found.reason;
  const double arcsec = kDegree / 3600;
  const Eigen::Index x = found.layout.turn_at(1);
  EXPECT_NEAR(found.rate[x] * 86400 / arcsec, 300, 4 * found.rate_sigma(x) * 86400 / arcsec);
  EXPECT_GT(found.squared_in_sigmas_of(x), kSeenDrift);
  EXPECT_LT(found.squared_in_sigmas_of(DriftLayout::lens_at(0)), kSeenDrift);
}

TEST(SkyDrift, SaysWhyThereIsNone) {
  const SkyDrift few = drift_from_flight(guessed_rig(), {flown(2, {}, 0.1, 1)}, options());
  EXPECT_FALSE(few.done);
  EXPECT_NE(few.reason.find("two are needed"), std::string::npos);
  std::vector<FlightSet> blind = flown(12, {}, 0.1, 1);
  for (FlightSet& set : blind)
    std::erase_if(set.sights, [](const StarSight& sight) { return sight.camera == 1; });
  const SkyDrift half = drift_from_flight(guessed_rig(), {blind}, options());
  EXPECT_FALSE(half.done);
  EXPECT_NE(half.reason.find("do not fix the rig"), std::string::npos);
}

}  // namespace
}  // namespace omma::ground
