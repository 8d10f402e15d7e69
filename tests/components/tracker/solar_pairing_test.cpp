// Planets, Moon and Sun among the stars: named, and never taken for a star, nor a star for them.
#include "components/tracker/solar_pairing.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "components/tracker/sky_pairing.hpp"
#include "tests/bench/sky_problem.hpp"
#include "tests/components/tracker/seen_sky.hpp"

namespace omma {
namespace {

Observer epoch() {
  Observer observer;
  observer.julian_date_utc = parse_utc("2026-04-02T02:00:00Z");  // full Moon; Jupiter in Gemini
  return observer;
}

class PlanetsAmongStars : public ::testing::Test {
 protected:
  PlanetsAmongStars() { sky_.see(truth_, *lists_); }

  const SolarBodyPlace& place(SolarBody body) const { return places_[static_cast<std::size_t>(body)]; }
  /// A dot where the direction is seen, in every camera that sees it, the brightest of its image.
  int add(const Eigen::Vector3d& direction, std::uint8_t flags = 0) {
    int seen = 0;
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      const RigCamera& camera = rig_.cameras[c];
      Dot dot;
      if (!camera.lens.project(camera.rig_from_camera.rotation.conjugate() * (truth_ * direction), dot.pixel))
        continue;
      dot.covariance = 0.01 * Eigen::Matrix2d::Identity();
      dot.flux = 1e6F;
      dot.flags = flags;
      DotList& list = lists_->cameras[c];
      list.dots.push_back(dot);
      std::rotate(list.dots.begin(), list.dots.end() - 1, list.dots.end());
      ++added_[c];
      ++seen;
    }
    return seen;
  }
  void pair() {
    seen_->build(*lists_, rig_, 0.05);
    pairing_->look_for(places_);
    pairing_->pair(*seen_, rig_, catalogue_->stars(), {truth_, 1e-8 * Eigen::Matrix3d::Identity()}, 4.5F, {},
                   {}, *pairs_);
  }
  /// Pairs with a star of a dot that is none, or of another one.
  int wrong_stars() const {
    int count = 0;
    for (const Pairing& p : *pairs_) {
      const bool is_star = p.dot >= added_[p.camera];
      count += is_star && sky_.hr(p.camera, p.dot - added_[p.camera]) == p.entry ? 0 : 1;
    }
    return count;
  }

  Rig rig_ = equidistant_rig(3, 122);
  std::unique_ptr<StarCatalogue> catalogue_ =
      std::make_unique<StarCatalogue>(epoch(), StarCatalogueParameters{6.5F, 0.004});
  SolarSystem places_ = solar_system(epoch(), kUnknownOrbit);
  // The first camera looks between Jupiter and the Moon.
  Eigen::Quaterniond truth_ = Eigen::Quaterniond::FromTwoVectors(
      place(SolarBody::kJupiter).direction + place(SolarBody::kMoon).direction,
      rig_.cameras[0].rig_from_camera.rotation* Eigen::Vector3d::UnitZ());
  SeenSky sky_{rig_, *catalogue_, 4.5F, 0.1};
  std::unique_ptr<DotLists> lists_ = std::make_unique<DotLists>();
  std::unique_ptr<SeenDots> seen_ = std::make_unique<SeenDots>();
  std::unique_ptr<SkyPairing> pairing_ = std::make_unique<SkyPairing>();
  std::unique_ptr<StaticVector<Pairing, limits::kStarPairs>> pairs_ =
      std::make_unique<StaticVector<Pairing, limits::kStarPairs>>();
  std::array<std::size_t, limits::kCameras> added_{};
};

TEST_F(PlanetsAmongStars, AreNamedInEveryCamera) {
  const int jupiters = add(place(SolarBody::kJupiter).direction);
  ASSERT_GE(jupiters, 1);
  pair();
  ASSERT_EQ(pairing_->solar_pairs().size(), static_cast<std::size_t>(jupiters));
  for (const Pairing& p : pairing_->solar_pairs()) {
    EXPECT_EQ(p.entry, static_cast<std::uint16_t>(SolarBody::kJupiter));
    EXPECT_EQ(seen_->claimed(p.camera)[p.dot], 1);
  }
  EXPECT_EQ(wrong_stars(), 0);
  EXPECT_GT(pairs_->size(), 100U);
}

// The star's own dot lies under the planet's light: one dot is seen, and it is not the star's.
TEST_F(PlanetsAmongStars, APlanetOverAStarIsNotTakenForTheStar) {
  const SkyStar* star = nullptr;
  for (const SkyStar& s : catalogue_->stars()) {
    if (s.magnitude < 3.5F && s.direction.dot(place(SolarBody::kJupiter).direction) > 0.97 && star == nullptr)
      star = &s;
  }
  ASSERT_NE(star, nullptr);
  SolarBodyPlace& jupiter = places_[static_cast<std::size_t>(SolarBody::kJupiter)];
  jupiter.direction = (star->direction + 0.0004 * tangent_basis(star->direction).col(0)).normalized();
  for (DotList& list : lists_->cameras) {
    for (std::size_t d = 0; d < list.dots.size(); ++d) {
      const std::size_t c = static_cast<std::size_t>(&list - lists_->cameras.data());
      if (sky_.hr(c, d) == star->hr) list.dots[d].flux = 1e6F;  // the two blend
    }
  }
  pair();
  for (const Pairing& p : *pairs_) EXPECT_NE(p.entry, star->hr);
}

TEST_F(PlanetsAmongStars, TheMoonIsFoundThoughItsParallaxIsNotKnown) {
  const Eigen::Vector3d moon = place(SolarBody::kMoon).direction;
  const Eigen::Vector3d seen = (moon + 0.012 * tangent_basis(moon).col(0)).normalized();  // 0.7 degrees off
  const int moons = add(seen, kDotSaturated);
  ASSERT_GE(moons, 1);
  pair();
  ASSERT_EQ(pairing_->solar_pairs().size(), static_cast<std::size_t>(moons));
  EXPECT_EQ(pairing_->solar_pairs()[0].entry, static_cast<std::uint16_t>(SolarBody::kMoon));
  EXPECT_EQ(wrong_stars(), 0);
}

TEST_F(PlanetsAmongStars, AStarIsNotTakenForTheMoonThatIsHidden) {
  const Eigen::Vector3d moon = place(SolarBody::kMoon).direction;
  add((moon + 0.005 * tangent_basis(moon).col(1)).normalized());  // bright, and not saturated
  pair();
  EXPECT_EQ(pairing_->solar_pairs().size(), 0U);
}

TEST_F(PlanetsAmongStars, NothingIsNamedWithoutAnEpoch) {
  add(place(SolarBody::kJupiter).direction);
  seen_->build(*lists_, rig_, 0.05);
  pairing_->pair(*seen_, rig_, catalogue_->stars(), {truth_, 1e-8 * Eigen::Matrix3d::Identity()}, 4.5F, {},
                 {}, *pairs_);
  EXPECT_EQ(pairing_->solar_pairs().size(), 0U);
  EXPECT_EQ(wrong_stars(), 0);
}

}  // namespace
}  // namespace omma
