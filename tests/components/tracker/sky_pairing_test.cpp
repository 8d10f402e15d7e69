// Pairing with a predicted attitude: the right stars, none behind a body, no camera left out.
#include "components/tracker/sky_pairing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/bench/sky_problem.hpp"
#include "tests/components/tracker/seen_sky.hpp"

namespace omma {
namespace {

class PairsOfTheSky : public ::testing::Test {
 protected:
  /// Pairs stars to `magnitude_limit`, the attitude known to `sigma` [rad] about each axis.
  void pair(float magnitude_limit, double sigma, std::span<const HiddenCone> hidden = {}) {
    sky_ = std::make_unique<SeenSky>(rig_, *catalogue_, magnitude_limit, 0.1);
    sky_->see(truth_, *lists_);
    for (std::size_t c = 0; c < lists_->cameras.size(); ++c)
      for (std::size_t d = 0; d < lists_->cameras[c].dots.size(); ++d)
        if (sky_->hr(c, d) == brightened_) lists_->cameras[c].dots[d].flux *= brighter_;
    seen_->build(*lists_, rig_, 0.05);
    const PredictedAttitude prediction{(rotation_exp({sigma, -sigma, sigma}) * truth_).normalized(),
                                       sigma * sigma * Eigen::Matrix3d::Identity()};
    pairs_->clear();
    pairing_->pair(*seen_, rig_, catalogue_->stars(), prediction, magnitude_limit, {}, hidden, *pairs_);
  }
  int wrong() const {
    int count = 0;
    for (const Pairing& p : *pairs_) count += sky_->hr(p.camera, p.dot) == p.entry ? 0 : 1;
    return count;
  }
  std::size_t dots() const {
    std::size_t sum = 0;
    for (const DotList& list : lists_->cameras) sum += list.dots.size();
    return sum;
  }

  std::size_t pairs_of(int hr) const {
    return static_cast<std::size_t>(
        std::count_if(pairs_->begin(), pairs_->end(), [hr](const Pairing& p) { return p.entry == hr; }));
  }

  int brightened_ = -1;  // star by HR number whose dots are ...
  float brighter_ = 1;   // ... so many times brighter
  Rig rig_ = equidistant_rig(3, 122);
  std::unique_ptr<StarCatalogue> catalogue_ =
      std::make_unique<StarCatalogue>(Observer{}, StarCatalogueParameters{6.5F, 0.004});
  Eigen::Quaterniond truth_ = Eigen::Quaterniond(0.4, 0.3, -0.8, 0.2).normalized();
  std::unique_ptr<SeenSky> sky_;
  std::unique_ptr<DotLists> lists_ = std::make_unique<DotLists>();
  std::unique_ptr<SeenDots> seen_ = std::make_unique<SeenDots>();
  std::unique_ptr<SkyPairing> pairing_ = std::make_unique<SkyPairing>();
  std::unique_ptr<StaticVector<Pairing, limits::kStarPairs>> pairs_ =
      std::make_unique<StaticVector<Pairing, limits::kStarPairs>>();
};

TEST_F(PairsOfTheSky, AreRightAndNearlyAllWithAGoodPrediction) {
  pair(4.5F, 1e-4);
  EXPECT_EQ(wrong(), 0);
  EXPECT_GT(pairs_->size(), 98 * dots() / 100);
}

TEST_F(PairsOfTheSky, AreFewerButRightWithAPoorPrediction) {
  pair(4.5F, 5e-3);  // 2.4 px
  EXPECT_EQ(wrong(), 0);
  EXPECT_GT(pairs_->size(), dots() / 2);
}

TEST_F(PairsOfTheSky, AreNotMadeWithDotsMuchTooBrightForTheirStar) {
  pair(4.5F, 1e-4);
  const int star = (*pairs_)[pairs_->size() / 2].entry;
  const std::size_t all = pairs_->size();
  const std::size_t of_star = pairs_of(star);
  brightened_ = star;
  brighter_ = 3;  // red, or varying
  pair(4.5F, 1e-4);
  EXPECT_EQ(pairs_of(star), of_star);
  brighter_ = 10;  // something passes before it
  pair(4.5F, 1e-4);
  EXPECT_EQ(pairs_of(star), 0U);
  EXPECT_EQ(pairs_->size(), all - of_star);
}

TEST_F(PairsOfTheSky, ClaimTheirDots) {
  pair(4.5F, 1e-4);
  std::size_t claimed = 0;
  for (std::size_t c = 0; c < seen_->cameras(); ++c) {
    for (const std::uint8_t mark : seen_->claimed(c)) claimed += mark;
  }
  EXPECT_EQ(claimed, pairs_->size());
}

TEST_F(PairsOfTheSky, CarryTheDirectionsInWhichTheGroundSeesThem) {
  Observer observer;
  observer.julian_date_utc = parse_utc("2026-01-03T04:00:00Z");
  observer.site = GroundSite{0.63, -1.694, 290, {}, {}};
  const ApparentPlace here(observer);
  pairing_->look_from(&here);
  pair(4.5F, 1e-3);  // the dots are where the centre of the Earth sees them: refraction is some minutes
  ASSERT_GT(pairs_->size(), 20U);
  for (const Pairing& p : *pairs_) {
    EXPECT_GT(p.sight.point.dot(here.zenith()), std::sin(-1.1 * M_PI / 180))
        << p.entry;  // none below the horizon
    for (const SkyStar& star : catalogue_->stars()) {
      if (star.hr != p.entry) continue;
      Eigen::Vector3d seen = star.direction;
      ASSERT_TRUE(here.observe_from_centre(seen));
      EXPECT_LT((seen - p.sight.point).norm(), 1e-12);
    }
  }
}

TEST_F(PairsOfTheSky, AreNotLookedForBehindABody) {
  HiddenCone cone;
  cone.camera = 1;
  cone.axis = rig_.cameras[1].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  cone.cos_half_angle = std::cos(0.3);
  pair(4.5F, 1e-4);
  int before = 0;
  for (const Pairing& p : *pairs_)
    before += p.camera == 1 && cone.axis.dot(truth_ * p.sight.point) > cone.cos_half_angle;
  ASSERT_GT(before, 3);
  pair(4.5F, 1e-4, {&cone, 1});
  for (const Pairing& p : *pairs_) {
    if (p.camera != 1) continue;
    EXPECT_LT(cone.axis.dot(truth_ * p.sight.point), cone.cos_half_angle + 1e-3);
  }
}

TEST_F(PairsOfTheSky, LeaveNoCameraOutWhereThereIsNotRoomForAll) {
  pair(6.2F, 1e-4);
  ASSERT_EQ(pairs_->size(), limits::kStarPairs);
  std::array<int, 3> count{};
  for (const Pairing& p : *pairs_) ++count[p.camera];
  for (const int of_camera : count) EXPECT_NEAR(of_camera, double(limits::kStarPairs) / 3, 1);
}

}  // namespace
}  // namespace omma
