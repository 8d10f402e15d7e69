// The proof that a schedule holds: known examples, thousands of random schedules beside a simulated machine,
// and what is said of one that does not.
#include "fsw/kernel/schedulability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "fsw/kernel/scheduler.hpp"
#include "tests/fsw/kernel/preemption.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Scripted;
using testing::SimulatedGroup;

/// The same groups as a table; a unit of time is 1 ns.
class Table {
 public:
  explicit Table(const std::vector<SimulatedGroup>& groups) {
    table.base_period = 1ns;
    for (const SimulatedGroup& group : groups) {
      components_.push_back(std::make_unique<Scripted>("c" + std::to_string(components_.size())));
      table.groups.push_back({.name = "group",
                              .divisor = static_cast<std::uint32_t>(group.period),
                              .offset = static_cast<std::uint32_t>(group.offset),
                              .priority = group.priority,
                              .core = group.core,
                              .components = {{*components_.back(),
                                              std::chrono::nanoseconds(testing::makespan(group)),
                                              {},
                                              group.threads}}});
    }
  }
  RateGroupTable table;

 private:
  std::vector<std::unique_ptr<Scripted>> components_;
};

std::vector<TimeNs> responses(const Schedulability& found) {
  std::vector<TimeNs> result;
  for (const GroupResponse& group : found.groups) result.push_back(group.response_ns);
  return result;
}

TEST(Schedulability, FindsTheResponseTimesOfTheTextbook) {
  // Burns and Wellings, Real-Time Systems and Programming Languages, process set C: 3 in 7, 3 in 12, 5 in 20.
  const Table set({{.period = 7, .priority = 3, .jobs = {3}},
                   {.period = 12, .priority = 2, .jobs = {3}},
                   {.period = 20, .priority = 1, .jobs = {5}}});
  const Schedulability found = analyse_schedule(set.table, 1);
  EXPECT_THAT(responses(found), ElementsAre(3, 6, 20));
  EXPECT_TRUE(found.faults.empty());
  EXPECT_NEAR(found.utilisation, 3.0 / 7 + 3.0 / 12 + 5.0 / 20, 1e-12);
}

std::vector<SimulatedGroup> random_groups(std::mt19937_64& random, int processors, bool tied, bool shared) {
  const std::vector<int> periods{4, 5, 6, 8, 10, 12, 15, 20, 24, 30};
  std::vector<SimulatedGroup> groups(2 + random() % 4);
  for (SimulatedGroup& group : groups) {
    group.period = periods[random() % periods.size()];
    group.priority = static_cast<int>(1 + random() % 4);
    if (tied || random() % 2 == 0)
      group.core = static_cast<int>(random() % static_cast<unsigned>(processors));
    if (shared && random() % 2 == 0) group.threads = processors;
    const std::size_t n_jobs = 1 + random() % (group.threads == 1 ? 1 : 4);
    for (std::size_t i = 0; i < n_jobs; ++i) group.jobs.push_back(static_cast<int>(1 + random() % 4));
  }
  return groups;
}

// On one processor the analysis is exact: distinct priorities, all groups beginning together.
TEST(Schedulability, OnOneProcessorIsExact) {
  std::mt19937_64 random(1);
  int held = 0, refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<SimulatedGroup> groups = random_groups(random, 1, true, false);
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g].priority = 10 - static_cast<int>(g);
    const Schedulability found = analyse_schedule(Table(groups).table, 1);
    const std::vector<int> simulated = testing::longest_responses(groups, 1, 240, random);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      ASSERT_EQ(found.groups[g].holds, simulated[g] <= groups[g].period)
          << "trial " << trial << " group " << g;
      if (!found.groups[g].holds) break;  // after an overrun the simulation of the lower ones says nothing
      ASSERT_EQ(found.groups[g].response_ns, simulated[g]) << "trial " << trial << " group " << g;
    }
    ++(found.faults.empty() ? held : refused);
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(refused, 100);
}

// On several, with offsets, equal priorities, threads that move and steps that are shared: never too short.
TEST(Schedulability, OnSeveralProcessorsIsNeverTooShort) {
  std::mt19937_64 random(2);
  int held = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const int processors = static_cast<int>(2 + random() % 2);
    std::vector<SimulatedGroup> groups = random_groups(random, processors, trial % 4 == 0, trial % 2 == 0);
    for (SimulatedGroup& group : groups)
      group.offset = static_cast<int>(random() % static_cast<unsigned>(group.period));
    const Schedulability found = analyse_schedule(Table(groups).table, processors);
    if (!found.faults.empty()) continue;
    ++held;
    const std::vector<int> simulated = testing::longest_responses(groups, processors, 240, random);
    for (std::size_t g = 0; g < groups.size(); ++g)
      ASSERT_LE(simulated[g], found.groups[g].response_ns) << "trial " << trial << " group " << g;
  }
  EXPECT_GT(held, 400);
}

