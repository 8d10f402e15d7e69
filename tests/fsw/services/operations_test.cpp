// Limits, modes and fault rules: tables in, reactions out, beat by beat.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/event_text.hpp"
#include "fsw/services/fault_watch.hpp"
#include "fsw/services/limit_watch.hpp"
#include "fsw/services/mode_graph.hpp"
#include "fsw/services/mode_keeper.hpp"
#include "fsw/services/schedule_events.hpp"

namespace omma {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

inline constexpr ChannelDescriptor kHeat{.id = 1, .name = "heat", .unit = "K", .text = "of the box"};
inline constexpr ChannelDescriptor kFound{.id = 2, .name = "found", .text = "solutions"};

static_assert(are_unique(std::array{kHeat, kFound}) && are_well_formed(std::array{kHeat, kFound}));
static_assert(!are_unique(std::array{kHeat, ChannelDescriptor{.id = 1, .name = "other", .text = "t"}}));
static_assert(!is_well_formed(ChannelDescriptor{.id = limits::kChannelIds, .name = "n", .text = "t"}));

std::vector<int> event_ids(Events& events) {
  std::vector<int> ids;
  EventRecord record;
  while (events.take(record)) ids.push_back(record.id);
  return ids;
}

constexpr LimitDescriptor kHeatLimit{.id = 1,
                                     .name = "heat",
                                     .channel = kHeat.id,
                                     .alarm_low = -20,
                                     .warning_low = -10,
                                     .warning_high = 40,
                                     .alarm_high = 60,
                                     .hysteresis = 5,
                                     .beats = 2};
static_assert(is_well_formed(kHeatLimit));
constexpr LimitDescriptor changed(LimitDescriptor limit, double LimitDescriptor::*field, double value) {
  limit.*field = value;
  return limit;
}
static_assert(!is_well_formed(changed(kHeatLimit, &LimitDescriptor::warning_high, -11)), "low above high");
static_assert(!is_well_formed(changed(kHeatLimit, &LimitDescriptor::alarm_high, 39)), "alarm inside warning");
static_assert(!is_well_formed(changed(kHeatLimit, &LimitDescriptor::hysteresis, 25)), "no way back");

TEST(Limits, ChangeOnlyAfterSomeBeatsAndReturnOnlyBehindTheHysteresis) {
  LimitJudge judge;
  const auto state_after = [&](std::initializer_list<double> values) {
    for (const double value : values) judge.judge(kHeatLimit, value);
    return judge.state();
  };
  EXPECT_EQ(state_after({0, 41}), LimitState::kInside) << "one beat is not two";
  EXPECT_EQ(state_after({0, 41, 41}), LimitState::kWarning);
  EXPECT_EQ(state_after({39, 39, 39, 36}), LimitState::kWarning) << "within the hysteresis";
  EXPECT_EQ(state_after({34, 41, 34}), LimitState::kWarning);
  EXPECT_EQ(state_after({34, 34}), LimitState::kInside);
  EXPECT_EQ(state_after({61, 61}), LimitState::kAlarm) << "straight from inside";
  EXPECT_EQ(state_after({56, 56}), LimitState::kAlarm);
  EXPECT_EQ(state_after({50, 50}), LimitState::kWarning);
  EXPECT_EQ(state_after({-30, -30}), LimitState::kAlarm) << "the other side";
  EXPECT_EQ(state_after({-12, -12}), LimitState::kWarning);
  const double nan = std::nan("");
  EXPECT_EQ(state_after({nan, nan, 0, nan}), LimitState::kWarning) << "what is not known changes nothing";
  EXPECT_EQ(state_after({0}), LimitState::kInside) << "nor does it interrupt";
}

// Against the definition, written out with the whole past: a state lasts until `beats` values in a row since
// the last change say the same other state.
TEST(Limits, AgreeWithTheDefinitionOnRandomSequences) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-40, 80);
  for (int run = 0; run < 200; ++run) {
    LimitDescriptor limit = kHeatLimit;
    limit.beats = 1 + static_cast<std::uint32_t>(random() % 4);
    limit.hysteresis = static_cast<double>(random() % 3) * 4;
    LimitJudge judge;
    LimitState state = LimitState::kInside;
    std::vector<double> since;  // the last change
    double value = 0;
    const auto says = [&](double v) {
      const double alarm = state == LimitState::kAlarm ? limit.hysteresis : -1e-9;
      const double warning = state != LimitState::kInside ? limit.hysteresis : -1e-9;
      if (v >= 60 - alarm || v <= -20 + alarm) return LimitState::kAlarm;
      return v >= 40 - warning || v <= -10 + warning ? LimitState::kWarning : LimitState::kInside;
    };
    for (int beat = 0; beat < 200; ++beat) {
      if (random() % 3 == 0) value = any(random);
      judge.judge(limit, value);
      since.push_back(value);
      const LimitState now = says(value);
      bool lasted = now != state && since.size() >= limit.beats;
      for (std::size_t i = since.size() - std::min<std::size_t>(since.size(), limit.beats); i < since.size();
           ++i)
        lasted = lasted && says(since[i]) == now;
      if (lasted) {
        state = now;
        since.clear();
      }
      ASSERT_EQ(judge.state(), state) << "run " << run << ", beat " << beat;
    }
  }
}

