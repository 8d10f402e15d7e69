// The solver on photographs that others took, rendered and solved: what must be solved is, to the accuracy
// its truth allows, and nothing is solved wrongly.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "components/catalogue/solar_system.hpp"
#include "components/extractor/dot_extractor.hpp"
#include "ground/solve/photograph_solver.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/bench/photograph_stars.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

std::vector<Photograph> shared(PhotographGroup group) {
  return photographs(OMMA_SHARED_DATA "/data", group);
}

#define OMMA_NEEDS(photographs) \
  if ((photographs).empty()) GTEST_SKIP() << "needs the photographs of the shared data folder"

ground::PhotographSolution solved(const Photograph& photograph) {
  std::vector<Image> images;
  std::vector<ImageView> views;
  for (const auto& file : photograph.images) images.push_back(read_image(file));
  for (const Image& image : images) views.push_back(image.view());
  ground::SolverOptions options;
  options.observer = photograph.observer;
  return ground::PhotographSolver(photograph.rig, options).solve(views);
}

/// Solved within its tolerance.
void expect_right(const Photograph& photograph, const ground::PhotographSolution& solution) {
  ASSERT_TRUE(solution.solved) << photograph.name << ": " << solution.reason;
  const Eigen::Vector3d error = error_arcsec(photograph, solution.attitude.rig_from_j2000);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LE(std::abs(error[axis]), photograph.tolerance_arcsec[axis])
        << photograph.name << ", axis " << axis;
}

TEST(Photographs, LongyearbyenIsSolvedWithAndWithoutEpochAndSite) {
  const auto all = shared(PhotographGroup::kLongyearbyen);
  OMMA_NEEDS(all);
  ASSERT_EQ(all.size(), 2u);
  for (const Photograph& photograph : all) {
    const auto solution = solved(photograph);
    expect_right(photograph, solution);
    EXPECT_GE(solution.stars_used, 60) << photograph.name;
  }
}

// A still camera whose sharp spots are drawn out a little, each in a way of its own: no trails. The list of
// 512 dots is full; that which another measure of the light fills holds as many of the listed stars.
TEST(Photographs, StarsOverLongyearbyenAreMeasuredAsTheSpotsTheyAre) {
  const auto all = shared(PhotographGroup::kLongyearbyen);
  OMMA_NEEDS(all);
  const Image image = read_image(all[0].images[0]);
  DotExtractor extractor(image.width, image.height);
  const auto list = std::make_unique<DotList>();
  extractor.extract(image.view(), ExtractorParameters{}, *list);
  const PhotographStars stars = stars_found(all[0], list->dots);
  EXPECT_EQ(stars.listed, 329);
  EXPECT_GE(stars.found, 283);
  EXPECT_GE(stars.brightest_are_stars, 321);
}

// Of the planets only Mars stood above the horizon and bright enough, south of the zenith.
TEST(Photographs, MarsIsNamedOverLongyearbyen) {
  const auto all = shared(PhotographGroup::kLongyearbyen);
  OMMA_NEEDS(all);
  const auto solution = solved(all[0]);
  ASSERT_EQ(solution.solar.size(), 1U);
  EXPECT_EQ(solution.solar[0].pairing.entry, static_cast<std::uint16_t>(SolarBody::kMars));
  EXPECT_LT(solution.solar[0].residual_px, 1.0);
  for (const ground::SolvedPair& pair : solution.pairs)
    EXPECT_FALSE(pair.pairing.camera == solution.solar[0].pairing.camera &&
                 pair.pairing.dot == solution.solar[0].pairing.dot);
}

TEST(Photographs, EpochAndSiteMakeTheLongyearbyenResidualsSmaller) {
  const auto all = shared(PhotographGroup::kLongyearbyen);
  OMMA_NEEDS(all);
  EXPECT_LT(solved(all[0]).residual_rms_px, solved(all[1]).residual_rms_px);
}

TEST(Photographs, FourRigsAreSolvedJointlyWithinThirtyArcseconds) {
  const auto all = shared(PhotographGroup::kRigs);
  OMMA_NEEDS(all);
  ASSERT_EQ(all.size(), 4u);
  for (const Photograph& photograph : all) {
    ASSERT_EQ(photograph.images.size(), 3u);
    ASSERT_EQ(photograph.tolerance_arcsec, Eigen::Vector3d::Constant(30));
    const auto solution = solved(photograph);
    expect_right(photograph, solution);
    for (const auto& camera : solution.cameras) EXPECT_GE(camera.stars_used, 50) << photograph.name;
  }
}

