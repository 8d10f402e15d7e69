// Of several lights followed at once the one that comes nearer is the likeliest, else the brightest; their
// number is bounded, and what stands with the rig or is seen now and then is none of them.
#include "components/approach/light_candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace omma {
namespace {

constexpr TimeNs kInterval = 250'000'000;

UnknownObject object(std::uint32_t number, float flux, ObjectMotion motion = ObjectMotion::kMoving) {
  UnknownObject one;
  one.number = number;
  one.motion = motion;
  one.sightings = 20;
  one.bearing.seen = true;
  one.bearing.flux = flux;
  one.bearing.snr = 20;
  return one;
}

class Candidates : public ::testing::Test {
 protected:
  // Each frame set shows these objects; `growing` comes from 50 m at 1 m/s.
  void show(int frame_sets, std::initializer_list<UnknownObject> objects, std::uint32_t growing = 0) {
    for (int i = 0; i < frame_sets; ++i, ++frame_) {
      candidates_.begin(frame_ * kInterval);
      for (UnknownObject one : objects) {
        one.first_seen_ns = 0;
        one.sightings = static_cast<std::uint32_t>(frame_ + 20);
        const double range = one.number == growing ? 50 - 0.25 * static_cast<double>(frame_) : 50;
        candidates_.show(one, {-2 * std::log(range) + (frame_ % 2 == 0 ? 0.1 : -0.1), 0.1},
                         one.number == followed_);
      }
      candidates_.end();
    }
  }
  std::uint32_t best() {
    const LightCandidate* one = candidates_.best([](const LightCandidate&) { return true; });
    return one != nullptr ? one->number : 0;
  }
  TimeNs frame_ = 1;
  std::uint32_t followed_ = 0;
  LightCandidates candidates_{3};
};

TEST_F(Candidates, TheBrightestIsTheLikeliestUntilOneComesNearer) {
  show(4, {object(1, 50), object(2, 90), object(3, 70)}, 1);
  EXPECT_EQ(best(), 2U);
  show(56, {object(1, 50), object(2, 90), object(3, 70)}, 1);
  EXPECT_EQ(best(), 1U);
  EXPECT_TRUE(LightCandidates::outgrows(*candidates_.find(1), *candidates_.find(2)));
  EXPECT_FALSE(LightCandidates::outgrows(*candidates_.find(2), *candidates_.find(1)));
  EXPECT_FALSE(LightCandidates::outgrows(*candidates_.find(3), *candidates_.find(2)));
}

TEST_F(Candidates, AreBoundedAndTheFaintestSteadyOneGivesWay) {
  show(60, {object(1, 20), object(2, 90), object(3, 70)}, 1);
  show(1, {object(1, 20), object(2, 90), object(3, 70), object(4, 75)}, 1);
  EXPECT_EQ(candidates_.find(4), nullptr);  // hardly brighter than the faintest
  show(1, {object(1, 20), object(2, 90), object(3, 70), object(5, 500)}, 1);
  EXPECT_EQ(candidates_.size(), 3U);
  EXPECT_NE(candidates_.find(5), nullptr);
  EXPECT_EQ(candidates_.find(3), nullptr);
  EXPECT_NE(candidates_.find(1), nullptr);  // the faintest of all, but it comes nearer
}

TEST_F(Candidates, ABodysLightStaysAndTakesNoPlace) {
  followed_ = 1;
  show(2, {object(1, 20), object(2, 90), object(3, 70), object(4, 60)});
  EXPECT_EQ(candidates_.size(), 4U);
  show(1, {object(5, 900), object(6, 900), object(7, 900), object(8, 900)});
  EXPECT_NE(candidates_.find(1), nullptr);
}

TEST_F(Candidates, WhatTurnsOutToStandWithTheRigIsDropped) {
  show(2, {object(1, 50), object(2, 90)});
  EXPECT_EQ(best(), 2U);
  show(1, {object(1, 50), object(2, 90, ObjectMotion::kWithTheRig)});
  EXPECT_EQ(best(), 1U);
  EXPECT_EQ(candidates_.find(2), nullptr);
}

TEST_F(Candidates, ABrightLightSeenNowAndThenIsNotChosen) {
  UnknownObject hidden = object(2, 90);
  hidden.bearing.seen = false;
  for (int i = 0; i < 30; ++i) {
    show(1, {object(1, 50), object(2, 90)});
    show(1, {object(1, 50), hidden});
  }
  show(1, {object(1, 50), object(2, 90)});
  EXPECT_EQ(best(), 1U);
}

TEST_F(Candidates, NotSeenForLongAreLetGo) {
  show(2, {object(1, 50)});
  show(41, {});
  EXPECT_EQ(candidates_.size(), 0U);
}

}  // namespace
}  // namespace omma
