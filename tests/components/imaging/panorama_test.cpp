// The whole-sky panorama: directions at the right pixels, seams that do not show, exposures matched.
#include "components/imaging/panorama.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/components/imaging/painted_sky.hpp"

namespace omma {
namespace {

using std::numbers::pi;

const Eigen::Quaterniond kTurned = rotation_exp(Eigen::Vector3d(0.4, -1.1, 2.0));

Eigen::Vector3d direction(double right_ascension, double declination) {
  return {std::cos(declination) * std::cos(right_ascension),
          std::cos(declination) * std::sin(right_ascension), std::sin(declination)};
}

/// A smooth blob of light on a dark sky.
testing::PaintedSky lamp(const Eigen::Vector3d& at, double radius, double floor = 0.02) {
  return [=](const Eigen::Vector3d& d) {
    const double angle = std::atan2(d.cross(at).norm(), d.dot(at));
    return floor + 0.4 * std::exp(-0.5 * angle * angle / (radius * radius));
  };
}

/// A smooth sky in every direction: 0.05 … 0.15 of white.
double smooth_sky(const Eigen::Vector3d& d) {
  return 0.10 + 0.03 * d.x() + 0.02 * d.y() * d.z() - 0.02 * d.z();
}

double light_of(std::uint8_t companded_grey, double white) {
  const double root = (companded_grey - 1) / 254.0;
  return white * root * root;
}

std::vector<std::uint8_t> render(const Panorama& panorama, const Mosaic& mosaic, RigImages images,
                                 const Eigen::Quaterniond& attitude, OverlapSums* sums = nullptr) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(panorama.width()) * panorama.height());
  panorama.render_rows(mosaic, images, attitude, 0, panorama.height(), pixels, sums);
  return pixels;
}

TEST(PanoramaProjection, PixelAndDirectionAreInverse) {
  for (double u = 0.25; u < 512; u += 17.3) {
    for (double v = 0.25; v < 255; v += 11.7) {
      const Eigen::Vector2d back = panorama_pixel(panorama_direction({u, v}, 512), 512);
      EXPECT_NEAR(back.x(), u, 1e-9);
      EXPECT_NEAR(back.y(), v, 1e-9);
    }
  }
}

TEST(PanoramaProjection, RightAscensionGrowsToTheLeftAndNorthIsUp) {
  EXPECT_NEAR(panorama_pixel(direction(0.5 * pi, 0), 720).x(), 539.5, 1e-9);
  EXPECT_NEAR(panorama_pixel(direction(1.5 * pi, 0), 720).x(), 179.5, 1e-9);
  EXPECT_LT(panorama_pixel(direction(1, 1), 720).y(), panorama_pixel(direction(1, 0), 720).y());
}

TEST(Panorama, PutsALampInAnyKnownDirectionAtItsPixel) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Panorama panorama({720, 0.5});
  for (const Eigen::Vector3d& at : {direction(0.3, 0.2), direction(2.9, -0.9), direction(5.5, 0.8)}) {
    const testing::PaintedImages images = testing::paint(rig, kTurned, lamp(at, 0.03));
    const std::vector<std::uint8_t> pixels = render(panorama, mosaic, images.views, kTurned);
    // Centroid of the light over its floor, each pixel counted by the sky it covers.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int v = 0; v < panorama.height(); ++v) {
      for (int u = 0; u < panorama.width(); ++u) {
        const double light = light_of(pixels[static_cast<std::size_t>(v) * panorama.width() + u], 0.5);
        if (light < 0.1) continue;
        const Eigen::Vector3d d = panorama_direction(Eigen::Vector2d(u, v), panorama.width());
        sum += (light - 0.02) * std::hypot(d.x(), d.y()) * d;
      }
    }
    ASSERT_GT(sum.norm(), 0) << "the lamp is not in the picture";
    const double off = std::atan2(sum.cross(at).norm(), sum.dot(at));
    EXPECT_LT(off * 180 / pi, 0.05) << "a tenth of a pixel of the panorama";
  }
}

