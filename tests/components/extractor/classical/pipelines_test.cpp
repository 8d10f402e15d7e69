// The three classical pipelines find what they were made for, and show their stages in the order of the
// source.
#include "components/extractor/classical/pipelines.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/bench/spot_scene.hpp"

namespace omma {
namespace {

struct Found {
  int found = 0, false_dots = 0;
};

Found judge(const SpotScene& scene, std::span<const ClassicalDot> dots) {
  Found result;
  std::vector<bool> used(dots.size(), false);
  for (const MadeSpot& spot : scene.spots) {
    for (std::size_t i = 0; i < dots.size(); ++i) {
      if (used[i] || (dots[i].pixel - spot.pixel).norm() > 1.5) continue;
      used[i] = true;
      ++result.found;
      break;
    }
  }
  result.false_dots = static_cast<int>(std::count(used.begin(), used.end(), false));
  return result;
}

class Pipelines : public testing::Test {
 protected:
  GreyImage bright_spots(double sigma) {
    scene.width = 320;
    scene.height = 240;
    scene.spots = grid_of_spots(scene, 48, sigma, 80, random);
    return grey_image(render(scene, random).view());
  }
  Found found(ClassicalAlgorithm algorithm, const GreyImage& image) {
    ClassicalPipelines pipelines(image.width, image.height, parameters);
    pipelines.original() = image;
    return judge(scene, pipelines.run(algorithm, &observer));
  }
  SpotScene scene;
  std::mt19937_64 random{4};
  ClassicalParameters parameters;
  std::vector<std::string> names;
  StageObserver observer = [this](std::string_view name, const GreyImage& image) {
    names.emplace_back(name);
    EXPECT_EQ(image.width, 320);
    EXPECT_EQ(image.height, 240);
  };
};

TEST_F(Pipelines, MlasFindsBrightTargetsInFifteenSteps) {
  const GreyImage image = bright_spots(2.5);
  const Found result = found(ClassicalAlgorithm::kMlas, image);
  EXPECT_EQ(result.found, static_cast<int>(scene.spots.size()));
  EXPECT_LE(result.false_dots, 2);
  EXPECT_EQ(names.size(), 12U);
  EXPECT_EQ(names.front(), "original");
  EXPECT_EQ(names.back(), "local threshold again");
}

TEST_F(Pipelines, SmallTargetFindsSmallTargetsOnASlope) {
  scene.slope = 0.4;
  const GreyImage image = bright_spots(1.5);
  const Found result = found(ClassicalAlgorithm::kSmallTarget, image);
  EXPECT_GE(result.found, static_cast<int>(scene.spots.size()) - 1);
  EXPECT_LE(result.false_dots, 3);
  EXPECT_EQ(names[1], "without low frequencies");
}

TEST_F(Pipelines, StarsFindsPointsAndTakesABlackFrameAway) {
  parameters.deviations = 3.5;
  GreyImage image = bright_spots(0.7);
  GreyImage black(320, 240);
  for (int v = 24; v < 240; v += 48) {  // a pattern the sensor has in the dark
    for (int u = 24; u < 320; u += 48) {
      image.at(u, v) += 90;
      black.at(u, v) = 90;
    }
  }
  GreyImage clean = image;
  subtract(black, clean);
  const Found with = found(ClassicalAlgorithm::kStars, clean);
  EXPECT_EQ(names.size(), 18U);
  const Found without = found(ClassicalAlgorithm::kStars, image);
  EXPECT_GE(with.found, static_cast<int>(scene.spots.size()) - 1);
  EXPECT_GT(without.false_dots, with.false_dots + 10);
  EXPECT_EQ(names.front(), "original less black frame");
}

TEST_F(Pipelines, FindNothingInAnEvenImage) {
  GreyImage image(320, 240);
  std::fill(image.value.begin(), image.value.end(), 40.0F);
  for (const auto algorithm :
       {ClassicalAlgorithm::kMlas, ClassicalAlgorithm::kSmallTarget, ClassicalAlgorithm::kStars})
    EXPECT_EQ(found(algorithm, image).false_dots, 0);
}

}  // namespace
}  // namespace omma
