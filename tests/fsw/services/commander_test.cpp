// The commander: every command is judged once, by its declaration; what was judged is never executed again.
#include "fsw/services/commander.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"

namespace omma {
namespace {

using testing::ElementsAre;

constexpr std::uint32_t kSession = 77;

inline constexpr CommandDescriptor kPoint{
    .id = 40,
    .name = "point",
    .text = "turns to an angle",
    .arguments = {{{.name = "angle", .unit = "deg", .least = -90, .most = 90},
                   {.name = "turns", .type = ValueType::kInteger, .least = 0, .most = 10},
                   {.name = "fast", .type = ValueType::kFlag},
                   {.name = "way", .type = ValueType::kChoice, .choices = "left|right"}}}};
inline constexpr CommandDescriptor kSlow{.id = 41, .name = "slow", .text = "takes its time"};
inline constexpr CommandDescriptor kNever{.id = 42, .name = "never", .text = "is refused"};

static_assert(are_unique(std::array{kPoint, kSlow, kNever}));
static_assert(are_well_formed(std::array{kPoint, kSlow, kNever}));
static_assert(!are_unique(std::array{kPoint, CommandDescriptor{.id = 40, .name = "other", .text = "t"}}));
static_assert(!are_unique(std::array{kPoint, CommandDescriptor{.id = 1, .name = "point", .text = "t"}}));
static_assert(!is_well_formed(CommandDescriptor{.id = 0, .name = "n", .text = "t"}));
static_assert(!is_well_formed(CommandDescriptor{.id = limits::kCommandIds, .name = "n", .text = "t"}));
static_assert(!is_well_formed(CommandDescriptor{.id = 1, .name = "", .text = "t"}));
static_assert(!is_well_formed(CommandDescriptor{
    .id = 1, .name = "n", .text = "t", .arguments = {{{.name = "a", .least = 2, .most = 1}}}}));
static_assert(!is_well_formed(CommandDescriptor{
    .id = 1, .name = "n", .text = "t", .arguments = {{{.name = "a", .type = ValueType::kChoice}}}}));

/// Remembers what it was told to do.
class Receiver final : public CommandReceiver {
 public:
  CommandOutcome receive(const Command& command, const Tick&) noexcept override {
    if (command.opcode == kNever.id) return CommandOutcome::refused(CommandReason::kRefused);
    ++executed;
    last = command;
    return command.opcode == kSlow.id ? CommandOutcome::under_way() : CommandOutcome::done();
  }
  CommandOutcome progress(const Command&) noexcept override { return outcome; }

  int executed = 0;
  Command last;
  CommandOutcome outcome = CommandOutcome::under_way();
};

/// "accepted", "completed", "rejected 7".
std::string told(const CommandAck& ack) {
  static constexpr const char* kStages[] = {"accepted", "rejected", "completed", "failed"};
  std::string text = kStages[static_cast<std::size_t>(ack.stage)];
  if (ack.reason != CommandReason::kNone) text += " " + std::to_string(static_cast<int>(ack.reason));
  return text;
}
std::string rejected(CommandReason reason) {
  return "rejected " + std::to_string(static_cast<int>(reason));
}

class CommanderTest : public testing::Test {
 protected:
  CommanderTest() {
    commander.bind(std::array{kPoint, kSlow, kNever}, receiver);
    commander.acks.bind(acks);
  }
  std::vector<std::string> step() {
    commander.step({tick_, static_cast<TimeNs>(tick_) * 1'000'000});
    ++tick_;
    std::vector<std::string> all;
    while (acks.pop(newest)) all.push_back(told(newest));
    return all;
  }
  std::vector<std::string> give(const Command& command) {
    EXPECT_TRUE(commander.submit(command));
    return step();
  }
  Command point(std::uint32_t sequence, double angle, double turns = 1, double fast = 0,
                double way = 1) const {
    return {.sender = 5,
            .session = kSession,
            .sequence = sequence,
            .opcode = kPoint.id,
            .argument_count = 4,
            .arguments = {angle, turns, fast, way}};
  }
  Command plain(std::uint32_t sequence, std::uint16_t opcode) const {
    return {.sender = 5, .session = kSession, .sequence = sequence, .opcode = opcode};
  }