constexpr std::array kTransitions{
    ModeTransition{.from = modes(Mode::kAcquire),
                   .to = Mode::kTrack,
                   .when = {.channel = kFound.id, .value = 0, .beats = 3}},
    ModeTransition{.from = modes(Mode::kTrack),
                   .to = Mode::kAcquire,
                   .when = {.channel = kFound.id, .comparison = Comparison::kEqual, .value = 0, .beats = 2}},
    ModeTransition{.from = modes(Mode::kSafe, Mode::kStandby),
                   .to = Mode::kAcquire,
                   .commanded = true,
                   .when = {.channel = kHeat.id, .comparison = Comparison::kBelow, .value = 50}},
    ModeTransition{.from = modes(Mode::kAcquire, Mode::kTrack), .to = Mode::kStandby, .commanded = true}};
static_assert(are_well_formed_transitions(kTransitions));
static_assert(!are_well_formed_transitions(std::array{kTransitions[0], kTransitions[1], kTransitions[3]}),
              "nothing leads out of safe mode");
static_assert(!is_well_formed(ModeTransition{
    .from = modes(Mode::kSafe), .to = Mode::kSafe, .commanded = true}));
static_assert(!is_well_formed(ModeTransition{.from = modes(Mode::kSafe), .to = Mode::kTrack}), "no guard");

constexpr std::array kRules{
    FaultRule{.id = 1,
              .name = "hot",
              .text = "too hot",
              .when = {.channel = kHeat.id, .value = 70, .beats = 3},
              .reaction = FaultReaction::kSafe},
    FaultRule{.id = 2,
              .name = "lost",
              .text = "nothing found",
              .in = modes(Mode::kTrack),
              .when = {.channel = kFound.id, .comparison = Comparison::kBelow, .value = 1, .beats = 1},
              .reaction = FaultReaction::kCommand,
              .command = kNoOperation.id}};
static_assert(are_unique(kRules) && are_well_formed(kRules));
static_assert(!are_unique(std::array{kRules[0], kRules[0]}));
static_assert(!is_well_formed(FaultRule{
    .id = 1, .name = "n", .text = "t", .when = {.channel = 1, .beats = 0}}));
static_assert(!is_well_formed(FaultRule{
    .id = 1, .name = "n", .text = "t", .when = {.channel = 1}, .reaction = FaultReaction::kCommand}));

/// Channels as the test writes them, and everything that looks at them, in the order of a rate group.
class Operations : public testing::Test {
 protected:
  class Source final : public Component {
   public:
    Out<ChannelValues> channels;
    std::string_view name() const override { return "source"; }
    void visit_ports(PortVisitor& visitor) const override { visitor.output("channels", channels); }
    void step(const Tick&) noexcept override {}
  };

