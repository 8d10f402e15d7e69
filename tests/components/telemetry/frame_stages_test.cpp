// The way of a frame set from its trigger: stamps from the schedule, latencies, budgets.
#include "components/telemetry/frame_stages.hpp"

#include <gtest/gtest.h>

#include <string>

#include "components/telemetry/frame_latency.hpp"
#include "components/telemetry/frame_report.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma::telemetry {
namespace {

using namespace std::chrono_literals;
using omma::testing::FakeClock;
using omma::testing::Scripted;

std::size_t at(FrameStage stage) {
  return static_cast<std::size_t>(stage);
}

/// A chain of three components that take 1, 2 and 3 ms, and a witness that copies the stamps at its end.
struct Chain {
  explicit Chain(Clock& clock_to_use, std::function<void(TimeNs)> spend) : clock(clock_to_use) {
    for (int i = 0; i < 3; ++i)
      parts[static_cast<std::size_t>(i)].emplace("part" + std::to_string(i),
                                                 [spend, i](const Tick&) { spend((i + 1) * 1'000'000); });
    witness.emplace("witness", [this](const Tick&) { seen.push_back(stages->done()); });
    auto& components = table.groups[0].components;
    for (std::size_t i = 0; i < 3; ++i) components.push_back({*parts[i], std::chrono::milliseconds(i + 1)});
    components.push_back({*witness, 1ms});
    ends = {{&*parts[1], FrameStage::kDots}, {&*parts[2], FrameStage::kSolution}};
    stages.emplace(table, ends, clock.lockstep());
    Scheduler scheduler(table, clock, *stages);
    scheduler.run(3);
  }

  Clock& clock;
  std::array<std::optional<Scripted>, 3> parts;
  std::optional<Scripted> witness;
  RateGroupTable table{.base_period = 100ms, .groups = {{.name = "vision"}}};
  std::vector<StageEnd> ends;
  std::optional<FrameStages> stages;
  std::vector<PerStage<>> seen;
};

TEST(FrameStages, AreStampedWhenTheirComponentHasStepped) {
  FakeClock clock(5'000'000'000);
  const Chain chain(clock, [&clock](TimeNs time) { clock.spend(time); });
  ASSERT_EQ(chain.seen.size(), 3U);
  const TimeNs start = 5'002'000'000;  // the scheduler's margin
  EXPECT_EQ(chain.seen[0][at(FrameStage::kDots)], start + 3'000'000);
  EXPECT_EQ(chain.seen[2][at(FrameStage::kSolution)], start + 206'000'000);
  EXPECT_EQ(chain.seen[2][at(FrameStage::kPairings)], kNotDone);
  EXPECT_EQ(chain.stages->on_board_offset(), 0);
}

TEST(FrameStages, CountFromTheBeginOfTheBeatWhereTimeStandsStill) {
  LockstepClock clock;
  const Chain chain(clock, [](TimeNs) {});
  ASSERT_EQ(chain.seen.size(), 3U);
  const TimeNs dots = chain.seen[2][at(FrameStage::kDots)];
  EXPECT_GE(dots, 200'000'000);  // on-board time of the tick, and what two empty steps took
  EXPECT_GE(chain.seen[2][at(FrameStage::kSolution)], dots);
}

TEST(FrameStages, BudgetsFollowFromTheSchedule) {
  LockstepClock clock;
  const Chain chain(clock, [](TimeNs) {});
  const PerStage<> budgets = stage_budgets(chain.table, chain.ends);
  EXPECT_EQ(budgets[at(FrameStage::kDots)], 3'000'000);
  EXPECT_EQ(budgets[at(FrameStage::kSolution)], 6'000'000);
  EXPECT_EQ(budgets[at(FrameStage::kPublished)], 107'000'000);
  EXPECT_EQ(budgets[at(FrameStage::kPairings)], 0);
}

TEST(FrameLatency, CountsFromTheTriggerAndNamesTheFirstStageBeyondItsBudget) {
  FrameLatency latency({0, 0, 10, 20, 30, 40, 50});
  FrameReport report({});
  omma_FrameTiming& out = report.frame_timing;
  EXPECT_EQ(latency.add({1000, 1005, 1010, 1020, 1030, 1040, 1050}, out), FrameStage::kTrigger);
  EXPECT_EQ(latency.add({2000, 2005, 2010, 2025, 2035, kNotDone, 2049}, out), FrameStage::kDots);
  ASSERT_EQ(out.stages._length, kFrameStages);
  const omma_StageTiming& dots = out.stages._buffer[at(FrameStage::kDots)];
  EXPECT_STREQ(dots.name, "dots");
  EXPECT_EQ(dots.time_ns, 2025);
  EXPECT_EQ(dots.latency_ns, 25);
  EXPECT_EQ(dots.budget_ns, 20);
  EXPECT_EQ(dots.mean_ns, 22);
  EXPECT_EQ(dots.max_ns, 25);
  EXPECT_EQ(dots.over_budget, 1U);
  const omma_StageTiming& solution = out.stages._buffer[at(FrameStage::kSolution)];
  EXPECT_FALSE(solution.reached);
  EXPECT_EQ(solution.mean_ns, 40) << "a stage that was left out is no measurement";
  EXPECT_EQ(out.stages._buffer[at(FrameStage::kPublished)].over_budget, 0U);
}

}  // namespace
}  // namespace omma::telemetry