TEST(Photographs, EachRigImageIsSolvedAlone) {
  const auto all = shared(PhotographGroup::kRigImages);
  OMMA_NEEDS(all);
  ASSERT_EQ(all.size(), 12u);
  for (const Photograph& photograph : all) expect_right(photograph, solved(photograph));
}

TEST(Photographs, EachProjectionIsSolved) {
  const auto all = shared(PhotographGroup::kSingles);
  OMMA_NEEDS(all);
  ASSERT_EQ(all.size(), 5u);
  for (const Photograph& photograph : all) expect_right(photograph, solved(photograph));
}

TEST(Photographs, MoonPlanetsAndGroundLightsDoNotKeepTheSkyFromBeingSolved) {
  const auto all = shared(PhotographGroup::kClutter);
  OMMA_NEEDS(all);
  ASSERT_EQ(all.size(), 3u);
  for (const Photograph& photograph : all) expect_right(photograph, solved(photograph));
}

TEST(Photographs, MediumFieldsOfAnAssumedPinholeAreSolvedOrLeftOpenButNeverWrong) {
  const auto all = shared(PhotographGroup::kMediumField);
  OMMA_NEEDS(all);
  int right = 0;
  for (const Photograph& photograph : all) {
    const auto solution = solved(photograph);
    if (!solution.solved || !photograph.has_truth) continue;
    expect_right(photograph, solution);
    ++right;
  }
  EXPECT_EQ(right, 7);  // of the seven that any solver is known to have solved
}

TEST(Photographs, TreesTextAndAMeteorBrighterThanMostStarsDoNotKeepTheSkyFromBeingSolved) {
  const auto all = shared(PhotographGroup::kIndi);
  OMMA_NEEDS(all);
  const auto solution = solved(all[0]);
  expect_right(all[0], solution);
  EXPECT_GE(solution.stars_used, 150);
}

// The rendered images have no noise at all: a sensor's is added, background and photons, and they still must
// be right. (The draws are the same on every machine; only their sum of uniform numbers is used.)
TEST(Photographs, RigsWithSensorNoiseAreSolvedJointlyAndAlone) {
  const auto all = shared(PhotographGroup::kRigs);
  OMMA_NEEDS(all);
  std::mt19937 random(1);
  const auto gauss = [&] {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += double(random()) / 4294967296.0;
    return sum;
  };
  for (const Photograph& photograph : all) {
    std::vector<Image> images;
    for (const auto& file : photograph.images) images.push_back(read_image(file));
    for (Image& image : images) {
      for (std::byte& pixel : image.pixels) {
        const double grey = 20 + std::to_integer<int>(pixel);
        const double noisy = grey + std::sqrt(4 + 0.2 * grey) * gauss();
        pixel = static_cast<std::byte>(std::clamp(noisy, 0.0, 255.0));
      }
    }
    ground::PhotographSolver solver(photograph.rig, {});
    expect_right(photograph, solver.solve({images[0].view(), images[1].view(), images[2].view()}));
    for (std::size_t c = 0; c < images.size(); ++c) {
      std::vector<ImageView> alone(images.size());
      alone[c] = images[c].view();
      Photograph of_one = photograph;
      of_one.name += ", camera " + std::to_string(c) + " alone";
      of_one.tolerance_arcsec *= 3;
      expect_right(of_one, solver.solve(alone));
    }
  }
}

// A mirror image of the sky is no sky: named, not solved.
TEST(Photographs, AMirroredPhotographIsNamedAsSuch) {
  const auto all = shared(PhotographGroup::kSingles);
  OMMA_NEEDS(all);
  for (const Photograph& photograph : all) {
    Image image = read_image(photograph.images[0]);
    ASSERT_EQ(image.format, PixelFormat::kGrey8);
    for (int row = 0; row < image.height; ++row) {
      const auto first = image.pixels.begin() + std::ptrdiff_t{row} * image.width;
      std::reverse(first, first + image.width);
    }
    const auto solution = ground::PhotographSolver(photograph.rig, {}).solve({image.view()});
    EXPECT_FALSE(solution.solved) << photograph.name;
    EXPECT_EQ(solution.reason, "mirrored image") << photograph.name;
  }
}

}  // namespace
}  // namespace omma
