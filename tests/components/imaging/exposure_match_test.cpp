// Matching exposures: what the overlaps say about the gains, and what they must not say.
#include "components/imaging/exposure_match.hpp"

#include <gtest/gtest.h>

#include "components/imaging/panorama.hpp"
#include "tests/components/imaging/painted_sky.hpp"

namespace omma {
namespace {

const Eigen::Quaterniond kTurned = rotation_exp(Eigen::Vector3d(0.4, -1.1, 2.0));

double bright_sky(const Eigen::Vector3d& d) {
  return 0.3 + 0.1 * d.x() - 0.05 * d.z();
}

std::vector<std::uint8_t> render(const Mosaic& mosaic, const testing::PaintedImages& images,
                                 OverlapSums* sums) {
  const Panorama panorama({256, 1.0});
  std::vector<std::uint8_t> pixels(256 * 128);
  panorama.render_rows(mosaic, images.views, kTurned, 0, 128, pixels, sums);
  return pixels;
}

TEST(ExposureMatch, OverlapsTellHowMuchDarkerACameraIs) {
  const Rig rig = testing::tetrahedral_rig();
  Mosaic mosaic(rig, {}, Footprint::kMean);
  testing::PaintedImages images = testing::paint(rig, kTurned, bright_sky);
  for (auto& pixel : images.pixels[1]) pixel = static_cast<std::uint16_t>(pixel * 0.8);
  OverlapSums sums;
  render(mosaic, images, &sums);
  const auto gains = match_exposure(sums, 3);
  EXPECT_NEAR(gains[1] / gains[0], 1 / 0.8, 0.02);
  EXPECT_NEAR(gains[1] / gains[2], 1 / 0.8, 0.02);
  EXPECT_NEAR((gains[0] + gains[1] + gains[2]) / 3, 1, 0.05) << "the picture as a whole keeps its level";
  EXPECT_EQ(gains[3], 1) << "no such camera";
}

TEST(ExposureMatch, AMatchedPanoramaShowsNoSeam) {
  const Rig rig = testing::tetrahedral_rig();
  Mosaic mosaic(rig, {}, Footprint::kMean);
  testing::PaintedImages images = testing::paint(rig, kTurned, bright_sky);
  for (auto& pixel : images.pixels[1]) pixel = static_cast<std::uint16_t>(pixel * 0.8);
  // The steepest step from one pixel to the next along the rows: a seam, where there is one.
  const auto steepest = [](const std::vector<std::uint8_t>& pixels) {
    int worst = 0;
    for (int v = 20; v < 108; ++v) {
      for (int u = 1; u < 256; ++u) {
        const int a = pixels[v * 256 + u - 1];
        const int b = pixels[v * 256 + u];
        if (a != 0 && b != 0) worst = std::max(worst, std::abs(a - b));
      }
    }
    return worst;
  };
  OverlapSums sums;
  const int before = steepest(render(mosaic, images, &sums));
  const auto gains = match_exposure(sums, 3);
  for (int camera = 0; camera < 3; ++camera) mosaic.levels()[camera].gain = gains[camera];
  const int after = steepest(render(mosaic, images, nullptr));
  EXPECT_GT(before, after) << "the difference shows before";
  EXPECT_LE(after, 2) << "grey levels, the sky's own slope";
}

TEST(ExposureMatch, ADarkSkyLeavesTheGainsAtOne) {
  OverlapSums sums;
  std::uint32_t state = 7;
  for (int i = 0; i < 20000; ++i) {
    const auto noise = [&] {
      state = state * 1664525U + 1013904223U;
      return ((state >> 16) % 1000 - 499.5) / 500 * 0.01;  // read noise of a hundredth of white, no light
    };
    const double a = noise();
    sums.add(0, a, 1, noise());
  }
  const auto gains = match_exposure(sums, 2);
  EXPECT_NEAR(gains[0], 1, 1e-3);
  EXPECT_NEAR(gains[1], 1, 1e-3);
}

TEST(ExposureMatch, ACameraWithoutOverlapKeepsItsGain) {
  OverlapSums sums;
  for (int i = 0; i < 1000; ++i) sums.add(0, 0.4, 1, 0.3);
  const auto gains = match_exposure(sums, 3);
  EXPECT_NEAR(gains[2], 1, 1e-12);
  EXPECT_NEAR(gains[0] * 0.4, gains[1] * 0.3, 0.01);
}

}  // namespace
}  // namespace omma
