// Star identification on skies with known truth. The full tables are printed by `omma-bench identify`.
#include "components/tracker/star_identification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <random>

#include "tests/bench/sky_problem.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A rig, the sky for its pixels, and the identification built for both.
struct Sky {
  explicit Sky(Rig r, double resolution_deg = 0.25, const IdentificationParameters& parameters = {})
      : rig(std::move(r)),
        catalogue(std::make_unique<StarCatalogue>(Observer{},
                                                  StarCatalogueParameters{6.5F, resolution_deg * kDegree})),
        identification(std::make_unique<StarIdentification>(*catalogue, sky_coverage(rig), parameters)),
        answer(std::make_unique<Identification>()) {}

  struct Count {
    int right = 0;
    int wrong = 0;
  };
  Count solve(const SkyProblemOptions& options, int trials, unsigned seed) {
    std::mt19937_64 random(seed);
    Count count;
    for (int trial = 0; trial < trials; ++trial) {
      const SkyProblem problem = random_sky(rig, catalogue->stars(), options, random);
      identification->identify(problem.dots, *answer);
      const SkyVerdict verdict = judge(problem, *answer);
      count.right += verdict == SkyVerdict::kRight ? 1 : 0;
      count.wrong += verdict == SkyVerdict::kWrong ? 1 : 0;
    }
    return count;
  }

  Rig rig;
  std::unique_ptr<StarCatalogue> catalogue;
  std::unique_ptr<StarIdentification> identification;
  std::unique_ptr<Identification> answer;
};

TEST(StarIdentification, ThreeWideCamerasAreAlwaysSolved) {
  Sky s(equidistant_rig(3, 122));
  for (const double noise : {0.1, 0.5}) {
    const auto count = s.solve({.noise_px = noise}, 200, 1);
    EXPECT_EQ(count.right, 200) << noise << " px";
    EXPECT_EQ(count.wrong, 0);
  }
}

TEST(StarIdentification, TwoStarsInEachOfThreeCamerasAreEnough) {
  Sky s(equidistant_rig(3, 122));
  const auto count = s.solve({.noise_px = 0.1, .stars_per_camera = 2}, 200, 2);
  EXPECT_GE(count.right, 198);
  EXPECT_EQ(count.wrong, 0);
}

TEST(StarIdentification, OneCameraOfAnyFieldIsSolved) {
  Sky wide(equidistant_rig(1, 187), 0.4);
  EXPECT_EQ(wide.solve({.noise_px = 0.2}, 100, 3).right, 100);
  Sky middle(equidistant_rig(1, 60), 0.15);
  EXPECT_EQ(middle.solve({.noise_px = 0.2}, 100, 4).right, 100);
  Sky narrow(pinhole_rig(20), 0.04);
  EXPECT_EQ(narrow.solve({.magnitude_limit = 6.5F, .noise_px = 0.2}, 100, 5).right, 100);
  Sky narrowest(pinhole_rig(10), 0.02);
  const auto count = narrowest.solve({.magnitude_limit = 6.5F, .noise_px = 0.2}, 100, 6);
  EXPECT_GE(count.right, 99);
  EXPECT_EQ(count.wrong, 0);
}

// Their angles alone do not prove an attitude; brightness, and that no other star is to be seen, do.
TEST(StarIdentification, FourStarsInANarrowFieldAreEnough) {
  Sky s(pinhole_rig(10), 0.02);
  std::mt19937_64 random(16);
  int skies = 0, right = 0;
  for (int trial = 0; trial < 2500; ++trial) {
    const SkyProblem problem =
        random_sky(s.rig, s.catalogue->stars(), {.magnitude_limit = 6.5F, .noise_px = 0.2}, random);
    if (problem.dots.size() != 4) continue;
    ++skies;
    s.identification->identify(problem.dots, *s.answer);
    const SkyVerdict verdict = judge(problem, *s.answer);
    EXPECT_NE(verdict, SkyVerdict::kWrong);
    right += verdict == SkyVerdict::kRight ? 1 : 0;
  }
  ASSERT_GE(skies, 5);
  EXPECT_GE(10 * right, 8 * skies);
}

