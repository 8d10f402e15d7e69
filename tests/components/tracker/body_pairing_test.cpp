// Two bodies in one image compete for the dots.
#include "components/tracker/body_pairing.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/bench/sky_problem.hpp"

namespace omma {
namespace {

class TwoBodies : public ::testing::Test {
 protected:
  TwoBodies() {
    lists_->cameras.resize(1);
    for (int i = 0; i < 6; ++i) {
      Target target;
      target.position = {0.1 * (i % 3), 0.13 * (i / 3), 0.02 * i};
      near_.targets.push_back(target);
      target.position = {0.11 * (i / 2), 0.09 * (i % 2), 0};
      far_.targets.push_back(target);
    }
  }
  Pose at(const Eigen::Vector3d& position) const { return {Eigen::Quaterniond::Identity(), position}; }
  void see(const TargetBody& body, const Pose& pose) {
    for (const Target& target : body.targets) {
      Dot dot;
      if (!rig_.cameras[0].lens.project(rig_.cameras[0].rig_from_camera.inverse() * (pose * target.position),
                                        dot.pixel))
        continue;
      dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
      dot.flux = 100;
      lists_->cameras[0].dots.push_back(dot);
    }
  }
  void pair(const Pose& near, const Pose& far) {
    seen_->build(*lists_, rig_, 0.05);
    PredictedPose near_pose{near, 1e-8 * Matrix6d::Identity()};
    PredictedPose far_pose{far, 1e-8 * Matrix6d::Identity()};
    std::array<BodyPrediction, 2> bodies{
        {{&near_, near_pose, near_pairs_.get()}, {&far_, far_pose, far_pairs_.get()}}};
    pairing_->pair(*seen_, rig_, bodies, {});
  }

  Rig rig_ = equidistant_rig(1, 122);
  Eigen::Vector3d axis_ = rig_.cameras[0].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  TargetBody near_, far_;
  std::unique_ptr<DotLists> lists_ = std::make_unique<DotLists>();
  std::unique_ptr<SeenDots> seen_ = std::make_unique<SeenDots>();
  std::unique_ptr<BodyPairing> pairing_ = std::make_unique<BodyPairing>();
  using Pairs = StaticVector<Pairing, limits::kTargetPairs>;
  std::unique_ptr<Pairs> near_pairs_ = std::make_unique<Pairs>();
  std::unique_ptr<Pairs> far_pairs_ = std::make_unique<Pairs>();
};

TEST_F(TwoBodies, ApartHaveTheirOwnDots) {
  const Pose near = at(1.5 * axis_);
  const Pose far = at(3.0 * axis_ + 0.9 * tangent_basis(axis_).col(0));
  see(near_, near);
  see(far_, far);
  pair(near, far);
  ASSERT_EQ(near_pairs_->size(), 6U);
  ASSERT_EQ(far_pairs_->size(), 6U);
  for (const Pairing& p : *near_pairs_) EXPECT_EQ(p.dot, p.entry);
  for (const Pairing& p : *far_pairs_) EXPECT_EQ(p.dot, p.entry + 6);
}

// Both bodies' first targets stand on one line of sight: the one dot there is neither's.
TEST_F(TwoBodies, ADotThatBothExplainIsNeithers) {
  const Pose near = at(1.5 * axis_);
  const Pose far = at(3.0 * axis_);
  see(near_, near);
  lists_->cameras[0].dots.resize(1);
  pair(near, far);
  EXPECT_EQ(near_pairs_->size(), 0U);
  EXPECT_EQ(far_pairs_->size(), 0U);
}

TEST_F(TwoBodies, ADotThatOneExplainsBetterIsItsOwn) {
  const Pose near = at(1.5 * axis_);
  const Pose far = at(3.0 * axis_ + 0.003 * tangent_basis(axis_).col(0));  // half a pixel aside: 4 sigma
  see(near_, near);
  lists_->cameras[0].dots.resize(1);
  pair(near, far);
  ASSERT_EQ(near_pairs_->size(), 1U);
  EXPECT_EQ((*near_pairs_)[0].entry, 0U);
  EXPECT_EQ(far_pairs_->size(), 0U);
}

}  // namespace
}  // namespace omma
