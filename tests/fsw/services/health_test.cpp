// The health component sees slow steps, missed beats, a stopped group, and nothing when all is well.
#include "fsw/services/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/dictionary.hpp"
#include "fsw/services/event_text.hpp"
#include "fsw/services/schedule_events.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using testing::FakeClock;
using ::testing::HasSubstr;
using testing::Scripted;

inline constexpr std::array kAllEvents{kBeatsMissed,     kStepOverBudget, kBudgetReaction,
                                       kBudgetRecovered, kGroupStopped,   kMemoryTouched};
static_assert(are_unique(kAllEvents));

TEST(Health, IsWellWhenEveryBeatIsServed) {
  LockstepClock clock;
  Events events;
  Health health(events);
  Scripted work("work");
  Scheduler scheduler(
      {.base_period = 10ms,
       .groups = {{.name = "vision", .priority = 2, .components = {{work, 1ms}}},
                  {.name = "housekeeping", .divisor = 100, .priority = 1, .components = {{health}}}}},
      clock);
  health.observe(scheduler);
  scheduler.run(301);
  EXPECT_TRUE(health.report->valid);
  EXPECT_EQ(health.report->state, HealthState::kOk);
  EXPECT_EQ(health.report->tick, 300U);
  ASSERT_EQ(health.report->groups.size(), 2U);
  EXPECT_EQ(health.report->groups[0].beats, 301U);
  EXPECT_FALSE(health.report->groups[0].stopped);
  ASSERT_EQ(health.timing->steps.size(), 2U);
  EXPECT_EQ(health.timing->steps[0].name, "work");
  EXPECT_EQ(health.timing->steps[0].steps, 301U);
  EXPECT_EQ(health.timing->steps[0].budget_ns, 1'000'000);
  EXPECT_EQ(events.raised(), 0U);
}

TEST(Health, IsDegradedByASlipAndWellAgainAfter) {
  FakeClock clock;
  Events events;
  ScheduleEvents observer(events);
  Health health(events);
  std::vector<HealthState> states;
  Scripted work("work", [&](const Tick& tick) {
    if (tick.number == 3) clock.spend(2'500'000);
  });
  Scripted witness("witness", [&](const Tick&) { states.push_back(health.report->state); });
  Scheduler scheduler(
      {.base_period = 1ms, .groups = {{.name = "all", .components = {{work, 1ms}, {health}, {witness}}}}},
      clock, observer);
  health.observe(scheduler);
  scheduler.run(9);
  // Ticks 0, 1, 2, 3 (slow: its budget), 6 (the two missed), 7, 8.
  EXPECT_EQ(states, (std::vector<HealthState>{HealthState::kOk, HealthState::kOk, HealthState::kOk,
                                              HealthState::kDegraded, HealthState::kDegraded,
                                              HealthState::kOk, HealthState::kOk}));
  EXPECT_EQ(health.report->ticks_missed, 2U);
  EventRecord record;
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(event_text(kStepOverBudget, record).substr(0, 36), "step of component 0 took 2500 us, of");
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(event_text(kBeatsMissed, record), "rate group 0 missed 2 beats, the first due at tick 4");
  EXPECT_FALSE(events.take(record));
}

TEST(ScheduleEvents, TellReactionAndRecovery) {
  Events events;
  ScheduleEvents observer(events);
  observer.budget_reaction({.component = 4}, {}, BreachReaction::kDegrade, 2);
  observer.budget_recovered({.component = 4}, {}, 1);
  EventRecord record;
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(event_text(kBudgetReaction, record).substr(0, 76),
            "component 4 keeps breaking its budget: reaction 1 (1 degraded, to level 2; 2");
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(event_text(kBudgetRecovered, record),
            "component 4 has kept its budget and works at level 1 again (0: all it can do)");
}

TEST(Health, SeesAGroupWhoseStepDoesNotReturn) {
  MonotonicClock clock;
  Events events;
  Health health(events);
  std::atomic<bool> hang{true};
  Scheduler* running = nullptr;
  Scripted stuck("stuck", [&](const Tick& tick) {
    while (tick.number >= 5 && hang.load()) std::this_thread::sleep_for(1ms);
  });
  Scripted judge("judge", [&](const Tick& tick) {
    if (health.report->state != HealthState::kFailed && tick.number < 5000) return;
    hang.store(false);
    running->stop();
  });
  Scheduler scheduler({.base_period = 1ms,
                       .groups = {{.name = "stuck", .components = {{stuck}}},
                                  {.name = "watch", .divisor = 10, .components = {{health}, {judge}}}}},
                      clock);
  health.observe(scheduler);
  running = &scheduler;
  scheduler.run();
  EXPECT_EQ(health.report->state, HealthState::kFailed);
  EXPECT_TRUE(health.report->groups[0].stopped);
  EXPECT_FALSE(health.report->groups[1].stopped);
  EventRecord record;
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(event_text(kGroupStopped, record), "rate group 0 has stopped: a step does not return");
}

TEST(Dictionary, ListsEventsGroupsAndConnections) {
  testing::Source source;
  testing::Sink sink;
  sink.number.bind(source.number);
  const std::array topics{TopicDescriptor{.name = "omma/p/sink", .type = "omma::Sink", .deadline_s = 2}};
  const std::string json = dictionary_json(
      {.program = "p", .events = kAllEvents, .topics = topics, .idl = "say \"rate\""},
      {.base_period = 5ms, .groups = {{.name = "g", .divisor = 2, .components = {{source, 1ms}, {sink}}}}});
  EXPECT_THAT(json, HasSubstr(R"({"program":"p","events":[{"id":1,"name":"beats_missed",)"));
  EXPECT_THAT(json, HasSubstr(R"("values":[{"name":"group","unit":""},{"name":"count","unit":""},)"));
  EXPECT_THAT(json,
              HasSubstr(R"("topics":[{"name":"omma/p/sink","type":"omma::Sink","reliable":false,"depth":1,)"
                        R"("deadline_s":2,"measured":false}])"));
  EXPECT_THAT(json, HasSubstr(R"("idl":"say \"rate\"")"));
  EXPECT_THAT(
      json,
      HasSubstr(
          R"({"name":"g","period_s":0.01,"offset_s":0,"priority":0,"critical":false,"components":[{"name":"source","budget_s":0.001)"));
  EXPECT_THAT(
      json,
      HasSubstr(R"([{"from":"source.number","to":"sink.number","by":"reference","previous_tick":false}])"));
}

}  // namespace
}  // namespace omma