TEST(StarIdentification, FewStarsWhoseBrightnessMisleadsAreFoundByTheirAngles) {
  Sky s(equidistant_rig(3, 122));
  const SkyProblemOptions options{.noise_px = 0.1, .magnitude_scatter = 1.5, .stars_per_camera = 2};
  const auto count = s.solve(options, 300, 17);
  EXPECT_GE(count.right, 297);
  EXPECT_EQ(count.wrong, 0);
}

// A loose bound, so that there would be something to count.
TEST(StarIdentification, FewFalseDotsKeepTheBound) {
  constexpr double kBound = 0.05;
  constexpr int kTrials = 150;
  Sky s(pinhole_rig(10), 0.02, {.false_match_probability = kBound, .hypothesis_limit = 20000});
  std::mt19937_64 random(18);
  int answers = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SkyProblemOptions options{.magnitude_limit = 6.5F, .noise_px = 0.2, .false_dots = 4 + trial % 5};
    options.stars_per_camera = 1;
    SkyProblem problem = random_sky(s.rig, s.catalogue->stars(), options, random);
    std::erase_if(problem.dots, [&](const RigDot& dot) { return problem.hr[dot.index] != 0; });
    s.identification->identify(problem.dots, *s.answer);
    answers += s.answer->status == IdentificationStatus::kIdentified ? 1 : 0;
  }
  EXPECT_LE(answers, kBound * kTrials);
}

TEST(StarIdentification, HalfTheDotsMayBeFalse) {
  Sky s(equidistant_rig(3, 122));
  const auto count = s.solve({.noise_px = 0.2, .false_fraction = 0.5}, 100, 7);
  EXPECT_EQ(count.right, 100);
  EXPECT_EQ(count.wrong, 0);
}

TEST(StarIdentification, AidedNeedsFewerStarsAndBelievesNoOtherAttitude) {
  Sky s(pinhole_rig(10), 0.02);
  std::mt19937_64 random(3);
  int unaided = 0, aided = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const SkyProblem problem =
        random_sky(s.rig, s.catalogue->stars(), {.magnitude_limit = 5.5F, .noise_px = 0.2}, random);
    s.identification->identify(problem.dots, *s.answer);
    unaided += judge(problem, *s.answer) == SkyVerdict::kRight ? 1 : 0;
    const Eigen::Quaterniond near = rotation_exp({0.03, -0.02, 0.04}) * problem.truth;
    s.identification->identify_near(near, 5 * kDegree, problem.dots, *s.answer);
    aided += judge(problem, *s.answer) == SkyVerdict::kRight ? 1 : 0;
    EXPECT_NE(judge(problem, *s.answer), SkyVerdict::kWrong);
    const Eigen::Quaterniond elsewhere = rotation_exp({0.5, 0, 0}) * problem.truth;
    s.identification->identify_near(elsewhere, 5 * kDegree, problem.dots, *s.answer);
    EXPECT_NE(s.answer->status, IdentificationStatus::kIdentified);
  }
  EXPECT_GT(aided, unaided + 5);
}

TEST(StarIdentification, BrightnessMayMislead) {
  Sky s(equidistant_rig(1, 122));
  const auto count = s.solve({.noise_px = 0.2, .magnitude_scatter = 1.5, .missing_fraction = 0.2}, 100, 8);
  EXPECT_GE(count.right, 99);
  EXPECT_EQ(count.wrong, 0);
}

TEST(StarIdentification, FindsNothingWhereThereIsNoSky) {
  Sky s(equidistant_rig(3, 122));
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 60; ++trial) {
    SkyProblemOptions options{.noise_px = 0.3, .false_on_sphere = 5 * trial, .stars_per_camera = 1};
    SkyProblem problem = random_sky(s.rig, s.catalogue->stars(), options, random);
    std::erase_if(problem.dots, [&](const RigDot& dot) { return problem.hr[dot.index] != 0; });
    s.identification->identify(problem.dots, *s.answer);
    EXPECT_NE(s.answer->status, IdentificationStatus::kIdentified);
    EXPECT_NE(s.answer->status, IdentificationStatus::kMirrored);
    EXPECT_TRUE(s.answer->matches.empty());
  }
}

