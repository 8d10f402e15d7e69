// The compiled-in catalogue against facts known from elsewhere, and against the published file where it is at
// hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>

#include "components/catalogue/star.hpp"
#include "components/catalogue/star_names.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const CatalogueStar* star(std::uint16_t hr) {
  for (const CatalogueStar& s : bright_star_catalogue()) {
    if (s.hr == hr) return &s;
  }
  return nullptr;
}

TEST(BrightStars, CountsAreThoseOfThePublishedCatalogue) {
  const auto stars = bright_star_catalogue();
  ASSERT_EQ(stars.size(), 9096u);
  const auto brighter = [&](float limit) {
    return std::count_if(stars.begin(), stars.end(),
                         [&](const CatalogueStar& s) { return s.magnitude < limit; });
  };
  EXPECT_EQ(brighter(2.0F), 48);
  EXPECT_EQ(brighter(4.0F), 513);
  EXPECT_EQ(brighter(5.0F), 1604);
  EXPECT_EQ(brighter(6.0F), 5023);
}

TEST(BrightStars, AreSortedBrightestFirst) {
  const auto stars = bright_star_catalogue();
  EXPECT_TRUE(std::is_sorted(stars.begin(), stars.end(), [](const CatalogueStar& a, const CatalogueStar& b) {
    return a.magnitude < b.magnitude;
  }));
  EXPECT_EQ(stars[0].hr, 2491);  // Sirius
}

TEST(BrightStars, TableMatchesTheChecksumItsGeneratorWrote) {
  EXPECT_TRUE(bright_star_catalogue_intact());
}

TEST(BrightStars, ArcturusStandsWhereHipparcosSawIt) {
  const CatalogueStar* arcturus = star(5340);
  ASSERT_NE(arcturus, nullptr);
  EXPECT_NEAR(arcturus->right_ascension / kDegree, 213.915300, 1.0 / 3600);
  EXPECT_NEAR(arcturus->declination / kDegree, 19.182409, 1.0 / 3600);
  EXPECT_NEAR(arcturus->pm_ra_cosdec / kDegree * 3600, -1.093, 1e-6);
  EXPECT_NEAR(arcturus->pm_dec / kDegree * 3600, -1.998, 1e-6);
}

TEST(BrightStars, EveryEntryIsThePublishedOne) {
  std::ifstream file(OMMA_SHARED_DATA "/data/catalogue/bsc5_v7.csv");
  if (!file) GTEST_SKIP() << "the published catalogue is not at hand";
  std::string line;
  int compared = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    double value[6];
    const char* at = line.c_str();
    for (double& v : value) {
      char* end = nullptr;
      v = std::strtod(at, &end);
      at = end + 1;
    }
    const CatalogueStar* s = star(static_cast<std::uint16_t>(value[0]));
    ASSERT_NE(s, nullptr) << line;
    EXPECT_NEAR(s->right_ascension / kDegree, value[1], 1e-6) << line;
    EXPECT_NEAR(s->declination / kDegree, value[2], 1e-6) << line;
    EXPECT_NEAR(s->magnitude, value[3], 0.006) << line;
    EXPECT_NEAR(s->pm_ra_cosdec / kDegree * 3600, value[4], 1e-5) << line;
    EXPECT_NEAR(s->pm_dec / kDegree * 3600, value[5], 1e-5) << line;
    ++compared;
  }
  EXPECT_EQ(compared, 9096);
}

TEST(StarNames, ProperNameFirstThenBayerThenFlamsteedThenNumber) {
  EXPECT_EQ(star_label(2491).view(), "Sirius");
  EXPECT_EQ(star_label(5459).view(), "Rigil Kentaurus");
  EXPECT_EQ(star_designation(5459).view(), "Alp1 Cen");
  EXPECT_EQ(star_label(681).view(), "Mira");
  EXPECT_EQ(star_label(3).view(), "33 Psc");
  EXPECT_EQ(star_label(1).view(), "HR 1");
  EXPECT_EQ(star_label(65535).view(), "HR 65535");
  EXPECT_TRUE(proper_name(1).empty());
}

}  // namespace
}  // namespace omma
