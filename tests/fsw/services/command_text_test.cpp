// Commands as words: from an operator or a script to numbers and back; every mistake is one sentence.
#include "fsw/services/command_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/command_script.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using testing::HasSubstr;

constexpr std::array kCommands{
    CommandDescriptor{.id = 3, .name = "halt", .text = "stops"},
    CommandDescriptor{.id = 4,
                      .name = "go",
                      .text = "goes",
                      .arguments = {{{.name = "way", .type = ValueType::kChoice, .choices = "left|right"},
                                     {.name = "speed", .unit = "m/s", .least = 0, .most = 9}}}},
    CommandDescriptor{.id = 5,
                      .name = "set",
                      .text = "sets",
                      .arguments = {{{.name = "parameter", .type = ValueType::kParameter},
                                     {.name = "value", .least = -1e9, .most = 1e9}}}}};
const std::vector<ParameterEntry> kParameters{
    {11, "wheel.count", {.name = "count", .type = ValueType::kInteger, .least = 1, .most = 8}},
    {12, "wheel.locked", {.name = "locked", .type = ValueType::kFlag}}};
const CommandVocabulary kWords{kCommands, kParameters};

Command read(std::vector<std::string_view> words) {
  return command_from_words(words, kWords, "console");
}
std::string fault(const std::vector<std::string_view>& words) {
  return refusal_of([&] { read(words); });
}

TEST(CommandText, WordsBecomeNumbersAndNumbersWords) {
  const Command go = read({"go", "right", "2.5"});
  EXPECT_EQ(go.opcode, 4);
  EXPECT_EQ(go.argument_count, 2);
  EXPECT_EQ(go.arguments[0], 1);
  EXPECT_EQ(go.arguments[1], 2.5);
  EXPECT_EQ(command_text(go, kWords), "go right 2.5");
  EXPECT_EQ(read({"set", "wheel.locked", "true"}).arguments[1], 1);
  EXPECT_EQ(command_text(read({"set", "wheel.locked", "on"}), kWords), "set wheel.locked true");
  EXPECT_EQ(command_text({.opcode = 99, .argument_count = 1, .arguments = {7}}, kWords), "command 99 7");
}

TEST(CommandText, EachMistakeIsASentence) {
  EXPECT_EQ(fault({}), "console: command: expected the name of a command, found nothing");
  EXPECT_THAT(fault({"jump"}), HasSubstr("expected the name of a command, found \"jump\""));
  EXPECT_EQ(fault({"go", "left"}), "console: go: expected 2 values, found 1");
  EXPECT_EQ(fault({"halt", "now"}), "console: halt: expected 0 values, found 1");
  EXPECT_THAT(fault({"go", "up", "1"}), HasSubstr("go way: expected one of left right, found \"up\""));
  EXPECT_THAT(fault({"go", "left", "fast"}), HasSubstr("go speed: expected a number 0 to 9 m/s, found"));
  EXPECT_THAT(fault({"go", "left", "nan"}), HasSubstr("expected a number"));
  EXPECT_THAT(fault({"set", "wheel.size", "1"}), HasSubstr("expected the name of a parameter"));
  EXPECT_THAT(fault({"set", "wheel.locked", "7"}), HasSubstr("expected true or false"));
}

TEST(CommandText, AnAcknowledgementSaysWhatWasWrong) {
  CommandAck ack{.command = read({"set", "wheel.count", "12"}),
                 .stage = CommandStage::kRejected,
                 .reason = CommandReason::kArgumentRange,
                 .argument = 1};
  EXPECT_EQ(ack_text(ack, kWords),
            "set wheel.count 12: rejected: value is 12, and must be a whole number 1 to 8");
  ack = {.command = read({"halt"}), .stage = CommandStage::kCompleted};
  EXPECT_EQ(ack_text(ack, kWords), "halt: completed");
  for (int reason = 0; reason <= static_cast<int>(CommandReason::kNotSaved); ++reason) {
    ack.stage = CommandStage::kRejected;
    ack.reason = static_cast<CommandReason>(reason);
    ack.argument = 200;
    EXPECT_EQ(ack_text(ack, kWords).size() > 20, reason > 0) << ack_text(ack, kWords);
  }
}

class CommandScript : public testing::Test {
 protected:
  ~CommandScript() override { std::filesystem::remove(file_); }
  std::vector<ScriptedCommand> read_script(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_command_script(file_, kWords);
  }
  std::string script_fault(const std::string& text) const {
    return refusal_of([&] { read_script(text); });
  }
  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("omma_script_" + std::to_string(getpid()) + ".txt");
};

TEST_F(CommandScript, HasACommandALineByFrameSet) {
  const auto script = read_script("# a test\n\n 3 go left 1 # slowly\n3 halt\n10   set wheel.count 2\n");
  ASSERT_EQ(script.size(), 3U);
  EXPECT_EQ(script[0].tick, 3U);
  EXPECT_EQ(script[0].command.opcode, 4);
  EXPECT_EQ(script[2].tick, 10U);
}

TEST_F(CommandScript, NamesFileAndLineOfAMistake) {
  EXPECT_THAT(script_fault("3 halt\nsoon halt\n"),
              HasSubstr(".txt:2: frame set: expected a whole number from 0, found \"soon\""));
  EXPECT_THAT(script_fault("-1 halt\n"), HasSubstr(":1: frame set: expected"));
  EXPECT_THAT(script_fault("3 halt\n2 halt\n"),
              HasSubstr(":2: frame set: expected at least that of the line above, 3, found 2"));
  EXPECT_THAT(script_fault("3\n"), HasSubstr(":1: command: expected the name of a command, found nothing"));
  EXPECT_THAT(script_fault("3 go left\n"), HasSubstr(":1: go: expected 2 values, found 1"));
}

TEST_F(CommandScript, ThatIsMissingIsSaid) {
  EXPECT_THROW(read_command_script("/no/such/script", kWords), InputError);
}

}  // namespace
}  // namespace omma
