// A light is given up where it turns with the rig, or where another has long been brighter.
#include "components/approach/light_doubt.hpp"

#include <gtest/gtest.h>

#include "components/geometry/pose.hpp"

namespace omma {
namespace {

constexpr double kSigma = 1e-3;
const Eigen::Vector3d kLight = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();

Eigen::Matrix3d turned(double angle) {
  return rotation_exp(Eigen::Vector3d(0, angle, 0)).toRotationMatrix();
}

TEST(LightDoubt, AWarmPixelIsGivenUpWhenTheSkyHasTurned) {
  LightDoubt doubt;
  doubt.start(kLight, turned(0));
  const auto pixel = [](double angle) -> Eigen::Vector3d { return turned(angle).transpose() * kLight; };
  EXPECT_FALSE(doubt.stands_with_rig(pixel(0), kSigma, turned(0)));
  EXPECT_FALSE(doubt.stands_with_rig(pixel(0.01), kSigma, turned(0.01)));  // too little to tell
  EXPECT_TRUE(doubt.stands_with_rig(pixel(0.05), kSigma, turned(0.05)));
}

TEST(LightDoubt, ALightAmongTheStarsIsKept) {
  LightDoubt doubt;
  doubt.start(kLight, turned(0));
  for (double angle = 0; angle < 1; angle += 0.02)
    EXPECT_FALSE(doubt.stands_with_rig(kLight, kSigma, turned(angle)));
  const Eigen::Vector3d drifted = turned(0.04) * kLight;  // against the turn of the rig
  EXPECT_FALSE(doubt.stands_with_rig(drifted, kSigma, turned(0.1)));
}

TEST(LightDoubt, NothingIsToldByARigThatDoesNotTurn) {
  LightDoubt doubt;
  doubt.start(kLight, turned(0.2));
  EXPECT_FALSE(doubt.stands_with_rig(kLight, kSigma, turned(0.2)));
}

TEST(LightDoubt, OnlyALightThatStaysBrighterOutshinesIt) {
  LightDoubt doubt;
  doubt.start(kLight, turned(0));
  int frame_sets = 0;
  for (; frame_sets < 100 && !doubt.outshone(7, 60, 40); ++frame_sets) {
  }
  EXPECT_EQ(frame_sets, 19);

  doubt.start(kLight, turned(0));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(doubt.outshone(7, 45, 40));  // no more than noise
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(doubt.outshone(7, i % 2 == 0 ? 60 : 40, 50));
  for (std::uint32_t i = 0; i < 100; ++i)
    EXPECT_FALSE(doubt.outshone(1 + i % 2, 60, 40));  // never the same one
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(doubt.outshone(0, 0, 0));
}

}  // namespace
}  // namespace omma
