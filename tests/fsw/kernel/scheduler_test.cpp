// The scheduler on a clock that the test stalls: which beats are served, which are missed, what is reported.
#include "fsw/kernel/scheduler.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <thread>

#include "fsw/kernel/processor_stay.hpp"
#include "fsw/kernel/thread_cpu_time.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using testing::FakeClock;
using testing::Scripted;
using testing::Sink;
using testing::Source;

/// Writes down all it is told.
struct Witness final : ScheduleObserver {
  struct Slip {
    Tick first;
    std::uint64_t count;
  };
  struct Breach {
    SchedulePlace place;
    Tick tick;
    TimeNs wall_ns;
  };
  void missed(std::uint16_t, const Tick& first, std::uint64_t count) noexcept override {
    slips.push_back({first, count});
  }
  void over_budget(SchedulePlace place, const Tick& tick, const StepTime& time, TimeNs) noexcept override {
    breaches.push_back({place, tick, time.wall_ns});
  }
  std::vector<Slip> slips;
  std::vector<Breach> breaches;
};

RateGroupTable one_group(Component& component, std::uint32_t divisor = 1, std::uint32_t offset = 0) {
  return {
      .base_period = 1ms,
      .groups = {{.name = "only", .divisor = divisor, .offset = offset, .components = {{component, 0ns}}}}};
}

TEST(Scheduler, WakesOnTheOriginalGridAfterAStall) {
  FakeClock clock(5'000);
  std::vector<std::pair<Tick, TimeNs>> served;
  Scripted component("component", [&](const Tick& tick) {
    served.emplace_back(tick, clock.now());
    if (tick.number == 3) clock.spend(2'500'000);
  });
  Witness witness;
  Scheduler scheduler(one_group(component), clock, witness);
  scheduler.run(10);

  std::vector<std::uint64_t> numbers;
  for (const auto& [tick, began] : served) {
    numbers.push_back(tick.number);
    EXPECT_EQ(began, tick.time_ns);
    EXPECT_EQ((tick.time_ns - served[0].first.time_ns) % 1'000'000, 0);
  }
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{0, 1, 2, 3, 6, 7, 8, 9}));
  ASSERT_EQ(witness.slips.size(), 1U);
  EXPECT_EQ(witness.slips[0].first.number, 4U);
  EXPECT_EQ(witness.slips[0].count, 2U);
  EXPECT_EQ(scheduler.group(0).timing().missed.load(), 2U);
}

TEST(Scheduler, AStepThatEndsExactlyOnTheNextBeatMissesNothing) {
  FakeClock clock;
  int steps = 0;
  Scripted component("component", [&](const Tick&) {
    clock.spend(1'000'000);
    ++steps;
  });
  Witness witness;
  Scheduler scheduler(one_group(component), clock, witness);
  scheduler.run(20);
  EXPECT_EQ(steps, 20);
  EXPECT_TRUE(witness.slips.empty());
}

// Whatever the stalls, before or in a step: every beat is served once or missed once, in order; a served
// beat begins before the next is due; each beat missed was impossible.
TEST(Scheduler, ServedAndMissedBeatsPartitionTheGridUnderRandomStalls) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const auto divisor = static_cast<std::uint32_t>(1 + random() % 5);
    const auto offset = static_cast<std::uint32_t>(random() % divisor);
    // Half of the trials pass the wrap of the clock.
    const TimeNs start = trial % 2 == 0 ? 0 : std::numeric_limits<TimeNs>::max() - 50'000'000;
    FakeClock clock(start);
    const auto stall = [&]() -> TimeNs {
      if (random() % 4 != 0) return static_cast<TimeNs>(random() % 1000);
      return static_cast<TimeNs>(random() % 12'000'000);
    };
    clock.wake_late = stall;
    std::vector<std::uint64_t> served;
    Scripted component("component", [&](const Tick& tick) {
      served.push_back(tick.number);
      const TimeNs late = elapsed(tick.time_ns, clock.now());
      EXPECT_GE(late, 0);
      EXPECT_LT(late, 1'000'000 * static_cast<TimeNs>(divisor));
      clock.spend(stall());
    });
    Witness witness;
    Scheduler scheduler(one_group(component, divisor, offset), clock, witness);
    constexpr std::uint64_t kTicks = 300;
    scheduler.run(kTicks);

    std::vector<int> fate(kTicks, 0);
    for (const std::uint64_t number : served) ++fate[number];
    std::uint64_t missed = 0;
    for (const Witness::Slip& slip : witness.slips) {
      for (std::uint64_t i = 0; i < slip.count; ++i) ++fate[slip.first.number + i * divisor];
      missed += slip.count;
    }
    for (std::uint64_t tick = 0; tick < kTicks; ++tick)
      ASSERT_EQ(fate[tick], tick % divisor == offset ? 1 : 0) << "trial " << trial << " tick " << tick;
    EXPECT_TRUE(std::is_sorted(served.begin(), served.end()));
    EXPECT_EQ(scheduler.group(0).timing().missed.load(), missed);
    EXPECT_EQ(scheduler.group(0).timing().latency.snapshot().count, served.size());
    EXPECT_GT(missed, 0U) << "the stalls must be long enough to matter";
  }
}

