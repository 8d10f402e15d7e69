// Commander: takes the commands that an ordinary thread left in its inlet (or a script gives by tick), judges
// each by its declaration, gives the good ones to their receivers and acknowledges all of them. First in its
// rate group, so that what a command changes holds for the whole beat.
//
// Replay-safe: a command names the run of the program it is meant for and a sequence number larger than any
// before. What was judged once is never executed again, however often and by whomever it is sent.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/spsc_queue.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/mode.hpp"

namespace omma {

inline constexpr CommandDescriptor kNoOperation{
    .id = 1, .name = "no_operation", .text = "does nothing: shows that commands arrive and are answered"};

inline constexpr std::array kCommanderCommands{kNoOperation};

/// What the ground must know to send the next command.
struct CommanderState {
  std::uint32_t session = 0;
  std::uint32_t last_sequence = 0;  ///< of the newest command judged; 0: none yet
  std::uint32_t acks_dropped = 0;   ///< acknowledgements that found their queue full
  std::uint32_t accepted = 0;
  std::uint32_t rejected = 0;
  friend bool operator==(const CommanderState&, const CommanderState&) = default;
};

/// A command that is given at a tick, not by a sender; like the program's own it gets the number that is
/// next.
struct ScriptedCommand {
  std::uint64_t tick = 0;
  Command command;
};

class Commander final : public Component, public CommandReceiver {
 public:
  static constexpr std::size_t kInlet = 32;          ///< commands that wait
  static constexpr int kPerBeat = 4;                 ///< judged in a beat
  static constexpr std::size_t kUnderWay = 8;        ///< accepted and not yet done
  static constexpr std::uint32_t kMostAhead = 1000;  ///< sequence numbers that may be skipped at once

  /// @param session  tells this run of the program from others; the same in every replay
  explicit Commander(std::uint32_t session);

  /// Before time starts: these commands go to this receiver.
  template <std::size_t kCount>
  void bind(const std::array<CommandDescriptor, kCount>& commands, CommandReceiver& receiver) {
    for (const CommandDescriptor& command : commands) bind(command, receiver);
  }
  void bind(const CommandDescriptor& command, CommandReceiver& receiver);
  /// Those of `all` that no receiver was bound to, a sentence each.
  std::vector<std::string> unbound(std::span<const CommandDescriptor> all) const;
  /// Before time starts: commands by tick, in order; they get the sequence numbers that are next.
  void play(std::vector<ScriptedCommand> script) { script_ = std::move(script); }

  /// One ordinary thread: false while the inlet is full.
  bool submit(const Command& command) noexcept { return inlet_.push(command); }

  /// From a step of its own rate group: one of the program's own commands, one that takes no values.
  void order(std::uint16_t opcode) noexcept { orders_.push_back({.opcode = opcode}); }

  Previous<ModeState> mode;  // left unbound where there are no modes
  OutQueue<CommandAck> acks;
  Out<CommanderState> state;

  std::string_view name() const override { return "commander"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;

 private:
  struct Binding {
    CommandDescriptor descriptor;
    CommandReceiver* receiver = nullptr;
  };

  bool next(const Tick& tick, Command& command) noexcept;
  Command numbered(Command command) const noexcept;
  void judge(const Command& command, const Tick& tick) noexcept;
  CommandAck verdict(const Command& command) const noexcept;
  void acknowledge(CommandAck ack, const Tick& tick) noexcept;
  void look_after_those_under_way(const Tick& tick) noexcept;

  std::array<Binding, limits::kCommandIds> bindings_{};
  std::vector<ScriptedCommand> script_;
  std::size_t next_scripted_ = 0;
  StaticVector<Command, kUnderWay> orders_;
  SpscQueue<Command, kInlet> inlet_;
  StaticVector<Command, kUnderWay> under_way_;
};

}  // namespace omma
