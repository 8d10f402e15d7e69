// The time grid as arithmetic.
#include "fsw/kernel/grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace omma {
namespace {

constexpr TimeNs kLast = std::numeric_limits<TimeNs>::max();

TEST(Grid, FirstBeatFromIsTheSmallestThatIsNotBefore) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    const auto start = static_cast<TimeNs>(random() % 1'000'000'000);
    const auto base = static_cast<TimeNs>(1 + random() % 5'000'000);
    const auto divisor = static_cast<std::uint32_t>(1 + random() % 200);
    const auto offset = static_cast<std::uint32_t>(random() % divisor);
    const Grid grid(start, base, divisor, offset);
    const auto instant = static_cast<TimeNs>(random() % 100'000'000'000);
    const std::uint64_t beat = grid.first_beat_from(instant);
    ASSERT_GE(grid.due(beat), instant);
    if (beat > 0) {
      ASSERT_LT(grid.due(beat - 1), instant);
    }
    ASSERT_EQ(grid.due(beat) - start, static_cast<TimeNs>(grid.tick_number(beat)) * base);
  }
}

TEST(Grid, BeatsBeforeATickAreCountedOneByOne) {
  for (std::uint32_t divisor = 1; divisor < 8; ++divisor) {
    for (std::uint32_t offset = 0; offset < divisor; ++offset) {
      const Grid grid(0, 1, divisor, offset);
      std::uint64_t counted = 0;
      for (std::uint64_t tick = 0; tick < 50; ++tick) {
        ASSERT_EQ(grid.beats_before(tick), counted) << divisor << " " << offset << " " << tick;
        if (tick % divisor == offset) ++counted;
      }
    }
  }
}

TEST(Grid, KeepsItsPhaseWhenTheClockWraps) {
  constexpr TimeNs kPeriod = 1'000'000;
  const Grid grid(kLast - 10 * kPeriod - 7, kPeriod, 1, 0);
  for (std::uint64_t beat = 0; beat < 30; ++beat) {
    const TimeNs due = grid.due(beat);
    EXPECT_EQ(grid.first_beat_from(due), beat);
    const auto just_after = static_cast<TimeNs>(static_cast<std::uint64_t>(due) + 1);
    EXPECT_EQ(grid.first_beat_from(just_after), beat + 1);
  }
  EXPECT_LT(grid.due(20), 0) << "the test must pass the wrap";
}

}  // namespace
}  // namespace omma