TEST(Scheduler, ReportsAStepOverItsBudgetAndNoOther) {
  FakeClock clock;
  Scripted quick("quick", [&](const Tick&) { clock.spend(10'000); });
  Scripted slow("slow", [&](const Tick& tick) { clock.spend(tick.number == 5 ? 300'001 : 300'000); });
  Witness witness;
  Scheduler scheduler(
      {.base_period = 1ms, .groups = {{.name = "only", .components = {{quick, 300us}, {slow, 300us}}}}},
      clock, witness);
  scheduler.run(10);
  ASSERT_EQ(witness.breaches.size(), 1U);
  EXPECT_EQ(witness.breaches[0].place.position, 1);
  EXPECT_EQ(witness.breaches[0].place.component, 1);
  EXPECT_EQ(witness.breaches[0].tick.number, 5U);
  EXPECT_EQ(witness.breaches[0].wall_ns, 300'001);
  EXPECT_EQ(scheduler.group(0).component_timing(1).over_budget.load(), 1U);
  const DurationSnapshot wall = scheduler.group(0).component_timing(1).wall.snapshot();
  EXPECT_EQ(wall.count, 10U);
  EXPECT_EQ(wall.max_ns, 300'001);
  EXPECT_EQ(wall.last_ns, 300'000);
}

TEST(Scheduler, LockstepRunsGroupsByPriorityOnEachBaseTickAndStampsThem) {
  LockstepClock clock(1'000);
  std::vector<std::string> log;
  const auto note = [&](const char* name) {
    return [&log, &clock, name](const Tick& tick) {
      log.push_back(name + std::to_string(tick.number));
      EXPECT_EQ(tick.time_ns, 1'000 + static_cast<TimeNs>(tick.number) * 5'000'000);
      EXPECT_EQ(clock.now(), tick.time_ns);
    };
  };
  Scripted vision("v", note("v"));
  Scripted motion("m", note("m"));
  Scripted house("h", note("h"));
  Scheduler scheduler(
      {.base_period = 5ms,
       .groups = {{.name = "housekeeping", .divisor = 4, .offset = 1, .components = {{house}}},
                  {.name = "vision", .divisor = 2, .priority = 10, .components = {{vision}}},
                  {.name = "motion", .divisor = 1, .priority = 20, .components = {{motion}}}}},
      clock);
  scheduler.run(6);
  EXPECT_EQ(log,
            (std::vector<std::string>{"m0", "v0", "m1", "h1", "m2", "v2", "m3", "m4", "v4", "m5", "h5"}));
}

TEST(Scheduler, AComponentCanStopALockstepRun) {
  LockstepClock clock;
  Scheduler* running = nullptr;
  int steps = 0;
  Scripted component("component", [&](const Tick& tick) {
    ++steps;
    if (tick.number == 7) running->stop();
  });
  Scheduler scheduler(one_group(component), clock);
  running = &scheduler;
  scheduler.run();
  EXPECT_EQ(steps, 8);
}

TEST(Scheduler, CarriesValuesAcrossRateGroupsInLockstep) {
  LockstepClock clock;
  Source source;
  Sink sink;
  Latest<testing::Number> number_for_sink(source.number);
  sink.number.bind(number_for_sink);
  Scheduler scheduler({.base_period = 1ms,
                       .groups = {{.name = "slow", .divisor = 2, .priority = 1, .components = {{source}}},
                                  {.name = "fast", .divisor = 1, .priority = 2, .components = {{sink}}}}},
                      clock);
  scheduler.run(7);
  // The fast group runs first on a shared tick: it sees what was complete when its beat began.
  EXPECT_EQ(sink.seen, (std::vector<int>{0, 1, 1, 2, 2, 3, 3}));
}

TEST(Scheduler, RunsAThreadPerGroupOnTheMonotonicClockAndStops) {
  MonotonicClock clock;
  std::thread::id fast_thread;
  std::thread::id slow_thread;
  std::atomic<int> beats{0};
  Scheduler* running = nullptr;
  Scripted fast("fast", [&](const Tick& tick) {
    fast_thread = std::this_thread::get_id();
    EXPECT_GE(clock.now(), tick.time_ns);
    if (beats.fetch_add(1) == 20) running->stop();
  });
  Scripted slow("slow", [&](const Tick&) { slow_thread = std::this_thread::get_id(); });
  Scheduler scheduler({.base_period = 1ms,
                       .groups = {{.name = "fast", .components = {{fast}}},
                                  {.name = "slow", .divisor = 5, .components = {{slow}}}}},
                      clock);
  running = &scheduler;
  scheduler.run();
  EXPECT_GE(beats.load(), 21);
  EXPECT_NE(fast_thread, slow_thread);
  EXPECT_NE(fast_thread, std::this_thread::get_id());
  EXPECT_GT(scheduler.group(1).timing().latency.snapshot().count, 0U);
}

TEST(Scheduler, SaysSoWhenItMayNotRunInRealTime) {
  MonotonicClock clock;
  Scripted component("component");
  Scheduler scheduler(
      {.base_period = 1ms, .groups = {{.name = "g", .core = 1000, .components = {{component}}}}}, clock);
  scheduler.run(3);
  ASSERT_EQ(scheduler.refusals().size(), 1U);
  EXPECT_EQ(scheduler.refusals()[0], "rate group 'g' is not tied to core 1000: Invalid argument.");
  EXPECT_EQ(scheduler.group(0).timing().latency.snapshot().count + scheduler.group(0).timing().missed.load(),
            3U);
}

TEST(Scheduler, TellsAStepThatWaitedFromOneThatWorked) {
  LockstepClock clock;
  Scripted waiting("waiting", [](const Tick&) { std::this_thread::sleep_for(2ms); });
  Scripted working("working", [](const Tick&) {
    const TimeNs end = thread_cpu_time() + 500'000;
    while (thread_cpu_time() < end) {
    }
  });
  Scheduler scheduler({.base_period = 1ms, .groups = {{.name = "g", .components = {{waiting}, {working}}}}},
                      clock);
  scheduler.run(50);
  const ComponentTiming& waited = scheduler.group(0).component_timing(0);
  const ComponentTiming& worked = scheduler.group(0).component_timing(1);
  EXPECT_EQ(waited.left_processor.load(), 50U);
  EXPECT_GE(waited.wall.snapshot().mean_ns(), 2e6);
  EXPECT_LT(waited.cpu.snapshot().total_ns, waited.wall.snapshot().total_ns);
  // The two clocks are not read at one instant; where the machine is busy that is a little either way.
  const auto worked_wall_ns = static_cast<double>(worked.wall.snapshot().total_ns);
  EXPECT_LE(static_cast<double>(worked.cpu.snapshot().total_ns), 1.05 * worked_wall_ns);
  EXPECT_GE(worked.cpu.snapshot().mean_ns(), 0.95 * 5e5);
}

TEST(ProcessorStay, IsBrokenBySleepingAndNotByEveryShortStretch) {
  ProcessorStay stay;
  if (!stay.available()) GTEST_SKIP() << "no restartable sequences here";
  for (int i = 0; i < 20; ++i) {
    stay.begin();
    std::this_thread::sleep_for(100us);
    EXPECT_FALSE(stay.unbroken());
  }
  int unbroken = 0;
  for (int i = 0; i < 1000; ++i) {
    stay.begin();
    unbroken += stay.unbroken() ? 1 : 0;
  }
  EXPECT_GT(unbroken, 0);
}

TEST(DurationStatistics, QuantilesAreWithinABucketOfTheTruth) {
  DurationStatistics statistics;
  for (TimeNs i = 1; i <= 10000; ++i) statistics.add(i * 100);
  const DurationSnapshot all = statistics.snapshot();
  EXPECT_EQ(all.count, 10000U);
  EXPECT_EQ(all.max_ns, 1'000'000);
  EXPECT_DOUBLE_EQ(all.mean_ns(), 500'050.0);
  for (const double q : {0.1, 0.5, 0.9, 0.99}) {
    EXPECT_GE(static_cast<double>(all.quantile_ns(q)), q * 1e6 * 0.999);
    EXPECT_LE(static_cast<double>(all.quantile_ns(q)), q * 1e6 * 1.26);
  }
  EXPECT_EQ(all.quantile_ns(1.0), 1'000'000);
}

TEST(DurationStatistics, EveryDurationFallsInTheBucketWhoseBoundsHoldIt) {
  for (TimeNs duration = 64; duration < 2'000'000'000; duration += 1 + duration / 97) {
    const std::size_t bucket = LogHistogram::bucket(duration);
    EXPECT_LE(LogHistogram::lower_bound(bucket), duration);
    if (bucket + 1 < LogHistogram::kBuckets) {
      EXPECT_GT(LogHistogram::lower_bound(bucket + 1), duration);
    }
  }
  EXPECT_EQ(LogHistogram::bucket(-5), 0U);
}

}  // namespace
}  // namespace omma