  Commander commander{kSession};
  Receiver receiver;
  Queue<CommandAck, 64> acks;
  CommandAck newest;
  std::uint64_t tick_ = 0;
};

TEST_F(CommanderTest, AGoodCommandIsExecutedAndAcknowledgedTwice) {
  EXPECT_THAT(give(point(1, 45.5)), ElementsAre("accepted", "completed"));
  EXPECT_EQ(receiver.executed, 1);
  EXPECT_EQ(receiver.last.arguments[0], 45.5);
  EXPECT_EQ(newest.command.sender, 5U);
  EXPECT_EQ(newest.command.sequence, 1U);
  EXPECT_EQ(commander.state->last_sequence, 1U);
  EXPECT_EQ(commander.state->accepted, 1U);
}

TEST_F(CommanderTest, EachKindOfBadCommandHasItsReasonAndIsNotExecuted) {
  const double nan = std::nan("");
  EXPECT_THAT(give(point(1, 90.1)), ElementsAre(rejected(CommandReason::kArgumentRange)));
  EXPECT_EQ(newest.argument, 0);
  EXPECT_THAT(give(point(2, nan)), ElementsAre(rejected(CommandReason::kArgumentType)));
  EXPECT_THAT(give(point(3, 0, 11)), ElementsAre(rejected(CommandReason::kArgumentRange)));
  EXPECT_EQ(newest.argument, 1);
  EXPECT_THAT(give(point(4, 0, 1.5)), ElementsAre(rejected(CommandReason::kArgumentType)));
  EXPECT_THAT(give(point(5, 0, 1, 2)), ElementsAre(rejected(CommandReason::kArgumentRange)));
  EXPECT_THAT(give(point(6, 0, 1, 0, 2)), ElementsAre(rejected(CommandReason::kArgumentRange)));
  Command few = point(7, 0);
  few.argument_count = 3;
  EXPECT_THAT(give(few), ElementsAre(rejected(CommandReason::kArgumentCount)));
  few.sequence = 8;
  few.argument_count = 200;
  EXPECT_THAT(give(few), ElementsAre(rejected(CommandReason::kArgumentCount)));
  EXPECT_THAT(give(plain(9, 43)), ElementsAre(rejected(CommandReason::kOpcode)));
  EXPECT_THAT(give(plain(10, 65535)), ElementsAre(rejected(CommandReason::kOpcode)));
  EXPECT_THAT(give(plain(11, kNever.id)), ElementsAre(rejected(CommandReason::kRefused)));
  Command foreign = point(12, 0);
  foreign.session = kSession + 1;
  EXPECT_THAT(give(foreign), ElementsAre(rejected(CommandReason::kSession)));
  EXPECT_EQ(receiver.executed, 0);
  EXPECT_EQ(commander.state->rejected, 12U);
}

TEST_F(CommanderTest, ARepeatedOrOldNumberIsToldAndNotExecuted) {
  give(point(5, 1));
  EXPECT_THAT(give(point(5, 1)), ElementsAre(rejected(CommandReason::kSequenceRepeated)));
  EXPECT_THAT(give(point(4, 2)), ElementsAre(rejected(CommandReason::kSequenceRepeated)));
  EXPECT_THAT(give(point(0, 2)), ElementsAre(rejected(CommandReason::kSequenceRepeated)));
  EXPECT_EQ(receiver.executed, 1);
  EXPECT_THAT(give(point(6, 3)), ElementsAre("accepted", "completed"));
}

TEST_F(CommanderTest, ASenderThatIsStartedAnewCannotRepeatByAccident) {
  give(point(1, 1));
  give(point(2, 2));
  // Started anew it is another sender; counting from 1 again does nothing, going on from the status does.
  Command again = point(1, 1);
  again.sender = 6;
  EXPECT_THAT(give(again), ElementsAre(rejected(CommandReason::kSequenceRepeated)));
  again.sequence = commander.state->last_sequence + 1;
  EXPECT_THAT(give(again), ElementsAre("accepted", "completed"));
  EXPECT_EQ(receiver.executed, 3);
}

TEST_F(CommanderTest, ANumberFarAheadIsRefusedSoThatOneMistakeLocksNobodyOut) {
  EXPECT_THAT(give(point(std::numeric_limits<std::uint32_t>::max(), 0)),
              ElementsAre(rejected(CommandReason::kSequenceAhead)));
  EXPECT_THAT(give(point(Commander::kMostAhead + 1, 0)),
              ElementsAre(rejected(CommandReason::kSequenceAhead)));
  EXPECT_THAT(give(point(Commander::kMostAhead, 0)), ElementsAre("accepted", "completed"));
}

TEST_F(CommanderTest, WhatTakesItsTimeIsCompletedWhenItIsDone) {
  EXPECT_THAT(give(plain(1, kSlow.id)), ElementsAre("accepted"));
  EXPECT_THAT(step(), ElementsAre());
  receiver.outcome = CommandOutcome::failed(CommandReason::kNotSaved);
  EXPECT_THAT(step(), ElementsAre("failed " + std::to_string(static_cast<int>(CommandReason::kNotSaved))));
  receiver.outcome = CommandOutcome::under_way();
  for (std::uint32_t i = 0; i < Commander::kUnderWay; ++i) give(plain(2 + i, kSlow.id));
  EXPECT_THAT(give(plain(90, kSlow.id)), ElementsAre(rejected(CommandReason::kBusy)));
  receiver.outcome = CommandOutcome::done();
  EXPECT_EQ(step().size(), Commander::kUnderWay);
  EXPECT_THAT(step(), ElementsAre());
}

TEST_F(CommanderTest, AFullInletTurnsAwayAndABeatJudgesOnlySoMany) {
  for (std::uint32_t i = 0; i < Commander::kInlet; ++i) EXPECT_TRUE(commander.submit(point(i + 1, 0)));
  EXPECT_FALSE(commander.submit(point(999, 0)));
  EXPECT_EQ(step().size(), 2U * Commander::kPerBeat);
}

TEST_F(CommanderTest, AnswersThatFindNoRoomAreCounted) {
  for (std::uint32_t sequence = 1; sequence <= 40; ++sequence) {
    ASSERT_TRUE(commander.submit(point(sequence, 1)));
    commander.step({sequence, 0});
  }
  EXPECT_EQ(commander.state->accepted, 40U);
  EXPECT_EQ(commander.state->acks_dropped, 2U * 40U - 64U);
}

TEST_F(CommanderTest, AScriptGivesItsCommandsAtTheirTicks) {
  commander.play({{1, point(0, 10)}, {1, point(0, 20)}, {3, plain(0, kNever.id)}});
  EXPECT_THAT(step(), ElementsAre());
  EXPECT_THAT(step(), ElementsAre("accepted", "completed", "accepted", "completed"));
  EXPECT_EQ(receiver.last.arguments[0], 20);
  EXPECT_THAT(step(), ElementsAre());
  EXPECT_THAT(step(), ElementsAre(rejected(CommandReason::kRefused)));
  EXPECT_EQ(commander.state->last_sequence, 3U);
}

TEST_F(CommanderTest, ACommandWithoutAReceiverIsSaidBeforeTimeStarts) {
  const std::array all{kPoint, CommandDescriptor{.id = 90, .name = "orphan", .text = "t"}};
  EXPECT_THAT(commander.unbound(all), ElementsAre("command 'orphan' has no receiver"));
}

// Any number the format can carry, good ones among them: each command has exactly one verdict, and is
// executed if and only if a second reading of the declarations finds it good.
TEST_F(CommanderTest, TenThousandRandomCommandsAreEachExecutedOrRejectedWithAReason) {
  std::mt19937 generator(3);
  const auto random = [&generator] { return static_cast<std::uint32_t>(generator()); };
  const auto any = [&](std::initializer_list<double> values) {
    return values.begin()[random() % values.size()];
  };
  const double inf = std::numeric_limits<double>::infinity();
  int executed = 0;
  int turned_away = 0;
  for (int i = 0; i < 10'000; ++i) {
    const std::uint32_t last = commander.state->last_sequence;
    Command command{.sender = random(),
                    .session = random() % 8 == 0 ? random() : kSession,
                    .sequence = random() % 8 == 0 ? random() : last + 1 + random() % 3,
                    .opcode = static_cast<std::uint16_t>(random() % 4 == 0 ? random() : kPoint.id),
                    .argument_count = static_cast<std::uint8_t>(random() % 6 == 0 ? random() : 4)};
    command.arguments[0] = any({0, 90, -90, 90.001, 12.5, std::nan(""), inf, -inf, 1e300});
    for (std::size_t a = 1; a < 4; ++a) command.arguments[a] = any({0, 1, 1, 1, 2, 0.5, -1, std::nan("")});
    const std::array<double, 4>& v = command.arguments;
    const bool fresh = command.session == kSession && command.sequence > last &&
                       command.sequence - last <= Commander::kMostAhead;
    const auto in = [](double value, double least, double most) { return value >= least && value <= most; };
    const bool good_point = command.opcode == kPoint.id && command.argument_count == 4 && in(v[0], -90, 90) &&
                            (v[1] == 0 || v[1] == 1 || v[1] == 2) && (v[2] == 0 || v[2] == 1) &&
                            (v[3] == 0 || v[3] == 1);
    const int before = receiver.executed;
    const std::vector<std::string> said = give(command);
    ASSERT_FALSE(said.empty());
    if (fresh && good_point) {
      ASSERT_THAT(said, ElementsAre("accepted", "completed"));
      ASSERT_EQ(receiver.executed, before + 1);
      ++executed;
    } else if (command.opcode != kSlow.id && command.opcode != kNoOperation.id) {
      ASSERT_EQ(said.size(), 1U);
      ASSERT_NE(newest.reason, CommandReason::kNone);
      ASSERT_EQ(receiver.executed, before);
      ++turned_away;
    }
  }
  EXPECT_GT(executed, 300);
  EXPECT_GT(turned_away, 5000);
}

TEST_F(CommanderTest, JudgesInARealTimeStepWithoutTouchingMemory) {
  if (!memory_guard::installed()) GTEST_SKIP() << "the sanitizers bring their own malloc";
  for (std::uint32_t i = 0; i < 20; ++i) commander.submit(point(i + 1, i * 10.0));
  const std::uint64_t before = memory_guard::violations().total();
  {
    const RealTimeScope real_time;
    for (std::uint64_t t = 0; t < 10; ++t) commander.step({t, 0});
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_EQ(receiver.executed, 10);
}

}  // namespace
}  // namespace omma
