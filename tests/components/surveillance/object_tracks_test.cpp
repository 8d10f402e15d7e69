// Objects among leftover dots: confirmed where they are, with the accuracy they claim, and not where chance
// puts dots.
#include "components/surveillance/object_tracks.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "components/tracker/sky_coverage.hpp"
#include "tests/bench/sky_problem.hpp"

namespace omma {
namespace {

constexpr double kSigma = 3e-4;    // of a dot [rad]
constexpr double kInterval = 0.1;  // [s]

LeftoverDot dot_at(const Eigen::Vector3d& direction, std::uint8_t camera, std::uint16_t index) {
  LeftoverDot dot;
  dot.direction = direction.normalized();
  dot.whitener = tangent_basis(dot.direction).transpose() / kSigma;
  dot.ray = dot.direction;
  dot.sigma = kSigma;
  dot.flux = 100;
  dot.snr = 10;
  dot.camera = camera;
  dot.dot = index;
  return dot;
}

/// One that runs along a great circle.
struct Runner {
  Eigen::Vector3d start;
  Eigen::Vector3d axis;  // unit
  double rate;           // [rad/s]
  Eigen::Vector3d at(double time) const { return rotation_exp(time * rate * axis) * start; }
  Eigen::Vector3d velocity(double time) const { return rate * axis.cross(at(time)); }
};

class FollowedObjects : public ::testing::Test {
 protected:
  double gauss() { return gauss_(random_); }
  Eigen::Vector3d anywhere() {
    const double x = gauss(), y = gauss(), z = gauss();
    return Eigen::Vector3d(x, y, z).normalized();
  }
  void add(const Eigen::Vector3d& direction, std::uint8_t camera = 0) {
    const double a = gauss(), b = gauss();
    const Eigen::Vector2d noise(a, b);
    dots_.push_back(dot_at(direction + kSigma * tangent_basis(direction) * noise, camera,
                           static_cast<std::uint16_t>(dots_.size())));
  }
  void step() {
    if (frame_ > 0) tracks_->predict(kInterval);
    SkyFrame sky;
    sky.time_ns = static_cast<TimeNs>(1e9 * kInterval * static_cast<double>(frame_));
    sky.looking.fill(true);
    tracks_->take(dots_, sky);
    dots_.clear();
    ++frame_;
  }
  double time() const { return kInterval * static_cast<double>(frame_); }
  std::vector<const ObjectTrack*> confirmed() const {
    std::vector<const ObjectTrack*> found;
    for (const ObjectTrack& track : tracks_->tracks())
      if (track.active && track.number != 0) found.push_back(&track);
    return found;
  }

