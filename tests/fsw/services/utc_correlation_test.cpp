// UTC beside on-board time: from the epoch in a replay, from the machine's clocks in flight.
#include "fsw/services/utc_correlation.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace omma {
namespace {

TEST(UtcCorrelation, ReplayCountsFromTheEpoch) {
  UtcCorrelation utc(UtcCorrelation::Kind::kReplay, 1'774'008'000'000'000'000);
  utc.step({.number = 7, .time_ns = 700'000'000});
  EXPECT_TRUE(utc.report->valid);
  EXPECT_EQ(utc.report->source, UtcSource::kMissionEpoch);
  EXPECT_EQ(utc.report->time_ns, 700'000'000);
  EXPECT_EQ(utc.report->utc_ns, 1'774'008'000'700'000'000);
  EXPECT_EQ(utc.report->uncertainty_ns, 0);
}

TEST(UtcCorrelation, ReplayWithoutAnEpochKnowsNoUtc) {
  UtcCorrelation utc(UtcCorrelation::Kind::kReplay, std::nullopt);
  utc.step({.number = 7, .time_ns = 700'000'000});
  EXPECT_FALSE(utc.report->valid);
  EXPECT_EQ(utc.report->source, UtcSource::kNone);
}

TEST(UtcCorrelation, InFlightItIsTheMachinesClock) {
  using std::chrono::nanoseconds;
  const auto utc_now = [] {
    return std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
  const auto monotonic_now = [] {
    return std::chrono::duration_cast<nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
  UtcCorrelation utc(UtcCorrelation::Kind::kLive, 0);
  const std::int64_t utc_before = utc_now();
  const TimeNs before = monotonic_now();
  utc.step({});
  const TimeNs after = monotonic_now();
  EXPECT_GE(utc.report->time_ns, before);
  EXPECT_LE(utc.report->time_ns, after);
  EXPECT_GE(utc.report->utc_ns, utc_before);
  EXPECT_LE(utc.report->utc_ns, utc_now());
  // Until the system was asked how it keeps its clock, nothing bounds the error.
  EXPECT_EQ(utc.report->source, UtcSource::kSystemClock);
  EXPECT_EQ(utc.report->uncertainty_ns, UtcReport::kUnknown);
  utc.ask_system();
  utc.step({});
  const ClockDiscipline discipline = ask_discipline();
  EXPECT_EQ(utc.report->source,
            discipline.synchronised ? UtcSource::kDisciplinedClock : UtcSource::kSystemClock);
  if (discipline.synchronised) {
    EXPECT_GE(utc.report->uncertainty_ns, discipline.error_ns / 2);
  }
}

TEST(UtcClock, BothClocksAreReadAtOneInstant) {
  const ClockPair first = read_clock_pair();
  const ClockPair second = read_clock_pair();
  EXPECT_GE(first.window_ns, 0);
  EXPECT_GE(second.monotonic_ns, first.monotonic_ns);
}

}  // namespace
}  // namespace omma
