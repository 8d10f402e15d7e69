// The virtual pan-tilt camera: what it points at is in its middle, upright, at the scale of its pinhole.
#include "components/imaging/view.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/components/imaging/painted_sky.hpp"

namespace omma {
namespace {

const Eigen::Quaterniond kTurned = rotation_exp(Eigen::Vector3d(0.4, -1.1, 2.0));

Eigen::Vector3d direction(double pan, double tilt) {
  return {std::cos(tilt) * std::cos(pan), std::cos(tilt) * std::sin(pan), std::sin(tilt)};
}

TEST(PanTilt, LooksWhereItIsToldWithTheBasesZUp) {
  for (double pan = -3; pan < 3; pan += 0.7) {
    for (double tilt = -1.5; tilt < 1.5; tilt += 0.4) {
      const Eigen::Quaterniond base_from_view = pan_tilt(pan, tilt);
      EXPECT_LT((base_from_view * Eigen::Vector3d::UnitZ() - direction(pan, tilt)).norm(), 1e-12);
      EXPECT_LT((base_from_view * Eigen::Vector3d::UnitY()).z(), 0) << "down is down";
      EXPECT_NEAR((base_from_view * Eigen::Vector3d::UnitX()).z(), 0, 1e-12) << "the horizon is level";
    }
  }
}

TEST(View, ShowsALampWhereItsPinholeSaysThroughEveryCamera) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const View view({160, 120, 0.7, 0.5});
  for (const double pan : {0.3, 2.4, 4.5}) {
    const double tilt = 0.2;
    const Eigen::Vector3d lamp = direction(pan + 0.15, tilt - 0.1);
    const auto images = testing::paint(rig, kTurned, [&](const Eigen::Vector3d& d) {
      const double angle = std::atan2(d.cross(lamp).norm(), d.dot(lamp));
      return 0.4 * std::exp(-0.5 * angle * angle / (0.03 * 0.03));
    });
    std::vector<std::uint8_t> pixels(160 * 120);
    const Eigen::Quaterniond base_from_view = pan_tilt(pan, tilt);
    ASSERT_EQ(view.render_rows(mosaic, images.views, kTurned * base_from_view, 0, 120, pixels), 120);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // (u, v, 1) weighted with the light
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const double root = std::max(0, pixels[v * 160 + u] - 1) / 254.0;
        if (root * root < 0.1) continue;
        sum += root * root * Eigen::Vector3d(u, v, 1);
      }
    }
    Eigen::Vector2d expected;
    ASSERT_TRUE(view.project(base_from_view.conjugate() * lamp, expected));
    ASSERT_GT(sum.z(), 0) << "pan " << pan;
    EXPECT_NEAR(sum.x() / sum.z(), expected.x(), 0.3);
    EXPECT_NEAR(sum.y() / sum.z(), expected.y(), 0.3);
    EXPECT_LT(expected.x(), 79.5) << "a greater right ascension is further left";
    EXPECT_GT(expected.y(), 59.5) << "a smaller declination is further down";
  }
}

TEST(View, RefusesSettingsThatMakeNoPicture) {
  EXPECT_THROW(View({0, 100, 1, 0.25}), std::invalid_argument);
  EXPECT_THROW(View({100, 100, std::numbers::pi, 0.25}), std::invalid_argument);
  EXPECT_THROW(View({100, 100, 1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace omma
