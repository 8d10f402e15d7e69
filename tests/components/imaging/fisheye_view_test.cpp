// A fisheye that is not there shows a painted sky where its formula puts it.
#include "components/imaging/fisheye_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "components/imaging/view.hpp"
#include "tests/components/imaging/painted_sky.hpp"

namespace omma {
namespace {

double smooth_sky(const Eigen::Vector3d& d) {
  return 0.15 + 0.05 * d.x() - 0.03 * d.z();
}

TEST(FisheyeView, ShowsHalfTheSkyAboutADirection) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Eigen::Quaterniond rig_from_j2000 = rotation_exp(Eigen::Vector3d(0.3, -0.2, 0.5));
  const testing::PaintedImages images = testing::paint(rig, rig_from_j2000, smooth_sky);
  const FisheyeView view(FisheyeSettings{.size = 128});
  const Eigen::Quaterniond j2000_from_view = pan_tilt(1.0, 0.4);
  std::vector<std::uint8_t> picture(128 * 128);
  ASSERT_EQ(view.render_rows(mosaic, images.views, rig_from_j2000 * j2000_from_view, 0, 128, picture), 128);
  int seen = 0;
  for (int v = 0; v < 128; ++v) {
    for (int u = 0; u < 128; ++u) {
      const Eigen::Vector2d from_centre(u - 63.5, v - 63.5);
      const double angle = from_centre.norm() * std::numbers::pi / 128;
      const int grey = picture[static_cast<std::size_t>(v * 128 + u)];
      if (angle > std::numbers::pi / 2) {
        ASSERT_EQ(grey, 0) << "outside the disc";
        continue;
      }
      if (grey == 0) continue;  // between the cameras
      ++seen;
      const Eigen::Vector2d across = std::sin(angle) * from_centre.normalized();
      const Eigen::Vector3d ray(across.x(), across.y(), std::cos(angle));
      ASSERT_NEAR(grey, companded(smooth_sky(j2000_from_view * ray), 0.25), 2) << u << ", " << v;
      Eigen::Vector2d pixel;
      ASSERT_TRUE(view.project(ray, pixel));
      ASSERT_LT((pixel - Eigen::Vector2d(u, v)).norm(),
                1e-7);  // near the centre an arc cosine has half its digits
    }
  }
  EXPECT_GT(seen, 9000);
}

TEST(FisheyeView, MakesItsRowsOneByOne) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const testing::PaintedImages images = testing::paint(rig, Eigen::Quaterniond::Identity(), smooth_sky);
  const FisheyeView view(FisheyeSettings{.size = 64, .field = 6.0});
  std::vector<std::uint8_t> whole(64 * 64);
  std::vector<std::uint8_t> rows(64 * 64);
  view.render_rows(mosaic, images.views, Eigen::Quaterniond::Identity(), 0, 64, whole);
  for (int row = 0; row < 64; row += 10)
    view.render_rows(mosaic, images.views, Eigen::Quaterniond::Identity(), row, 10,
                     std::span(rows).subspan(static_cast<std::size_t>(row) * 64));
  EXPECT_EQ(rows, whole);
  EXPECT_EQ(view.render_rows(mosaic, images.views, Eigen::Quaterniond::Identity(), 64, 5, rows), 0);
}

TEST(FisheyeView, RefusesWhatNoFisheyeCanBe) {
  EXPECT_THROW(FisheyeView(FisheyeSettings{.size = 0}), std::invalid_argument);
  EXPECT_THROW(FisheyeView(FisheyeSettings{.field = 7}), std::invalid_argument);
  EXPECT_THROW(FisheyeView(FisheyeSettings{.field = 0}), std::invalid_argument);
  EXPECT_THROW(FisheyeView(FisheyeSettings{.white = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace omma
