// Commands: what the ground can ask for, as an opcode and up to four values. Each is declared once, as a
// constant beside its receiver:
//
//   inline constexpr CommandDescriptor kStartPicture{
//       .id = 20, .name = "start_picture", .text = "begins a new picture with the next frame set"};
//
// The commander (commander.hpp) judges every command by its declaration before a receiver sees it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "config/service_limits.hpp"
#include "fsw/kernel/tick.hpp"
#include "fsw/services/descriptors.hpp"
#include "fsw/services/mode.hpp"
#include "fsw/services/value.hpp"

namespace omma {

struct CommandDescriptor {
  std::uint16_t id = 0;   ///< the opcode: 1 … limits::kCommandIds − 1, unique in the program
  std::string_view name;  ///< snake_case, unique in the program
  std::string_view text;  ///< what it does
  std::array<ValueDescriptor, limits::kCommandArguments> arguments{};
  ModeSet modes = kAnyMode;  ///< in which it is allowed

  constexpr std::size_t argument_count() const {
    std::size_t count = 0;
    while (count < arguments.size() && !arguments[count].name.empty()) ++count;
    return count;
  }
};

constexpr bool is_well_formed(const CommandDescriptor& command) {
  if (command.id == 0 || command.id >= limits::kCommandIds || command.name.empty() || command.text.empty() ||
      command.modes == 0)
    return false;
  for (std::size_t i = 0; i < command.arguments.size(); ++i)
    if (i < command.argument_count() ? !is_well_formed(command.arguments[i])
                                     : !command.arguments[i].name.empty())
      return false;
  return true;
}

/// A command as it travels.
struct Command {
  std::uint64_t sender = 0;    ///< a number of the sender's own choice; its acknowledgements carry it back
  std::uint32_t session = 0;   ///< of the flight program's run it is meant for
  std::uint32_t sequence = 0;  ///< larger than that of any command before in this session
  std::uint16_t opcode = 0;
  std::uint8_t argument_count = 0;
  std::array<double, limits::kCommandArguments> arguments{};
};

enum class CommandReason : std::uint8_t {
  kNone,
  kSession,           ///< meant for another run of the flight program
  kSequenceRepeated,  ///< this number or a later one was judged already
  kSequenceAhead,     ///< the number skips too many
  kOpcode,            ///< there is no such command
  kArgumentCount,     ///< too few or too many values
  kArgumentType,      ///< a value is no number, or not whole where it must be
  kArgumentRange,     ///< a value is out of its range
  kMode,              ///< not allowed in the present mode
  kBusy,              ///< the receiver has not finished with what it was asked before
  kRefused,           ///< the receiver's own condition is not met
  kNotSaved,          ///< done, but it could not be written to storage
};

enum class CommandStage : std::uint8_t {
  kAccepted,   ///< judged good and given to its receiver
  kRejected,   ///< not executed, and why
  kCompleted,  ///< done
  kFailed,     ///< accepted, but not done as asked, and why
};

/// What is told about a command. A good one has two: accepted, then completed or failed.
struct CommandAck {
  Command command;
  TimeNs time_ns = 0;
  CommandStage stage = CommandStage::kRejected;
  CommandReason reason = CommandReason::kNone;
  std::uint8_t argument = 0;  ///< the value at fault, where the reason is a value
};

/// What a receiver says to a command.
struct CommandOutcome {
  enum class State : std::uint8_t { kDone, kUnderWay, kRefused, kFailed };
  State state = State::kDone;
  CommandReason reason = CommandReason::kNone;
  std::uint8_t argument = 0;

  static constexpr CommandOutcome done() { return {}; }
  static constexpr CommandOutcome under_way() { return {State::kUnderWay}; }
  static constexpr CommandOutcome refused(CommandReason why, std::uint8_t argument = 0) {
    return {State::kRefused, why, argument};
  }
  static constexpr CommandOutcome failed(CommandReason why) { return {State::kFailed, why}; }
};

/// Who carries out commands. Both calls come on the commander's thread, in its step, before the components
/// that follow it: a receiver in another rate group keeps what it is told behind an atomic of its own.
class CommandReceiver {
 public:
  /// The command is well formed: opcode, number, type and range of its values.
  virtual CommandOutcome receive(const Command& command, const Tick& tick) noexcept = 0;
  /// Asked each beat about a command that is under way.
  virtual CommandOutcome progress(const Command&) noexcept { return CommandOutcome::done(); }

 protected:
  ~CommandReceiver() = default;
};

}  // namespace omma