TEST(Panorama, SeamsDoNotShowOnASmoothSky) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Panorama panorama({512, 0.25});
  const testing::PaintedImages images = testing::paint(rig, kTurned, smooth_sky);
  const std::vector<std::uint8_t> pixels = render(panorama, mosaic, images.views, kTurned);
  int seen = 0;
  int worst = 0;
  for (int v = 0; v < panorama.height(); ++v) {
    for (int u = 0; u < panorama.width(); ++u) {
      const int grey = pixels[static_cast<std::size_t>(v) * panorama.width() + u];
      if (grey == 0) continue;
      ++seen;
      const double truth = smooth_sky(panorama_direction(Eigen::Vector2d(u, v), panorama.width()));
      worst = std::max(worst, std::abs(grey - companded(truth, 0.25)));
    }
  }
  EXPECT_LE(worst, 1) << "grey levels";
  EXPECT_GT(seen, 0.8 * panorama.width() * panorama.height());
}

TEST(Panorama, IsTheSameWhateverTheRigsAttitude) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Panorama panorama({256, 0.25});
  const Eigen::Quaterniond other = rotation_exp(Eigen::Vector3d(-1.0, 0.3, 0.2));
  const auto first = testing::paint(rig, kTurned, smooth_sky);
  const auto second = testing::paint(rig, other, smooth_sky);
  const std::vector<std::uint8_t> a = render(panorama, mosaic, first.views, kTurned);
  const std::vector<std::uint8_t> b = render(panorama, mosaic, second.views, other);
  int compared = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == 0 || b[i] == 0) continue;
    ++compared;
    ASSERT_LE(std::abs(a[i] - b[i]), 1) << "pixel " << i;
  }
  EXPECT_GT(compared, 20000);
}

TEST(Panorama, StripsOfRowsAreTheWholePicture) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kPeak);
  const Panorama panorama({256, 0.25});
  const auto images = testing::paint(rig, kTurned, lamp(direction(1, 0.1), 0.2));
  const std::vector<std::uint8_t> whole = render(panorama, mosaic, images.views, kTurned);
  std::vector<std::uint8_t> strips;
  std::vector<std::uint8_t> strip(256 * 7);
  for (int row = 0; row < panorama.height(); row += 7) {
    const int made = panorama.render_rows(mosaic, images.views, kTurned, row, 7, strip, nullptr);
    strips.insert(strips.end(), strip.begin(), strip.begin() + made * 256);
  }
  EXPECT_EQ(strips, whole);
}

TEST(Panorama, DirectionsNoCameraSeesAreZeroAndTheOthersAreNot) {
  Rig rig;
  rig.cameras.push_back({Name("only"), Lens::pinhole(200, 200, 1.0), {}});
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Panorama panorama({360, 0.25});
  const auto images = testing::paint(rig, Eigen::Quaterniond::Identity(), [](const auto&) { return 0.0; });
  const std::vector<std::uint8_t> pixels =
      render(panorama, mosaic, images.views, Eigen::Quaterniond::Identity());
  for (int v = 0; v < panorama.height(); ++v) {
    for (int u = 0; u < panorama.width(); ++u) {
      Eigen::Vector2d pixel;
      const Eigen::Vector3d d = panorama_direction(Eigen::Vector2d(u, v), panorama.width());
      const bool seen = rig.cameras[0].lens.project(d, pixel);
      ASSERT_EQ(pixels[static_cast<std::size_t>(v) * panorama.width() + u] != 0, seen) << u << ", " << v;
    }
  }
}

