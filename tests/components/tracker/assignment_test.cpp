// One-to-one assignment: the right dot within the gate, and none where two would do as well.
#include "components/tracker/assignment.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

namespace omma {
namespace {

class Assignments : public ::testing::Test {
 protected:
  void add_dot(double u, double v, float flux = 100) {
    Dot dot;
    dot.pixel = {u, v};
    dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
    dot.flux = flux;
    dots_.dots.push_back(dot);
  }
  void add_prediction(double u, double v, double sigma, float weight = 1) {
    PredictedPoint point;
    point.pixel = {u, v};
    point.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
    point.weight = weight;
    predictions_.push_back(point);
  }
  std::span<const Assignment> assign(std::span<const std::uint8_t> taken = {}) {
    grid_.build(dots_, 640, 480);
    return assigner_->assign(predictions_, dots_, grid_, {}, taken);
  }

  DotList dots_;
  DotGrid grid_;
  std::vector<PredictedPoint> predictions_;
  std::unique_ptr<Assigner> assigner_ = std::make_unique<Assigner>();
};

TEST_F(Assignments, GiveEachPredictionTheDotWithinItsGate) {
  add_dot(100, 100);
  add_dot(200, 100);
  add_dot(300, 100);
  add_prediction(200.5, 100.5, 1);
  add_prediction(100, 99, 1);
  add_prediction(300, 104.5, 1);  // 4.5 sigma: outside the gate of 3.7
  const auto found = assign();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].prediction, 0);
  EXPECT_EQ(found[0].dot, 1);
  EXPECT_EQ(found[1].prediction, 1);
  EXPECT_EQ(found[1].dot, 0);
  EXPECT_NEAR(found[0].distance2, 0.5 / (1 + 0.01 + 0.01), 1e-6);
}

TEST_F(Assignments, GateFollowsTheDirectionOfTheUncertainty) {
  add_dot(103, 100);
  add_dot(200, 103);
  for (const double u : {100.0, 200.0}) {
    add_prediction(u, 100, 1);
    predictions_.back().covariance << 9, 0, 0, 0.01;  // long along u
  }
  const auto found = assign();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].dot, 0);
}

TEST_F(Assignments, RefuseTwoDotsThatFitAlike) {
  add_dot(99, 100);
  add_dot(101.2, 100);
  add_prediction(100, 100, 1);
  EXPECT_TRUE(assign().empty());
}

TEST_F(Assignments, RefuseTwoPredictionsThatFitADotAlike) {
  add_dot(100, 100);
  add_prediction(99, 100, 1);
  add_prediction(101.2, 100, 1);
  EXPECT_TRUE(assign().empty());
}

TEST_F(Assignments, LetTheMuchBrighterRivalWin) {
  add_dot(100, 100);
  add_prediction(100.2, 100, 1, 10);
  add_prediction(101.2, 100, 1, 1);
  const auto found = assign();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].prediction, 0);
}

TEST_F(Assignments, LeaveDotsAloneThatAreTaken) {
  add_dot(100, 100);
  add_dot(200, 100);
  add_prediction(100, 100, 1);
  add_prediction(200, 100, 1);
  const std::vector<std::uint8_t> taken = {1, 0};
  const auto found = assign(taken);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].dot, 1);
}

TEST_F(Assignments, AreOneToOneAndRightAmongManyDots) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(5, 635);
  std::uniform_real_distribution<double> v(5, 475);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 300; ++i) {
    add_dot(u(random), v(random));
    add_prediction(dots_.dots[std::size_t(i)].pixel.x() + 0.3 * gauss(random),
                   dots_.dots[std::size_t(i)].pixel.y() + 0.3 * gauss(random), 0.3);
  }
  const auto found = assign();
  EXPECT_GT(found.size(), 270u);  // some have a neighbour within two pixels and are refused
  std::vector<int> used(300);
  for (const Assignment& a : found) {
    EXPECT_EQ(a.prediction, a.dot);
    EXPECT_EQ(++used[a.dot], 1);
  }
}

TEST(ChancePairs, AreAsManyAsDotsAtRandomGive) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(0, 639);
  std::uniform_real_distribution<double> v(0, 479);
  const AssignmentGate gate;
  auto assigner = std::make_unique<Assigner>();
  auto grid = std::make_unique<DotGrid>();
  auto dots = std::make_unique<DotList>();
  double made = 0;
  double expected = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    dots->dots.clear();
    for (int i = 0; i < 300; ++i) {
      Dot dot;
      dot.pixel = {u(random), v(random)};
      dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
      dots->dots.push_back(dot);
    }
    std::vector<PredictedPoint> predictions(200);
    for (PredictedPoint& point : predictions) {
      point.pixel = {u(random), v(random)};
      point.covariance = Eigen::Vector2d(0.05, 0.01).asDiagonal();
    }
    grid->build(*dots, 640, 480);
    made += static_cast<double>(assigner->assign(predictions, *dots, *grid, gate, {}).size());
    expected += chance_pairs(predictions, *dots, gate, 640, 480);
  }
  EXPECT_NEAR(made / expected, 1, 0.1);
  EXPECT_FALSE(beyond_chance(15, 15, 5));
  EXPECT_FALSE(beyond_chance(40, 15, 5));
  EXPECT_TRUE(beyond_chance(50, 15, 5));
  EXPECT_TRUE(beyond_chance(5, 0, 5));
}

// A full Moon's fit can run away and place its dot to thousands of pixels: one pair by chance, not hundreds,
// or the whole sky would count as lost.
TEST(ChancePairs, OneDotPlacedVeryBadlyMakesNoMoreThanOne) {
  auto dots = std::make_unique<DotList>();
  for (int i = 0; i < 25; ++i) {
    Dot dot;
    dot.pixel = {20.0 * i + 30, 15.0 * i + 30};
    dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
    dots->dots.push_back(dot);
  }
  std::vector<PredictedPoint> predictions(40);
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    predictions[i].pixel = {15.0 * static_cast<double>(i) + 10, 240};
    predictions[i].covariance = 0.01 * Eigen::Matrix2d::Identity();
  }
  const AssignmentGate gate;
  const double before = chance_pairs(predictions, *dots, gate, 640, 480);
  dots->dots[0].covariance = 1e7 * Eigen::Matrix2d::Identity();
  EXPECT_LT(chance_pairs(predictions, *dots, gate, 640, 480), before + 1.01);
  EXPECT_TRUE(beyond_chance(25, chance_pairs(predictions, *dots, gate, 640, 480), 5));
}

}  // namespace
}  // namespace omma