TEST(StarIdentification, SaysThatTheImageIsMirrored) {
  Sky s(equidistant_rig(1, 122));
  std::mt19937_64 random(10);
  for (int trial = 0; trial < 20; ++trial) {
    SkyProblem problem = random_sky(s.rig, s.catalogue->stars(), {.noise_px = 0.2}, random);
    for (RigDot& dot : problem.dots) dot.ray.y() *= -1;
    s.identification->identify(problem.dots, *s.answer);
    EXPECT_EQ(s.answer->status, IdentificationStatus::kMirrored);
    EXPECT_TRUE(s.answer->matches.empty());
  }
}

TEST(StarIdentification, SaysThatThereAreTooFewDots) {
  Sky s(equidistant_rig(1, 122));
  std::mt19937_64 random(11);
  const SkyProblem problem = random_sky(s.rig, s.catalogue->stars(), {.stars_per_camera = 3}, random);
  s.identification->identify(problem.dots, *s.answer);
  EXPECT_EQ(s.answer->status, IdentificationStatus::kTooFewDots);
  EXPECT_STREQ(reason(s.answer->status), "too few dots");
  s.identification->identify({}, *s.answer);
  EXPECT_EQ(s.answer->status, IdentificationStatus::kTooFewDots);
}

TEST(StarIdentification, WorkIsBounded) {
  Sky s(equidistant_rig(3, 122), 0.25, {.hypothesis_limit = 2000});
  std::mt19937_64 random(12);
  SkyProblem problem =
      random_sky(s.rig, s.catalogue->stars(), {.noise_px = 0.5, .false_on_sphere = 400}, random);
  std::erase_if(problem.dots, [&](const RigDot& dot) { return problem.hr[dot.index] != 0; });
  s.identification->identify(problem.dots, *s.answer);
  EXPECT_EQ(s.answer->status, IdentificationStatus::kSearchCut);
  EXPECT_LE(s.answer->hypotheses, 3000u);  // the mirrored search included
}

TEST(StarIdentification, GivesTheSameBitsEveryTime) {
  Sky s(equidistant_rig(3, 122));
  Sky other(equidistant_rig(3, 122));
  std::mt19937_64 random(13);
  const SkyProblem problem =
      random_sky(s.rig, s.catalogue->stars(), {.noise_px = 0.3, .false_fraction = 0.5}, random);
  s.identification->identify(problem.dots, *s.answer);
  const Eigen::Vector4d first = s.answer->rig_from_j2000.coeffs();
  const std::size_t matches = s.answer->matches.size();
  s.solve({}, 5, 14);  // other skies in between leave nothing behind
  s.identification->identify(problem.dots, *s.answer);
  other.identification->identify(problem.dots, *other.answer);
  for (const Identification* again : {s.answer.get(), other.answer.get()}) {
    EXPECT_EQ(again->rig_from_j2000.coeffs(), first);
    EXPECT_EQ(again->matches.size(), matches);
  }
}

TEST(StarIdentification, AttitudeIsAsGoodAsItsCovarianceSays) {
  Sky s(equidistant_rig(3, 122));
  std::mt19937_64 random(15);
  double nees = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const SkyProblem problem =
        random_sky(s.rig, s.catalogue->stars(), {.noise_px = 0.1, .stars_per_camera = 15}, random);
    s.identification->identify(problem.dots, *s.answer);
    ASSERT_EQ(s.answer->status, IdentificationStatus::kIdentified);
    const Eigen::Vector3d error = rotation_log(problem.truth * s.answer->rig_from_j2000.conjugate());
    nees += error.dot(s.answer->covariance.inverse() * error);
  }
  EXPECT_NEAR(nees / kTrials, 3.0, 0.6);
}

}  // namespace
}  // namespace omma
