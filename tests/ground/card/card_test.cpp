// Cards: their likenesses to themselves turned, and how often they are known.
#include <gtest/gtest.h>

#include <cmath>

#include "components/catalogue/target_file.hpp"
#include "components/geometry/pose.hpp"
#include "ground/card/card_check.hpp"
#include "ground/card/card_reading.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = M_PI / 180;

TargetBody grid(int columns, int rows, double dx, double dy) {
  TargetBody body;
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < rows; ++k) {
      Target target;
      target.id = Name("T" + std::to_string(i) + "_" + std::to_string(k));
      target.position = {dx * i, dy * k, 0};
      body.targets.push_back(target);
    }
  }
  return body;
}

TargetBody docking_card() {
  return read_target_file(OMMA_SOURCE_DIR "/config/targets/docking_card.tsv");
}

Lens fisheye() {
  return Lens::equidistant(768, 768, 384 / (60 * kDegree), {383.5, 383.5}, 60 * kDegree);
}

TEST(Likeness, OfARectangularGridIsWholeAtHalfATurn) {
  const TargetBody body = grid(4, 3, 0.05, 0.04);
  const Likeness likeness = nearest_likeness(body, 1e-4);
  EXPECT_EQ(likeness.matched, body.targets.size());
  EXPECT_NEAR(likeness.angle, M_PI, 1e-6);
}

TEST(Likeness, OfASquareGridIsWholeAtAQuarter) {
  const TargetBody body = grid(3, 3, 0.05, 0.05);
  const Likeness likeness = nearest_likeness(body, 1e-4);
  EXPECT_EQ(likeness.matched, 9U);
  EXPECT_NEAR(std::remainder(likeness.angle, M_PI / 2), 0, 1e-6);
}

TEST(Likeness, IsBrokenByOneTargetMovedOff) {
  TargetBody body = grid(3, 3, 0.05, 0.05);
  body.targets[0].position += Eigen::Vector3d(0.012, 0.004, 0);
  EXPECT_LT(nearest_likeness(body, 1e-3).matched, 9U);
}

TEST(Likeness, OfTheDockingCardIsFarFromWhole) {
  const TargetBody body = docking_card();
  EXPECT_LT(nearest_likeness(body, 1e-3).matched, body.targets.size() / 2);
}

TEST(CardCheck, KnowsTheDockingCardAndNeverWrongly) {
  const RangeCheck check = check_at(docking_card(), fisheye(), 1.0, {.trials = 60});
  EXPECT_GE(check.right, 9 * check.trials / 10);
  EXPECT_EQ(check.wrong, 0);
  EXPECT_GT(check.position_sigma, 0);
}

TEST(CardCheck, DoesNotKnowWhichWayUpASymmetricCardIs) {
  const RangeCheck check = check_at(grid(4, 4, 0.05, 0.05), fisheye(), 1.0, {.hidden = 0, .trials = 25});
  EXPECT_EQ(check.wrong, 0);
  EXPECT_EQ(check.right, 0);
  EXPECT_GT(check.ambiguous, 0);
}

TEST(CardCheck, TellsTheSameEveryTime) {
  const RangeCheck a = check_at(docking_card(), fisheye(), 2.0, {.trials = 20});
  const RangeCheck b = check_at(docking_card(), fisheye(), 2.0, {.trials = 20});
  EXPECT_EQ(a.right, b.right);
  EXPECT_EQ(a.position_sigma, b.position_sigma);
}

TEST(TargetFileText, IsReadBack) {
  const TargetBody body = docking_card();
  const TargetBody back = targets_from_text(target_file_text(body), "card.tsv");
  ASSERT_EQ(back.targets.size(), body.targets.size());
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    EXPECT_EQ(back.targets[i].id, body.targets[i].id);
    EXPECT_LT((back.targets[i].position - body.targets[i].position).norm(), 1e-6);
    EXPECT_EQ(back.targets[i].type, body.targets[i].type);
  }
}

}  // namespace
}  // namespace omma::ground
