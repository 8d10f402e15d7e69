// One range mode gives way to the next on better terms than it is left, and never for a single frame set.
#include "components/approach/range_mode.hpp"

#include <gtest/gtest.h>

namespace omma {
namespace {

RangeMode after(RangeModes& modes, const RangeEvidence& evidence, int frame_sets) {
  for (int i = 0; i < frame_sets; ++i) modes.step(evidence);
  return modes.mode();
}

constexpr RangeEvidence kFaint{.followed = true, .range_sigma = 0.4, .snr = 6};
constexpr RangeEvidence kBright{.followed = true, .range_sigma = 0.15, .snr = 12};
constexpr RangeEvidence kBetween{.followed = true, .range_sigma = 0.25, .snr = 8};
constexpr RangeEvidence kFiducials{.followed = true, .range_sigma = 0.01, .snr = 40, .pose = true};

TEST(RangeModes, GoFromFarOverIntermediateToCloseAndBack) {
  RangeModes modes({});
  EXPECT_EQ(after(modes, {}, 5), RangeMode::kNone);
  EXPECT_EQ(after(modes, kFaint, 10), RangeMode::kFar);
  EXPECT_EQ(after(modes, kBright, 2), RangeMode::kFar);
  EXPECT_EQ(after(modes, kBright, 1), RangeMode::kIntermediate);
  EXPECT_EQ(after(modes, kFiducials, 2), RangeMode::kIntermediate);
  EXPECT_EQ(after(modes, kFiducials, 1), RangeMode::kClose);
  EXPECT_EQ(after(modes, kBright, 4), RangeMode::kClose);
  EXPECT_EQ(after(modes, kBright, 1), RangeMode::kIntermediate);
  EXPECT_EQ(after(modes, kFaint, 5), RangeMode::kFar);
  EXPECT_EQ(after(modes, {}, 1), RangeMode::kNone);
}

TEST(RangeModes, StayWhereTheyAreBetweenTheTwoThresholds) {
  RangeModes far({});
  after(far, kFaint, 3);
  EXPECT_EQ(after(far, kBetween, 100), RangeMode::kFar);
  RangeModes intermediate({});
  after(intermediate, kBright, 5);
  EXPECT_EQ(after(intermediate, kBetween, 100), RangeMode::kIntermediate);
}

TEST(RangeModes, DoNotFlutterWithALightThatComesAndGoes) {
  RangeModes modes({});
  after(modes, kBright, 5);
  int changes = 0;
  for (int i = 0; i < 100; ++i) {
    const RangeMode before = modes.mode();
    changes += modes.step(i % 3 == 0 ? kFaint : kBright) != before ? 1 : 0;
  }
  EXPECT_EQ(changes, 0);
}

}  // namespace
}  // namespace omma