TEST(Panorama, ACameraWithoutAFrameLeavesItsShareToTheOthers) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Panorama panorama({256, 0.25});
  auto images = testing::paint(rig, kTurned, smooth_sky);
  const std::vector<std::uint8_t> all = render(panorama, mosaic, images.views, kTurned);
  images.views[1] = {};
  const std::vector<std::uint8_t> fewer = render(panorama, mosaic, images.views, kTurned);
  const auto unseen = [](const std::vector<std::uint8_t>& p) { return std::count(p.begin(), p.end(), 0); };
  EXPECT_GT(unseen(fewer), unseen(all));
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (fewer[i] == 0) continue;
    ASSERT_NEAR(fewer[i], all[i], 1);
  }
}

TEST(Panorama, AnImageOfAnotherSizeThanItsLensIsLeftOut) {
  const Rig rig = testing::tetrahedral_rig();
  const Mosaic mosaic(rig, {}, Footprint::kMean);
  const Panorama panorama({128, 0.25});
  auto images = testing::paint(rig, kTurned, smooth_sky);
  auto without = images.views;
  without[2] = {};
  images.views[2].height -= 1;
  EXPECT_EQ(render(panorama, mosaic, images.views, kTurned), render(panorama, mosaic, without, kTurned));
}

TEST(Panorama, PeakFootprintKeepsAOnePixelStarBright) {
  const Rig rig = testing::tetrahedral_rig();
  const Panorama panorama({256, 0.5});
  auto images = testing::paint(rig, kTurned, [](const auto&) { return 0.01; });
  const Eigen::Vector2d at(170, 170);
  images.pixels[1][170 * 341 + 170] = 2000;
  const auto brightest = [&](Footprint footprint) {
    const Mosaic mosaic(rig, {}, footprint);
    const auto pixels = render(panorama, mosaic, images.views, kTurned);
    return light_of(*std::max_element(pixels.begin(), pixels.end()), 0.5);
  };
  EXPECT_GT(brightest(Footprint::kPeak), 0.2) << "blended with the dark pixels of overlapping cameras";
  EXPECT_GT(brightest(Footprint::kPeak), 3 * brightest(Footprint::kMean));
}

TEST(Panorama, RefusesSettingsThatMakeNoPicture) {
  EXPECT_THROW(Panorama({511, 0.25}), std::invalid_argument);
  EXPECT_THROW(Panorama({0, 0.25}), std::invalid_argument);
  EXPECT_THROW(Panorama({512, 0}), std::invalid_argument);
  EXPECT_THROW(RayTable(Rig{}, {}), std::invalid_argument);
  EXPECT_THROW(RayTable(testing::tetrahedral_rig(), {1, 0.3}), std::invalid_argument);
  EXPECT_THROW(RayTable(testing::tetrahedral_rig(), {64, 0}), std::invalid_argument);
}

TEST(RayTable, AgreesWithTheLensToATenthOfAPixel) {
  Rig rig = testing::tetrahedral_rig();
  rig.cameras[0].lens = Lens::equidistant(1024, 768, 480, {511.5, 383.5}, 1.4);  // as fine as the real ones
  const RayTable table(rig, {});
  std::array<SeenPixel, limits::kCameras> seen;
  int compared = 0;
  for (int v = 0; v < 180; ++v) {
    for (int u = 0; u < 360; ++u) {
      const Eigen::Vector3d d = panorama_direction({u + 0.31, v + 0.17}, 360);
      table.look(d, seen);
      for (int camera = 0; camera < 3; ++camera) {
        const SeenPixel exact = table.look_exactly(d, camera);
        ASSERT_EQ(seen[camera].weight > 0, exact.weight > 0) << "rim of camera " << camera;
        if (!(exact.weight > 0)) continue;
        ++compared;
        ASSERT_LT(std::hypot(seen[camera].u - exact.u, seen[camera].v - exact.v), 0.1);
        ASSERT_NEAR(seen[camera].weight, exact.weight, 0.05);
      }
    }
  }
  EXPECT_GT(compared, 50000);
}

}  // namespace
}  // namespace omma
