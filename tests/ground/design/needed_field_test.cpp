// Field of view needed for the whole sky: against the geometry of each symmetric rig, worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ground/design/even_sphere.hpp"
#include "ground/design/needed_field.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double field_deg(int cameras, double spacing, double distance) {
  return needed_field(symmetric_places(cameras, spacing), distance).field / kDegree;
}

// Angle off the axis of a camera `radius` from the middle at which it sees a point at unit distance, `off`
// the angle between its axis and that point as the middle sees it.
double seen_at(double off, double radius) {
  return std::atan2(std::sin(off), std::cos(off) - radius) / kDegree;
}

TEST(NeededField, OfTwoToSixCamerasIsWhatTheGeometryGives) {
  const double s = 0.2;
  EXPECT_NEAR(field_deg(2, s, 1), 2 * seen_at(std::numbers::pi / 2, s / 2), 1e-4);
  EXPECT_NEAR(field_deg(3, s, 1), 2 * seen_at(std::numbers::pi / 2, s / std::sqrt(3.0)), 1e-4);
  EXPECT_NEAR(field_deg(4, s, 1), 2 * seen_at(std::acos(1.0 / 3), s * std::sqrt(6.0) / 4), 1e-4);
  EXPECT_NEAR(field_deg(6, s, 1), 2 * seen_at(std::acos(1 / std::sqrt(3.0)), s / std::sqrt(2.0)), 1e-4);
}

TEST(NeededField, AgreesWithTheTableOfTheDissertationBarTwoSlips) {
  EXPECT_NEAR(field_deg(2, 0.2, 1), 191.4, 0.05);
  EXPECT_NEAR(field_deg(3, 0.2, 1), 193.2,
              0.05);  // printed as 193.8: the decimals of two rows changed places
  EXPECT_NEAR(field_deg(4, 0.2, 1), 154.8, 0.05);  // printed as 154.2
  EXPECT_NEAR(field_deg(6, 0.2, 1), 123.8, 0.05);
}

// Five cameras: the direction that is worst lies where a pole's camera and two of the equator see alike, 28.6
// degrees up. Seen 30 degrees up, the equator's cameras give the dissertation's 141.2.
TEST(NeededField, OfFiveCamerasIsLessThanADirectionThirtyDegreesUpSuggests) {
  const auto places = symmetric_places(5, 0.2);
  const NeededField needed = needed_field(places, 1);
  EXPECT_NEAR(needed.field / kDegree, 140.42, 0.02);
  EXPECT_NEAR(std::abs(std::asin(needed.worst.z())) / kDegree, 28.6, 0.1);
  const double up = 30 * kDegree;
  const Eigen::Vector3d thirty(std::cos(up) * 0.5, std::cos(up) * std::sqrt(0.75), std::sin(up));
  const double equator = std::acos((thirty - places[2].centre).normalized().dot(places[2].axis));
  EXPECT_NEAR(2 * equator / kDegree, 141.2, 0.05);
  EXPECT_LT(2 * smallest_angle(places, thirty, 1), needed.field);
}

TEST(NeededField, FarAwayTheSpacingNoLongerMatters) {
  EXPECT_NEAR(field_deg(3, 0.2, kInfinitelyFar), 180, 1e-4);
  EXPECT_NEAR(field_deg(4, 0.2, kInfinitelyFar), 2 * std::acos(1.0 / 3) / kDegree, 1e-4);
  EXPECT_NEAR(field_deg(6, 0.2, 1e6), field_deg(6, 0, 1), 1e-3);
}

TEST(NeededField, NoDirectionNeedsMore) {
  const auto places = symmetric_places(5, 0.3);
  const double half = 0.5 * needed_field(places, 0.9).field;
  for (const Eigen::Vector3d& direction : even_directions(200'000))
    ASSERT_LE(smallest_angle(places, direction, 0.9), half + 1e-6);
}

TEST(SymmetricPlaces, NeighboursAreEquallyFarApart) {
  for (int cameras = kFewestSymmetric; cameras <= kMostSymmetric; ++cameras) {
    const auto places = symmetric_places(cameras, 0.2);
    for (const CameraPlace& one : places) {
      double nearest = 1e9;
      for (const CameraPlace& other : places) {
        const double apart = (one.centre - other.centre).norm();
        if (apart > 1e-9) nearest = std::min(nearest, apart);
      }
      EXPECT_NEAR(nearest, 0.2, 1e-12) << cameras;
      EXPECT_NEAR(one.axis.norm(), 1, 1e-12) << cameras;
    }
  }
}

TEST(EvenAttitudes, HaveNoPreferredDirection) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const auto attitudes = even_attitudes(500);
  for (const Eigen::Quaterniond& q : attitudes) {
    EXPECT_NEAR(q.norm(), 1, 1e-12);
    sum += q.toRotationMatrix();
  }
  EXPECT_LT((sum / 500).cwiseAbs().maxCoeff(), 0.02);
}

}  // namespace
}  // namespace omma::ground
