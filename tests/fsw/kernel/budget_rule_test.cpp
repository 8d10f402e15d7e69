// What happens to a component that keeps breaking its budget: after how many breaches, and what then.
#include "fsw/kernel/budget_rule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <numeric>
#include <random>
#include <thread>

#include "fsw/kernel/scheduler.hpp"
#include "fsw/kernel/wiring.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using testing::FakeClock;
using testing::Scripted;

TEST(BudgetWatch, ReactsAsACountOverTheLastStepsWould) {
  std::mt19937_64 random(3);
  int reactions = 0;
  for (int trial = 0; trial < 500; ++trial) {
    BudgetRule rule{.reaction = BreachReaction::kSafe, .breaches = static_cast<int>(1 + random() % 6)};
    if (random() % 3 != 0)
      rule.in_steps =
          rule.breaches + static_cast<int>(random() % (65 - static_cast<unsigned>(rule.breaches)));
    ASSERT_TRUE(rule.valid());
    BudgetWatch watch(rule);
    std::deque<int> last;
    for (int step = 0; step < 300; ++step) {
      const bool breached = random() % 3 == 0;
      last.push_back(breached ? 1 : 0);
      if (static_cast<int>(last.size()) > rule.window()) last.pop_front();
      const bool due = std::accumulate(last.begin(), last.end(), 0) >= rule.breaches;
      if (due) last.clear();
      ASSERT_EQ(watch.after_step(breached), due ? BreachReaction::kSafe : BreachReaction::kNone);
      reactions += due ? 1 : 0;
    }
  }
  EXPECT_GT(reactions, 1000);
}

/// Slow on the ticks it is told to be; notes all that is done to it.
class Slow final : public Component {
 public:
  Slow(FakeClock& clock, std::vector<std::uint64_t> slow_ticks)
      : clock_(clock), slow_ticks_(std::move(slow_ticks)) {}
  Out<testing::Number> number;
  std::string_view name() const override { return "slow"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("number", number); }
  void step(const Tick& tick) noexcept override {
    stepped.push_back(tick.number);
    number->value = static_cast<int>(tick.number);
    const bool slow = std::find(slow_ticks_.begin(), slow_ticks_.end(), tick.number) != slow_ticks_.end();
    clock_.spend(slow ? 200'001 : 200'000);
  }
  void degrade(int level) noexcept override { levels.push_back(level); }
  void skipped(const Tick& tick) noexcept override {
    left_out.push_back(tick.number);
    number->value = -1;
    clock_.spend(1000);
  }
  std::vector<std::uint64_t> stepped;
  std::vector<std::uint64_t> left_out;
  std::vector<int> levels;

 private:
  FakeClock& clock_;
  std::vector<std::uint64_t> slow_ticks_;
};

struct Reactions final : ScheduleObserver {
  void budget_reaction(SchedulePlace place, const Tick& tick, BreachReaction reaction,
                       int level) noexcept override {
    EXPECT_EQ(place.component, 0);
    seen.push_back({tick.number, reaction, level});
  }
  void budget_recovered(SchedulePlace, const Tick& tick, int level) noexcept override {
    recovered.emplace_back(tick.number, level);
  }
  std::vector<std::tuple<std::uint64_t, BreachReaction, int>> seen;
  std::vector<std::pair<std::uint64_t, int>> recovered;
};

RateGroupTable table_of(Component& component, const BudgetRule& rule) {
  return {.base_period = 1ms, .groups = {{.name = "only", .components = {{component, 200us, rule}}}}};
}

TEST(BudgetRule, DegradesALevelEachTimeUpToTheLastAndGivesThemBackOneByOne) {
  FakeClock clock;
  Slow slow(clock, {2, 3, 5, 6, 8, 9, 20, 21});
  Reactions observer;
  Scheduler scheduler(
      table_of(slow, {.reaction = BreachReaction::kDegrade, .breaches = 2, .beats = 10, .max_level = 2}),
      clock, observer);
  scheduler.run(50);
  EXPECT_THAT(
      observer.seen,
      ElementsAre(std::tuple{3U, BreachReaction::kDegrade, 1}, std::tuple{6U, BreachReaction::kDegrade, 2},
                  std::tuple{9U, BreachReaction::kDegrade, 2}, std::tuple{21U, BreachReaction::kDegrade, 2}));
  EXPECT_THAT(observer.recovered, ElementsAre(std::pair{19U, 1}, std::pair{31U, 1}, std::pair{41U, 0}));
  EXPECT_THAT(slow.levels, ElementsAre(1, 2, 2, 1, 2, 1, 0));
  EXPECT_EQ(scheduler.group(0).component_timing(0).level.load(), 0);
  EXPECT_EQ(slow.stepped.size(), 50U);
}

