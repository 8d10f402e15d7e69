// The component between tracker and telemetry: a satellite, a planet nobody named and a hot pixel under a
// turning sky are followed and told apart; no star is among them; nothing is allocated.
#include "components/surveillance/surveillance.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "components/attitude/attitude.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/sky_problem.hpp"
#include "tests/components/tracker/seen_sky.hpp"

namespace omma {
namespace {

constexpr TimeNs kInterval = 100'000'000;

TrackerParameters to_fifth_magnitude() {
  TrackerParameters parameters;
  parameters.faintest_star = 5.0F;
  return parameters;
}

class WatchedSky : public ::testing::Test {
 protected:
  WatchedSky() {
    tracker_->dots.bind(*dots_);
    tracker_->attitude.bind(attitude_->estimate);
    tracker_->poses.bind(*poses_);
    attitude_->pairings.bind(tracker_->pairings);
    surveillance_->dots.bind(*dots_);
    surveillance_->pairings.bind(tracker_->pairings);
    surveillance_->attitude.bind(attitude_->estimate);
  }

  void add_dot(std::size_t camera, const Eigen::Vector2d& pixel) {
    Dot dot;
    dot.pixel = pixel;
    dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
    dot.flux = 900;
    dot.snr = 30;
    DotList& list = (**dots_).cameras[camera];
    if (list.dots.full()) list.dots.pop_back();  // the faintest star
    list.dots.push_back(dot);
  }
  /// A direction of the sky, in every camera that sees it.
  void add_object(const Eigen::Vector3d& direction) {
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      Eigen::Vector2d pixel;
      const RigCamera& camera = rig_.cameras[c];
      if (camera.lens.project(camera.rig_from_camera.rotation.conjugate() * (truth_ * direction), pixel))
        add_dot(c, pixel);
    }
  }
  void begin_frame() {
    ++frame_;
    truth_ = (rotation_exp(1e-9 * double(kInterval) * rate_) * truth_).normalized();
    DotLists& lists = **dots_;
    lists.frame = frame_;
    lists.time_ns = static_cast<TimeNs>(frame_) * kInterval;
    sky_.see(truth_, lists);
  }
  void end_frame() {
    const RealTimeScope scope;
    const Tick tick{frame_, static_cast<TimeNs>(frame_) * kInterval};
    tracker_->step(tick);
    attitude_->step(tick);
    surveillance_->step(tick);
  }
  double time() const { return 1e-9 * double(kInterval) * double(frame_); }
  const UnknownObjects& objects() const { return *surveillance_->objects; }