TEST(Schedulability, CountsTheThreadsThatShareAStep) {
  const Table alone({{.period = 10, .priority = 2, .core = 0, .threads = 1, .jobs = {6}},
                     {.period = 10, .priority = 1, .core = 1, .jobs = {6}}});
  EXPECT_TRUE(analyse_schedule(alone.table, 2).faults.empty());
  const Table shared({{.period = 10, .priority = 2, .core = 0, .threads = 2, .jobs = {6, 6}},
                      {.period = 10, .priority = 1, .core = 1, .jobs = {6}}});
  const Schedulability found = analyse_schedule(shared.table, 2);
  EXPECT_TRUE(found.groups[0].holds);
  EXPECT_FALSE(found.groups[1].holds);
  const Schedulability narrow = analyse_schedule(shared.table, 1);
  ASSERT_FALSE(narrow.faults.empty());
  EXPECT_EQ(narrow.faults[0], "rate group 'group': 2 threads share a step of 'c0' on 1 processor.");
}

TEST(Schedulability, OrdinaryGroupsAreNotPromisedAnythingAndTakeNothing) {
  const Table set({{.period = 10, .priority = 0, .jobs = {9}}, {.period = 10, .priority = 1, .jobs = {9}}});
  EXPECT_TRUE(analyse_schedule(set.table, 1).faults.empty());
}

RateGroupTable overfull(Component& quick, Component& slow) {
  return {
      .base_period = 10ms,
      .groups = {{.name = "motion", .priority = 80, .core = 0, .components = {{quick, 6ms}}},
                 {.name = "vision", .divisor = 2, .priority = 60, .core = 0, .components = {{slow, 9ms}}}}};
}

TEST(Schedulability, ATableThatDoesNotHoldIsRefusedWithItsNumbers) {
  Scripted quick("quick");
  Scripted slow("slow");
  try {
    check_schedule(overfull(quick, slow), 1);
    FAIL() << "accepted";
  } catch (const ScheduleError& error) {
    EXPECT_STREQ(
        error.what(),
        "the schedule does not hold: rate group 'vision' may take 21.000 ms or more of its period of "
        "20.000 ms: its budgets are 9.000 ms, the rest goes to groups of its priority or above "
        "(real-time groups use 105 % of the processors).");
  }
  Scripted whole("whole");
  try {
    check_schedule({.base_period = 10ms, .groups = {{.name = "g", .components = {{whole, 11ms}}}}}, 1);
    FAIL() << "accepted";
  } catch (const ScheduleError& error) {
    EXPECT_STREQ(
        error.what(),
        "the schedule does not hold: rate group 'g' has budgets of 11.000 ms in a period of 10.000 ms "
        "(110 % of a processor).");
  }
}

TEST(Schedulability, TheSchedulerRefusesToStartSuchATableUnlessTimeWaits) {
  Scripted quick("quick");
  Scripted slow("slow");
  MonotonicClock monotonic;
  EXPECT_THROW(Scheduler(overfull(quick, slow), monotonic), ScheduleError);
  LockstepClock lockstep;
  EXPECT_NO_THROW(Scheduler(overfull(quick, slow), lockstep));
}

TEST(Schedulability, IsPrintedAsATable) {
  Scripted quick("quick");
  Scripted slow("slow");
  Scripted free("free");
  RateGroupTable table = overfull(quick, slow);
  table.groups[1].components[0].on_breach = {.reaction = BreachReaction::kSkip, .breaches = 2, .in_steps = 5};
  table.groups[1].components.push_back({free});
  const std::string text = schedule_text(table, 1);
  EXPECT_THAT(text,
              HasSubstr("motion                   10.000 ms   6.000 ms   6.000 ms        80     0   60 %\n"));
  EXPECT_THAT(text, HasSubstr("DOES NOT HOLD"));
  EXPECT_THAT(text, HasSubstr("skip after 2 in 5"));
  EXPECT_THAT(text, HasSubstr("free has no budget and is not counted\n"));
}

}  // namespace
}  // namespace omma