TEST(BudgetRule, LeavesTheComponentOutForTheBeatsDeclaredAndChargesNobodyForThem) {
  FakeClock clock;
  Slow slow(clock, {4, 6, 7});
  testing::Sink reader;
  reader.number.bind(slow.number);
  Scripted next("next", [&](const Tick&) { clock.spend(50'000); });
  Reactions observer;
  RateGroupTable table =
      table_of(slow, {.reaction = BreachReaction::kSkip, .breaches = 2, .in_steps = 3, .beats = 4});
  table.groups[0].components.push_back({next, 50us});
  table.groups[0].components.push_back({reader});
  Scheduler scheduler(table, clock, observer);
  scheduler.run(12);
  EXPECT_THAT(observer.seen, ElementsAre(std::tuple{6U, BreachReaction::kSkip, 0}));
  EXPECT_THAT(slow.stepped, ElementsAre(0, 1, 2, 3, 4, 5, 6, 11));
  EXPECT_THAT(slow.left_out, ElementsAre(7, 8, 9, 10));
  EXPECT_THAT(reader.seen, ElementsAre(0, 1, 2, 3, 4, 5, 6, -1, -1, -1, -1, 11));
  EXPECT_EQ(scheduler.group(0).component_timing(0).skipped.load(), 4U);
  EXPECT_EQ(scheduler.group(0).component_timing(0).wall.snapshot().count, 8U);
  EXPECT_EQ(scheduler.group(0).component_timing(1).wall.snapshot().max_ns, 50'000);
  EXPECT_EQ(scheduler.group(0).component_timing(1).over_budget.load(), 0U);
}

TEST(BudgetRule, AsksForTheSafeModeOnceForEachRulesWorthOfBreaches) {
  FakeClock clock;
  Slow slow(clock, {1, 2, 3, 4, 5, 6, 7});
  Reactions observer;
  Scheduler scheduler(table_of(slow, {.reaction = BreachReaction::kSafe, .breaches = 3}), clock, observer);
  scheduler.run(20);
  EXPECT_THAT(observer.seen, ElementsAre(std::tuple{3U, BreachReaction::kSafe, 0},
                                         std::tuple{6U, BreachReaction::kSafe, 0}));
}

// Each step sleeps, so that it loses the processor in truth; how long is up to the test's clock.
TEST(BudgetRule, DoesNotBlameAComponentForThePreemptionByOthers) {
  for (const bool slow : {false, true}) {
    FakeClock clock;
    Scripted component("component", [&](const Tick&) {
      std::this_thread::sleep_for(10us);
      if (slow)
        clock.spend(300'000);
      else
        clock.pass(300'000);
    });
    Reactions observer;
    Scheduler scheduler(table_of(component, {.reaction = BreachReaction::kSafe, .breaches = 3}), clock,
                        observer);
    scheduler.run(30);
    EXPECT_EQ(scheduler.group(0).component_timing(0).over_budget.load(), 30U);
    EXPECT_EQ(observer.seen.size(), slow ? 10U : 0U);
  }
}

TEST(BudgetRule, HasNoConsequencesInLockstep) {
  LockstepClock clock;
  int steps = 0;
  Scripted slow("slow", [&](const Tick&) {
    ++steps;
    const TimeNs end = clock.stopwatch() + 5'000;
    while (clock.stopwatch() < end) {
    }
  });
  Reactions observer;
  RateGroupTable table = table_of(slow, {.reaction = BreachReaction::kSkip, .breaches = 1});
  table.groups[0].components[0].budget = 1ns;
  Scheduler scheduler(table, clock, observer);
  scheduler.run(20);
  EXPECT_EQ(steps, 20);
  EXPECT_TRUE(observer.seen.empty());
}

TEST(BudgetRule, ThatMakesNoSenseIsRefusedAtTheStart) {
  Scripted component("c");
  const auto faults = [&](std::chrono::nanoseconds budget, const BudgetRule& rule, int threads = 1) {
    return trace_wiring({.base_period = 1ms,
                         .groups = {{.name = "g", .components = {{component, budget, rule, threads}}}}})
        .faults;
  };
  const std::string limits =
      " steps; it must be 1 to 64 breaches in at least as many and at most 64 steps, beats and max_level at "
      "least 1.";
  EXPECT_THAT(faults(1us, {.reaction = BreachReaction::kSafe, .breaches = 5, .in_steps = 4}),
              ElementsAre("component 'c' reacts after 5 breaches in 4" + limits));
  EXPECT_THAT(faults(1us, {.reaction = BreachReaction::kSkip, .breaches = 65}),
              ElementsAre("component 'c' reacts after 65 breaches in 65" + limits));
  EXPECT_THAT(faults(1us, {.reaction = BreachReaction::kSkip, .beats = 0}),
              ElementsAre("component 'c' reacts after 3 breaches in 3" + limits));
  EXPECT_THAT(faults(0us, {.reaction = BreachReaction::kSafe}),
              ElementsAre("component 'c' has a reaction to a broken budget but no budget."));
  EXPECT_THAT(faults(-1us, {}), ElementsAre("component 'c' has a negative budget."));
  EXPECT_THAT(faults(1us, {}, 0), ElementsAre("component 'c' has 0 threads; it must be at least 1."));
}

}  // namespace
}  // namespace omma