  Operations() {
    for (In<ChannelValues>* input : {&modes_.channels, &faults_.channels, &limits_.channels})
      input->bind(source_.channels);
    commander_.mode.bind(modes_.state);
    commander_.acks.bind(acks_);
    commander_.bind(kModeCommands, modes_);
    set(20, 0);
  }
  void set(double heat, double found) {
    (*source_.channels)[kHeat] = heat;
    (*source_.channels)[kFound] = found;
  }
  Mode step(int beats = 1) {
    for (int i = 0; i < beats; ++i) {
      const Tick tick{tick_, static_cast<TimeNs>(tick_) * 1'000'000'000};
      commander_.step(tick);
      limits_.step(tick);
      faults_.step(tick);
      modes_.step(tick);
      ++tick_;
    }
    return modes_.state->mode;
  }
  CommandReason command(Mode to) {
    commander_.submit({.sequence = commander_.state->last_sequence + 1,
                       .opcode = kSetMode.id,
                       .argument_count = 1,
                       .arguments = {static_cast<double>(to)}});
    step();
    CommandAck ack;
    CommandReason first = CommandReason::kNone;
    for (bool is_first = true; acks_.pop(ack); is_first = false)
      if (is_first) first = ack.reason;
    return first;
  }

  Events events_;
  Source source_;
  Commander commander_{0};
  ModeKeeper modes_{kTransitions, events_};
  FaultWatch faults_{kRules, events_, modes_, commander_};
  LimitWatch limits_{std::span(&kHeatLimit, 1), events_};
  Queue<CommandAck, 64> acks_;
  std::uint64_t tick_ = 0;
};

TEST_F(Operations, TransitionsWaitForTheirGuardSoManyBeatsInARow) {
  set(20, 1);
  EXPECT_EQ(step(2), Mode::kAcquire);
  set(20, 0);
  EXPECT_EQ(step(), Mode::kAcquire);
  set(20, 1);
  EXPECT_EQ(step(2), Mode::kAcquire) << "it began anew";
  EXPECT_EQ(step(), Mode::kTrack);
  EXPECT_EQ(modes_.state->since_ns, 5'000'000'000);
  EXPECT_EQ(modes_.phase(), modes(Mode::kTrack));
  EXPECT_THAT(event_ids(events_), ElementsAre(kModeEntered.id));
}

TEST_F(Operations, AModeIsCommandedOnlyAlongTheGraphAndWhereItsGuardHolds) {
  EXPECT_EQ(command(Mode::kTrack), CommandReason::kRefused) << "no such way by command";
  EXPECT_EQ(command(Mode::kStandby), CommandReason::kNone);
  EXPECT_EQ(modes_.state->mode, Mode::kStandby);
  set(55, 0);
  EXPECT_EQ(command(Mode::kAcquire), CommandReason::kRefused) << "too hot";
  set(45, 0);
  EXPECT_EQ(command(Mode::kAcquire), CommandReason::kNone);
  EXPECT_EQ(command(Mode::kAcquire), CommandReason::kNone) << "it is there already";
}

TEST_F(Operations, ACommandOfAnotherModeIsRejected) {
  static constexpr CommandDescriptor kOnlySafe{
      .id = 30, .name = "only_safe", .text = "t", .modes = modes(Mode::kSafe)};
  commander_.bind(kOnlySafe, commander_);
  commander_.submit({.sequence = 1, .opcode = kOnlySafe.id});
  step();
  CommandAck ack;
  ASSERT_TRUE(acks_.pop(ack));
  EXPECT_EQ(ack.reason, CommandReason::kMode);
  modes_.request_safe(ModeCause::kBudget);
  step();
  commander_.submit({.sequence = 2, .opcode = kOnlySafe.id});
  step();
  ASSERT_TRUE(acks_.pop(ack));
  EXPECT_EQ(ack.stage, CommandStage::kAccepted);
}

TEST_F(Operations, AFaultThatLastsLeadsToSafeModeOnce) {
  set(75, 0);
  EXPECT_EQ(step(2), Mode::kAcquire);
  EXPECT_EQ(step(), Mode::kSafe);
  event_ids(events_);
  EXPECT_EQ(step(20), Mode::kSafe);
  EXPECT_THAT(event_ids(events_), ElementsAre()) << "told once";
  EXPECT_EQ(command(Mode::kAcquire), CommandReason::kRefused) << "still hot";
  set(30, 0);
  step();
  EXPECT_EQ(command(Mode::kAcquire), CommandReason::kNone);
  set(75, 0);
  EXPECT_EQ(step(3), Mode::kSafe) << "and again";
}

TEST_F(Operations, AFaultRuleMayGiveACommandAndIsWatchedInItsModesOnly) {
  step(5);
  EXPECT_EQ(commander_.state->accepted, 0U) << "not tracking: not watched";
  set(20, 1);
  step(3);
  set(20, 0);
  step();
  EXPECT_EQ(commander_.state->accepted, 0U);
  step();
  EXPECT_EQ(commander_.state->accepted, 1U) << "with the next beat";
}

TEST_F(Operations, ABrokenBudgetMayAskForSafeMode) {
  ScheduleEvents observer(events_, &modes_);
  observer.budget_reaction({}, {}, BreachReaction::kDegrade, 1);
  EXPECT_EQ(step(), Mode::kAcquire);
  observer.budget_reaction({}, {}, BreachReaction::kSafe, 0);
  EXPECT_EQ(step(), Mode::kSafe);
}

TEST_F(Operations, LimitsRaiseTheirEventsAndAreCounted) {
  set(45, 0);
  step(2);
  EXPECT_EQ(limits_.counts->warned, 1);
  set(65, 0);
  step(2);
  EXPECT_EQ(limits_.counts->warned, 0);
  EXPECT_EQ(limits_.counts->alarmed, 1);
  set(0, 0);
  step(2);
  EXPECT_THAT(event_ids(events_), ElementsAre(kLimitWarning.id, kLimitAlarm.id, kLimitInside.id));
}

TEST_F(Operations, LooksInARealTimeStepWithoutTouchingMemory) {
  if (!memory_guard::installed()) GTEST_SKIP() << "the sanitizers bring their own malloc";
  const std::uint64_t before = memory_guard::violations().total();
  {
    const RealTimeScope real_time;
    for (int i = 0; i < 50; ++i) {
      set(i % 2 == 0 ? 75 : 0, i % 7);
      step(4);
    }
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_EQ(modes_.state->mode, Mode::kSafe);
}

TEST(Modes, GraphShowsEveryWayWithItsGuard) {
  const std::string dot = mode_graph(kTransitions, std::array{kHeat, kFound});
  EXPECT_THAT(dot, HasSubstr("mode_acquire -> mode_track [label=\"found > 0\\n3 beats\"]"));
  EXPECT_THAT(dot, HasSubstr("mode_safe -> mode_acquire [label=\"heat < 50\", style=dashed]"));
}

/// Counts its steps and the beats in which it was left out.
class Worker final : public Component {
 public:
  explicit Worker(std::string_view name) : name_(name) {}
  std::string_view name() const override { return name_; }
  void visit_ports(PortVisitor&) const override {}
  void step(const Tick& tick) noexcept override {
    ++steps;
    if (phase != nullptr && tick.number == 4) phase->store(2);
  }
  void skipped(const Tick&) noexcept override { ++left_out; }
  std::atomic<std::uint32_t>* phase = nullptr;  // it changes, if given
  int steps = 0;
  int left_out = 0;

 private:
  std::string_view name_;
};

TEST(Modes, TheScheduleLeavesOutWhatDoesNotRunInAPhaseFromTheNextBeatOn) {
  std::atomic<std::uint32_t> phase{1};
  Worker always("always");
  Worker first("first");
  Worker second("second");
  always.phase = &phase;
  LockstepClock clock;
  Scheduler scheduler({.base_period = std::chrono::milliseconds(1),
                       .groups = {{.name = "all",
                                   .components = {{always},
                                                  {.component = first, .phases = 1},
                                                  {.component = second, .phases = 2}}}},
                       .phase = &phase},
                      clock);
  scheduler.run(10);
  EXPECT_EQ(always.steps, 10);
  EXPECT_EQ(first.steps, 5);
  EXPECT_EQ(first.left_out, 5);
  EXPECT_EQ(second.steps, 5);
  EXPECT_EQ(second.left_out, 5);
}

}  // namespace
}  // namespace omma
