// Frames of a fired camera find their triggers by time: lost ones, late ones, strays and jitter.
#include "components/camera/trigger_matching.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace omma {
namespace {

constexpr TimeNs kPeriod = 100'000'000;
constexpr TimeNs kDelay = 12'000'000;

TimeNs edge(std::uint64_t number) {
  return 5'000'000'000 + static_cast<TimeNs>(number) * kPeriod;
}

TriggerMatching matching() {
  return TriggerMatching({.delay_ns = kDelay, .tolerance_ns = kPeriod / 4});
}

TEST(TriggerMatching, EveryFrameFindsItsTriggerThroughJitter) {
  TriggerMatching triggers = matching();
  std::mt19937 random(3);
  std::uniform_int_distribution<TimeNs> jitter(-kPeriod / 5, kPeriod / 5);
  for (std::uint64_t n = 0; n < 1000; ++n) {
    triggers.add_trigger(n, edge(n));
    const TimeNs off = jitter(random);
    const TriggerMatch match = triggers.match(edge(n) + kDelay + off);
    ASSERT_EQ(match.kind, MatchKind::kOnTime);
    ASSERT_EQ(match.number, n);
    ASSERT_EQ(match.offset_ns, off);
  }
  EXPECT_EQ(triggers.lost(), 0U);
}

TEST(TriggerMatching, ALostFrameIsCountedAndTheRestIsNotShifted) {
  TriggerMatching triggers = matching();
  for (std::uint64_t n = 0; n < 100; ++n) {
    triggers.add_trigger(n, edge(n));
    if (n == 40 || n == 41 || n == 70) continue;
    const TriggerMatch match = triggers.match(edge(n) + kDelay);
    EXPECT_EQ(match.number, n);
    EXPECT_EQ(match.lost, n == 42 ? 2U : n == 71 ? 1U : 0U);
  }
  EXPECT_EQ(triggers.lost(), 3U);
}

TEST(TriggerMatching, AFrameThatComesATriggerLaterIsLateAndNotLost) {
  TriggerMatching triggers = matching();
  for (std::uint64_t n = 0; n < 5; ++n) triggers.add_trigger(n, edge(n));
  const TriggerMatch match = triggers.match(edge(3) + kDelay);
  EXPECT_EQ(match.kind, MatchKind::kLate);
  EXPECT_EQ(match.number, 3U);
  EXPECT_EQ(triggers.match(edge(4) + kDelay).kind, MatchKind::kOnTime);
  EXPECT_EQ(triggers.lost(), 3U);  // 0, 1 and 2
}

TEST(TriggerMatching, AFrameThatWasOvertakenIsTakenOffTheLost) {
  TriggerMatching triggers = matching();
  for (std::uint64_t n = 0; n < 3; ++n) triggers.add_trigger(n, edge(n));
  EXPECT_EQ(triggers.match(edge(0) + kDelay).number, 0U);
  EXPECT_EQ(triggers.match(edge(2) + kDelay).lost, 1U);
  EXPECT_EQ(triggers.match(edge(1) + kDelay).kind, MatchKind::kLate);
  EXPECT_EQ(triggers.lost(), 0U);
}

TEST(TriggerMatching, AFrameOfNoTriggerIsStrayAndOneTwiceIsRepeated) {
  TriggerMatching triggers = matching();
  EXPECT_EQ(triggers.match(edge(0)).kind, MatchKind::kStray);  // before any trigger
  triggers.add_trigger(0, edge(0));
  triggers.add_trigger(1, edge(1));
  const TriggerMatch between = triggers.match(edge(0) + kDelay + kPeriod / 2);
  EXPECT_EQ(between.kind, MatchKind::kStray);
  EXPECT_EQ(between.offset_ns, kPeriod / 2);
  EXPECT_EQ(triggers.match(edge(1) + kDelay).kind, MatchKind::kOnTime);
  EXPECT_EQ(triggers.match(edge(1) + kDelay + 1000).kind, MatchKind::kRepeated);
  EXPECT_EQ(triggers.lost(), 1U);
}

TEST(TriggerMatching, AFrameOlderThanWhatIsRememberedIsStray) {
  TriggerMatching triggers = matching();
  for (std::uint64_t n = 0; n < 2 * TriggerMatching::kRemembered; ++n) triggers.add_trigger(n, edge(n));
  EXPECT_EQ(triggers.match(edge(5) + kDelay).kind, MatchKind::kStray);
  EXPECT_EQ(triggers.match(edge(TriggerMatching::kRemembered) + kDelay).kind, MatchKind::kLate);
}

TEST(TriggerMatching, WithoutADelayTheFirstFrameSaysIt) {
  TriggerMatching triggers({.delay_ns = TriggerMatchOptions::kLearn, .tolerance_ns = kPeriod / 4});
  triggers.add_trigger(7, edge(7));
  EXPECT_EQ(triggers.match(edge(7) - 1).kind, MatchKind::kStray);  // before its trigger
  EXPECT_EQ(triggers.match(edge(7) + 30'000'000).number, 7U);
  triggers.add_trigger(8, edge(8));
  const TriggerMatch match = triggers.match(edge(8) + 31'000'000);
  EXPECT_EQ(match.number, 8U);
  EXPECT_EQ(match.offset_ns, 1'000'000);
}

}  // namespace
}  // namespace omma
