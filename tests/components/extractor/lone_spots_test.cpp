// Spots fitted eight side by side are what each gives by itself.
#include "components/extractor/lone_spots.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/bench/spot_scene.hpp"

namespace omma {
namespace {

constexpr int kRadius = 3;

class LoneSpotsTest : public testing::Test {
 protected:
  LoneSpotsTest() {
    scene_.background = 12;
    scene_.noise = 1.5;
    scene_.spots = grid_of_spots(scene_, 40, 1.0, 30, random_);
    noise_ = {12, 1.5F, 0, 0};
    prior_.sigma = 1;
    prior_.sigma_error = 0.1F;
    prior_.background_error = 0.75F;
  }
  // A start a fifth of a pixel from the truth.
  static SpotFit start_of(const MadeSpot& spot) {
    SpotFit fit;
    fit.flux = 0.9 * spot.flux;
    fit.u = spot.pixel.x() + 0.15;
    fit.v = spot.pixel.y() - 0.15;
    fit.sigma = 1;
    return fit;
  }
  SpotFit fitted_alone(const ImageView& image, SpotFit fit) const {
    SpotWindow window;
    window.width = window.height = 2 * kRadius + 1;
    window.left = nearest_pixel(fit.u) - kRadius;
    window.top = nearest_pixel(fit.v) - kRadius;
    load_window(image, false, noise_.background, {}, window);
    fit_spot(window, noise_, prior_, fit);
    return fit;
  }

  std::mt19937_64 random_{5};
  SpotScene scene_;
  PixelNoise noise_;
  SpotPrior prior_;
};

TEST_F(LoneSpotsTest, AreWhatEachGivesByItself) {
  const Image image = render(scene_, random_);
  LoneSpots spots;
  int compared = 0;
  for (std::size_t first = 0; first + kLanes <= scene_.spots.size(); first += kLanes) {
    spots.start(kRadius);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const SpotFit start = start_of(scene_.spots[first + i]);
      ASSERT_TRUE(LoneSpots::fits(image.view(), start.u, start.v, kRadius));
      spots.add(start, noise_, prior_);
    }
    spots.load(image.view(), false);
    for (int k = 0; k < 10; ++k) spots.step();
    for (std::size_t i = 0; i < kLanes; ++i) {
      SpotFit fit;
      spots.get(i, fit);
      const SpotFit alone = fitted_alone(image.view(), start_of(scene_.spots[first + i]));
      ASSERT_TRUE(fit.usable);
      ASSERT_TRUE(alone.usable);
      EXPECT_NEAR(fit.u, alone.u, 1e-4);
      EXPECT_NEAR(fit.v, alone.v, 1e-4);
      EXPECT_NEAR(fit.sigma, alone.sigma, 1e-4);
      EXPECT_NEAR(fit.flux / alone.flux, 1, 1e-4);
      EXPECT_TRUE(fit.covariance.isApprox(alone.covariance, 1e-3)) << fit.covariance << "\n"
                                                                   << alone.covariance;
      EXPECT_NEAR(fit.chi2_per_pixel, alone.chi2_per_pixel, 1e-3);
      EXPECT_NEAR(fit.stretch, alone.stretch, 1e-3);
      EXPECT_NEAR(fit.skew, alone.skew, 1e-3);
      EXPECT_NEAR(fit.shape_error / alone.shape_error, 1, 1e-3);
      EXPECT_NEAR(fit.flux_information / alone.flux_information, 1, 1e-4);
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

TEST_F(LoneSpotsTest, LeaveWindowsWithAFullPixelToTheFitByItself) {
  Image image = render(scene_, random_);
  const SpotFit start = start_of(scene_.spots[20]);
  const int u = nearest_pixel(start.u) - kRadius, v = nearest_pixel(start.v) + kRadius;
  image.pixels[static_cast<std::size_t>(v * image.width + u)] = std::byte{255};
  LoneSpots spots;
  spots.start(kRadius);
  spots.add(start, noise_, prior_);
  spots.add(start_of(scene_.spots[21]), noise_, prior_);
  spots.load(image.view(), false);
  spots.step();
  EXPECT_FALSE(spots.is_fit(0));
  EXPECT_TRUE(spots.is_fit(1));
}

TEST_F(LoneSpotsTest, NeedTheirWholeWindowInTheImage) {
  const Image image = render(scene_, random_);
  const ImageView view = image.view();
  EXPECT_TRUE(LoneSpots::fits(view, 3, 3, kRadius));
  EXPECT_FALSE(LoneSpots::fits(view, 2.4, 3, kRadius));
  EXPECT_FALSE(LoneSpots::fits(view, 3, 2.4, kRadius));
  EXPECT_FALSE(LoneSpots::fits(view, view.width - 4, 3, kRadius));  // a column more is read than is used
  EXPECT_TRUE(LoneSpots::fits(view, view.width - 5, 3, kRadius));
  EXPECT_FALSE(LoneSpots::fits(view, 3, view.height - 3, kRadius));
}

}  // namespace
}  // namespace omma
