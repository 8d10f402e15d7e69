// Judging commands.
#include "fsw/services/commander.hpp"

namespace omma {

Commander::Commander(std::uint32_t session) {
  state->session = session;
  bind(kCommanderCommands, *this);
}

void Commander::bind(const CommandDescriptor& command, CommandReceiver& receiver) {
  bindings_[command.id] = {command, &receiver};
}

std::vector<std::string> Commander::unbound(std::span<const CommandDescriptor> all) const {
  std::vector<std::string> sentences;
  for (const CommandDescriptor& command : all)
    if (bindings_[command.id].receiver == nullptr)
      sentences.push_back("command '" + std::string(command.name) + "' has no receiver");
  return sentences;
}

void Commander::visit_ports(PortVisitor& visitor) const {
  if (mode.source() != nullptr) visitor.input("mode", mode);
  visitor.output("acks", acks);
  visitor.output("state", state);
}

void Commander::step(const Tick& tick) noexcept {
  look_after_those_under_way(tick);
  Command command;
  for (int i = 0; i < kPerBeat && next(tick, command); ++i) judge(command, tick);
}

CommandOutcome Commander::receive(const Command& /*command*/, const Tick& /*tick*/) noexcept {
  return CommandOutcome::done();  // kNoOperation, the only one of its own
}

bool Commander::next(const Tick& tick, Command& command) noexcept {
  if (!orders_.empty()) {
    command = numbered(orders_.back());
    orders_.pop_back();
    return true;
  }
  if (next_scripted_ < script_.size() && script_[next_scripted_].tick <= tick.number) {
    command = numbered(script_[next_scripted_++].command);
    return true;
  }
  return inlet_.pop(command);
}

Command Commander::numbered(Command command) const noexcept {
  command.session = state->session;
  command.sequence = state->last_sequence + 1;
  return command;
}

void Commander::judge(const Command& command, const Tick& tick) noexcept {
  CommandAck ack = verdict(command);
  // Its number is used up once it is judged by its content, good or bad.
  const bool numbered = ack.reason != CommandReason::kSession &&
                        ack.reason != CommandReason::kSequenceRepeated &&
                        ack.reason != CommandReason::kSequenceAhead;
  if (numbered) state->last_sequence = command.sequence;
  CommandOutcome outcome;
  if (ack.stage == CommandStage::kAccepted) {
    outcome = bindings_[command.opcode].receiver->receive(command, tick);
    if (outcome.state == CommandOutcome::State::kRefused) {
      ack.stage = CommandStage::kRejected;
      ack.reason = outcome.reason;
      ack.argument = outcome.argument;
    }
  }
  acknowledge(ack, tick);
  if (ack.stage != CommandStage::kAccepted) return;
  if (outcome.state == CommandOutcome::State::kUnderWay) {
    under_way_.push_back(command);
    return;
  }
  const bool done = outcome.state == CommandOutcome::State::kDone;
  ack.stage = done ? CommandStage::kCompleted : CommandStage::kFailed;
  ack.reason = outcome.reason;
  acknowledge(ack, tick);
}

CommandAck Commander::verdict(const Command& command) const noexcept {
  CommandAck ack{.command = command};
  const auto reject = [&ack](CommandReason reason, std::size_t argument = 0) {
    ack.reason = reason;
    ack.argument = static_cast<std::uint8_t>(argument);
    return ack;
  };
  if (command.session != state->session) return reject(CommandReason::kSession);
  if (command.sequence <= state->last_sequence) return reject(CommandReason::kSequenceRepeated);
  if (command.sequence - state->last_sequence > kMostAhead) return reject(CommandReason::kSequenceAhead);
  if (command.opcode >= bindings_.size() || bindings_[command.opcode].receiver == nullptr)
    return reject(CommandReason::kOpcode);
  const CommandDescriptor& declared = bindings_[command.opcode].descriptor;
  if (command.argument_count != declared.argument_count()) return reject(CommandReason::kArgumentCount);
  for (std::size_t i = 0; i < command.argument_count; ++i) {
    const ValueFault fault = omma::judge(declared.arguments[i], command.arguments[i]);
    if (fault == ValueFault::kType) return reject(CommandReason::kArgumentType, i);
    if (fault == ValueFault::kRange) return reject(CommandReason::kArgumentRange, i);
  }
  if (mode.source() != nullptr && !contains(declared.modes, mode->mode)) return reject(CommandReason::kMode);
  if (under_way_.full()) return reject(CommandReason::kBusy);
  ack.stage = CommandStage::kAccepted;
  return ack;
}

void Commander::acknowledge(CommandAck ack, const Tick& tick) noexcept {
  ack.time_ns = tick.time_ns;
  if (ack.stage == CommandStage::kAccepted) ++state->accepted;
  if (ack.stage == CommandStage::kRejected) ++state->rejected;
  if (!acks.send(ack)) ++state->acks_dropped;
}

void Commander::look_after_those_under_way(const Tick& tick) noexcept {
  StaticVector<Command, kUnderWay> still;
  for (const Command& command : under_way_) {
    const CommandOutcome outcome = bindings_[command.opcode].receiver->progress(command);
    if (outcome.state == CommandOutcome::State::kUnderWay) {
      still.push_back(command);
      continue;
    }
    const bool done = outcome.state == CommandOutcome::State::kDone;
    acknowledge({.command = command,
                 .stage = done ? CommandStage::kCompleted : CommandStage::kFailed,
                 .reason = outcome.reason},
                tick);
  }
  under_way_ = still;
}

}  // namespace omma