  Rig rig_ = equidistant_rig(3, 122);
  SurveillanceParameters parameters_;
  std::unique_ptr<ObjectTracks> tracks_ =
      std::make_unique<ObjectTracks>(parameters_, rig_, sky_coverage(rig_).solid_angle);
  std::vector<LeftoverDot> dots_;
  std::mt19937_64 random_{41};
  std::normal_distribution<double> gauss_;
  std::uint64_t frame_ = 0;
};

TEST_F(FollowedObjects, OneThatRunsIsConfirmedWithItsRate) {
  const Runner runner{Eigen::Vector3d::UnitX(), Eigen::Vector3d(0, 0.6, 0.8), 0.01};
  for (int i = 0; i < 30; ++i) {
    add(runner.at(time()));
    step();
  }
  ASSERT_EQ(confirmed().size(), 1U);
  const ObjectTrack& track = *confirmed()[0];
  EXPECT_EQ(track.number, 1U);
  EXPECT_EQ(track.sightings, 30U);
  const double now = time() - kInterval;
  EXPECT_LT((track.state.direction() - runner.at(now)).norm(), 3 * kSigma);
  EXPECT_LT((track.state.velocity() - runner.velocity(now)).norm(), 5e-4);
}

TEST_F(FollowedObjects, TheCovarianceIsTheTruth) {
  double nees = 0;
  int count = 0;
  for (int trial = 0; trial < 100; ++trial) {
    tracks_ = std::make_unique<ObjectTracks>(parameters_, rig_, sky_coverage(rig_).solid_angle);
    frame_ = 0;
    const Eigen::Vector3d start = anywhere();
    const Runner runner{start, start.cross(anywhere()).normalized(), 0.004};
    for (int i = 0; i < 25; ++i) {
      add(runner.at(time()));
      step();
    }
    ASSERT_EQ(confirmed().size(), 1U) << trial;
    const ObjectState& state = confirmed()[0]->state;
    const double now = time() - kInterval;
    const Eigen::Matrix<double, 3, 2> basis = tangent_basis(state.direction());
    Eigen::Vector4d error;
    error << basis.transpose() * (runner.at(now) - state.direction()),
        basis.transpose() * (runner.velocity(now) - state.velocity());
    Eigen::Matrix2d direction = basis.transpose() * state.covariance() * basis;
    Eigen::Matrix2d velocity = basis.transpose() * state.velocity_covariance() * basis;
    nees += error.head<2>().dot(direction.inverse() * error.head<2>()) +
            error.tail<2>().dot(velocity.inverse() * error.tail<2>());
    ++count;
  }
  // Two pairs of degrees of freedom; the model allows for accelerations there were none of.
  EXPECT_GT(nees / count, 2.0);
  EXPECT_LT(nees / count, 4.8);
}

TEST_F(FollowedObjects, DotsAtRandomMakeNone) {
  for (int i = 0; i < 600; ++i) {
    for (int d = 0; d < 60; ++d) add(anywhere(), static_cast<std::uint8_t>(d % 3));
    step();
  }
  EXPECT_EQ(confirmed().size(), 0U);
  EXPECT_EQ(tracks_->not_followed(), 0U);
}

TEST_F(FollowedObjects, OneIsFoundAmongDotsAtRandomAndTheRestAreNot) {
  const Runner runner{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), 0.006};
  for (int i = 0; i < 200; ++i) {
    for (int d = 0; d < 60; ++d) add(anywhere(), static_cast<std::uint8_t>(d % 3));
    if (gauss() < 1.3) add(runner.at(time()), 1);  // nine times in ten
    step();
  }
  ASSERT_EQ(confirmed().size(), 1U);
  EXPECT_LT((confirmed()[0]->state.direction() - runner.at(time() - kInterval)).norm(), 10 * kSigma);
  EXPECT_EQ(confirmed()[0]->number, 1U);
}

TEST_F(FollowedObjects, TwoThatCrossKeepTheirNumbers) {
  const Runner a{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 0.01};
  const Eigen::Vector3d meeting = a.at(5.0);
  const Eigen::Vector3d other_axis = rotation_exp(0.6 * meeting) * Eigen::Vector3d::UnitZ();
  const Runner b{rotation_exp(-5.0 * 0.008 * other_axis) * meeting, other_axis, 0.008};
  std::uint32_t number_a = 0, number_b = 0;
  for (int i = 0; i < 100; ++i) {
    add(a.at(time()));
    add(b.at(time()));
    step();
    if (i != 30) continue;
    ASSERT_EQ(confirmed().size(), 2U);
    for (const ObjectTrack* track : confirmed())
      ((track->state.direction() - a.at(time() - kInterval)).norm() < 1e-2 &&
               (track->state.velocity() - a.velocity(time())).norm() < 3e-3
           ? number_a
           : number_b) = track->number;
  }
  ASSERT_EQ(confirmed().size(), 2U);
  for (const ObjectTrack* track : confirmed()) {
    const bool is_a = (track->state.direction() - a.at(time() - kInterval)).norm() < 3 * kSigma;
    EXPECT_EQ(track->number, is_a ? number_a : number_b);
  }
}

TEST_F(FollowedObjects, OneSeenByTwoCamerasIsOne) {
  const Runner runner{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 0.01};
  for (int i = 0; i < 20; ++i) {
    add(runner.at(time()), 0);
    add(runner.at(time()), 2);
    step();
  }
  ASSERT_EQ(confirmed().size(), 1U);
  const ObjectBearing& bearing = confirmed()[0]->bearing;
  EXPECT_GE(bearing.dot[0], 0);
  EXPECT_LT(bearing.dot[1], 0);
  EXPECT_GE(bearing.dot[2], 0);
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(bearing.direction);
  const Eigen::Matrix2d covariance = basis.transpose() * bearing.covariance * basis;
  EXPECT_NEAR(covariance(0, 0), kSigma * kSigma / 2, 0.1 * kSigma * kSigma);
}

TEST_F(FollowedObjects, IsGivenUpWhenItIsGone) {
  const Runner runner{rig_.cameras[0].rig_from_camera.rotation * Eigen::Vector3d::UnitZ(),
                      Eigen::Vector3d(0.1, 0.7, 0.7).normalized(), 0.003};
  for (int i = 0; i < 20; ++i) {
    add(runner.at(time()));
    step();
  }
  ASSERT_EQ(confirmed().size(), 1U);
  for (int i = 0; i < parameters_.patience; ++i) step();
  EXPECT_EQ(confirmed().size(), 1U);
  EXPECT_EQ(confirmed()[0]->missed, static_cast<std::uint32_t>(parameters_.patience));
  step();
  EXPECT_EQ(confirmed().size(), 0U);
}

}  // namespace
}  // namespace omma
