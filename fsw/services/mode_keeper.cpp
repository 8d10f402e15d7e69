// Going from mode to mode.
#include "fsw/services/mode_keeper.hpp"

namespace omma {

ModeKeeper::ModeKeeper(std::span<const ModeTransition> transitions, Events& events)
    : transitions_(transitions), events_(events) {}

void ModeKeeper::visit_ports(PortVisitor& visitor) const {
  visitor.input("channels", channels);
  visitor.output("state", state);
}

void ModeKeeper::request_safe(ModeCause cause) noexcept {
  asked_.store(static_cast<std::uint8_t>(1 + static_cast<int>(cause)), std::memory_order_release);
}

void ModeKeeper::step(const Tick& tick) noexcept {
  if (const std::uint8_t asked = asked_.exchange(0, std::memory_order_acquire);
      asked != 0 && state->mode != Mode::kSafe) {
    enter(Mode::kSafe, static_cast<ModeCause>(asked - 1), tick);
    return;
  }
  for (std::size_t i = 0; i < transitions_.size(); ++i) {
    const ModeTransition& transition = transitions_[i];
    if (transition.commanded || !contains(transition.from, state->mode)) continue;
    if (!held_[i].after(transition.when.holds(*channels), transition.when.beats)) continue;
    enter(transition.to, ModeCause::kTransition, tick);
    return;
  }
}

CommandOutcome ModeKeeper::receive(const Command& command, const Tick& tick) noexcept {
  const auto to = static_cast<Mode>(static_cast<int>(command.arguments[0]));
  if (to == state->mode) return CommandOutcome::done();
  for (const ModeTransition& transition : transitions_) {
    if (!transition.commanded || transition.to != to || !contains(transition.from, state->mode)) continue;
    if (!transition.when.holds(*channels)) continue;
    enter(to, ModeCause::kCommand, tick);
    return CommandOutcome::done();
  }
  return CommandOutcome::refused(CommandReason::kRefused);
}

void ModeKeeper::enter(Mode mode, ModeCause cause, const Tick& tick) noexcept {
  events_.raise<kModeEntered>(tick, static_cast<int>(mode), static_cast<int>(state->mode),
                              static_cast<int>(cause));
  *state = {mode, tick.time_ns};
  phase_.store(modes(mode), std::memory_order_release);
  for (Persistence& held : held_) held.reset();
}

}  // namespace omma