  Rig rig_ = equidistant_rig(3, 122);
  std::unique_ptr<StarCatalogue> catalogue_ =
      std::make_unique<StarCatalogue>(Observer{}, StarCatalogueParameters{6.5F, 0.004});
  SeenSky sky_{rig_, *catalogue_, 6.0F, 0.1};  // fainter stars are seen than are paired
  std::unique_ptr<Tracker> tracker_ =
      std::make_unique<Tracker>(to_fifth_magnitude(), rig_, *catalogue_, std::span<const TargetBody>{});
  std::unique_ptr<Attitude> attitude_ = std::make_unique<Attitude>(AttitudeParameters{});
  std::unique_ptr<Surveillance> surveillance_ =
      std::make_unique<Surveillance>(SurveillanceParameters{}, rig_, *catalogue_, 0.05);
  std::unique_ptr<Out<DotLists>> dots_ = std::make_unique<Out<DotLists>>();
  std::unique_ptr<Out<PoseEstimates>> poses_ = std::make_unique<Out<PoseEstimates>>();
  Eigen::Quaterniond truth_ = Eigen::Quaterniond(0.5, -0.1, 0.7, 0.4).normalized();
  Eigen::Vector3d rate_{0.03, -0.02, 0.01};
  std::uint64_t frame_ = 0;
};

TEST_F(WatchedSky, StarsFainterThanArePairedAreNoObjects) {
  for (int i = 0; i < 30; ++i) {
    begin_frame();
    end_frame();
  }
  EXPECT_TRUE(objects().valid);
  EXPECT_EQ(objects().objects.size(), 0U);
  EXPECT_GT(tracker_->pairings->unclaimed_dots, 100U);  // which the catalogue explains
  EXPECT_LT(objects().leftover_dots, 20U);
}

// One dot in the middle of camera 0, which looks at `direction`, turned aside by `offset` of its pixels.
std::size_t leftovers_about(const Eigen::Vector3d& direction, double offset, const Rig& rig,
                            const StarCatalogue& catalogue) {
  const RigCamera& camera = rig.cameras[0];
  auto attitude = std::make_unique<AttitudeEstimate>();
  attitude->valid = true;
  const Eigen::Vector3d axis = camera.rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  attitude->solution.rig_from_j2000 = Eigen::Quaterniond::FromTwoVectors(direction, axis);
  auto lists = std::make_unique<DotLists>();
  lists->cameras.resize(rig.cameras.size());
  Dot dot;
  EXPECT_TRUE(camera.lens.project(Eigen::Vector3d::UnitZ(), dot.pixel));
  dot.pixel.x() += offset;
  dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
  lists->cameras[0].dots.push_back(dot);
  const auto leftovers = std::make_unique<LeftoverDots>();
  return leftovers->find(*lists, Pairings{}, *attitude, rig, catalogue, 0.05, 13.8).size();
}

TEST_F(WatchedSky, StarsThatOneCameraDoesNotPartAreNoObjects) {
  const double pixel = rig_.cameras[0].lens.pixel_angle();
  int pairs = 0;
  for (const SkyStar& a : catalogue_->stars()) {
    int near = 0;
    Eigen::Vector3d photocentre = a.direction;
    for (const SkyStar& b : catalogue_->stars()) {
      const double apart = (a.direction - b.direction).norm();
      if (&a == &b || apart > 12 * pixel) continue;
      ++near;
      photocentre += std::pow(10.0, -0.4 * static_cast<double>(b.magnitude - a.magnitude)) * b.direction;
      if (apart < 2 * pixel || apart > 3.5 * pixel) near = 2;  // not a pair by itself
    }
    if (near != 1 || ++pairs > 5) continue;
    EXPECT_EQ(leftovers_about(photocentre.normalized(), 0, rig_, *catalogue_), 0U) << a.hr;
    EXPECT_EQ(leftovers_about(photocentre.normalized(), 5, rig_, *catalogue_), 1U) << a.hr;
  }
  EXPECT_GT(pairs, 2);
}

TEST_F(WatchedSky, WhatMovesStandsOrTurnsWithTheRigIsToldApart) {
  // Through the middle of the first camera's field at the time of the tenth frame set.
  begin_frame();
  const Eigen::Vector3d ahead = truth_.conjugate() * (rig_.cameras[0].rig_from_camera.rotation *
                                                      Eigen::Vector3d(0.1, 0.05, 1).normalized());
  const Eigen::Vector3d nova = truth_.conjugate() * (rig_.cameras[1].rig_from_camera.rotation *
                                                     Eigen::Vector3d(0.2, -0.1, 1).normalized());
  const Eigen::Vector3d axis = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  const memory_guard::Violations before = memory_guard::violations();
  for (int i = 0; i < 60; ++i) {
    if (i > 0) begin_frame();
    add_object(rotation_exp(0.008 * time() * axis) * ahead);
    add_object(nova);
    add_dot(2, {300, 400});
    end_frame();
  }
  EXPECT_EQ(memory_guard::violations().total() - before.total(), 0U);
  ASSERT_EQ(objects().objects.size(), 3U);
  int moving = 0, standing = 0, turning = 0;
  for (const UnknownObject& object : objects().objects) {
    if (object.motion == ObjectMotion::kMoving) {
      ++moving;
      EXPECT_NEAR(object.velocity.norm(), 0.008, 5e-4);
      EXPECT_LT((object.direction - rotation_exp(0.008 * time() * axis) * ahead).norm(), 1e-3);
      EXPECT_EQ(object.sightings, 60U);
    }
    if (object.motion == ObjectMotion::kWithTheStars) {
      ++standing;
      EXPECT_LT(object.velocity.norm(), 5e-4);
    }
    turning += object.motion == ObjectMotion::kWithTheRig ? 1 : 0;
  }
  EXPECT_EQ(moving, 1);
  EXPECT_EQ(standing, 1);
  EXPECT_EQ(turning, 1);
}

TEST_F(WatchedSky, AHotPixelWhoseFirstDotWasAnotherTurnsWithTheRigAllTheSame) {
  for (int i = 0; i < 40; ++i) {
    begin_frame();
    add_dot(2, {i == 0 ? 301.0 : 300.0, 400});
    end_frame();
  }
  ASSERT_EQ(objects().objects.size(), 1U);
  EXPECT_GT(objects().objects[0].sightings, 30U);
  EXPECT_EQ(objects().objects[0].motion, ObjectMotion::kWithTheRig);
}

TEST_F(WatchedSky, AnObjectIsHandedFromCameraToCamera) {
  rate_.setZero();
  begin_frame();
  // From the axis of the first camera to that of the second.
  const Eigen::Vector3d from = rig_.cameras[0].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d to = rig_.cameras[1].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis = from.cross(to).normalized();
  const double way = std::acos(from.dot(to));
  std::uint8_t cameras = 0;
  for (int i = 0; i < 500; ++i) {
    if (i > 0) begin_frame();
    add_object(truth_.conjugate() * (rotation_exp(way * i / 500.0 * axis) * from));
    end_frame();
    if (i < 10) continue;
    ASSERT_EQ(objects().objects.size(), 1U) << i;
    EXPECT_EQ(objects().objects[0].number, 1U);
    for (std::size_t c = 0; c < 3; ++c)
      if (objects().objects[0].bearing.seen && objects().objects[0].bearing.dot[c] >= 0)
        cameras = static_cast<std::uint8_t>(cameras | (1U << c));
  }
  EXPECT_EQ(cameras & 3, 3);
}

TEST_F(WatchedSky, WithoutAnAttitudeObjectsAreWhereTheyAreExpected) {
  begin_frame();
  const Eigen::Vector3d ahead =
      truth_.conjugate() * (rig_.cameras[0].rig_from_camera.rotation * Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d axis = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  for (int i = 0; i < 30; ++i) {
    if (i > 0) begin_frame();
    add_object(rotation_exp(0.008 * time() * axis) * ahead);
    end_frame();
  }
  ASSERT_EQ(objects().objects.size(), 1U);
  for (int i = 0; i < 5; ++i) {
    begin_frame();
    for (DotList& list : (**dots_).cameras) list.dots.clear();
    end_frame();
  }
  EXPECT_FALSE(objects().valid);
  ASSERT_EQ(objects().objects.size(), 1U);
  EXPECT_FALSE(objects().objects[0].bearing.seen);
  EXPECT_LT((objects().objects[0].direction - rotation_exp(0.008 * time() * axis) * ahead).norm(), 2e-3);
}

}  // namespace
}  // namespace omma
