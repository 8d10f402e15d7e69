// The keeper of the modes: a declared graph of transitions, by command or by themselves, each with its guard.
// What runs in which mode is declared in the schedule (ScheduledComponent::phases); a component that does not
// is left out, and its outputs are withdrawn (Component::skipped).
//
//   inline constexpr std::array kTransitions{
//       ModeTransition{.from = modes(Mode::kAcquire), .to = Mode::kTrack,
//                      .when = {.channel = kSolutions.id, .value = 0.5, .beats = 3}}};
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/channel.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/mode.hpp"

namespace omma {

struct ModeTransition {
  ModeSet from = 0;
  Mode to = Mode::kStandby;
  bool commanded =
      false;         ///< by command, where the guard holds at that moment; else by itself, once it has held
  Condition when{};  ///< the guard
  std::string_view text{};  ///< why
};

constexpr bool is_well_formed(const ModeTransition& transition) {
  return transition.from != 0 && !contains(transition.from, transition.to) &&
         is_well_formed(transition.when) && (transition.commanded || transition.when.channel != 0);
}
template <std::size_t kCount>
constexpr bool are_well_formed_transitions(const std::array<ModeTransition, kCount>& transitions) {
  for (const ModeTransition& transition : transitions)
    if (!is_well_formed(transition)) return false;
  // A mode that cannot be left by command could only be left by luck.
  for (int mode = 0; mode < kModeCount; ++mode) {
    bool way_out = false;
    for (const ModeTransition& transition : transitions)
      way_out = way_out || (transition.commanded && contains(transition.from, static_cast<Mode>(mode)));
    if (!way_out) return false;
  }
  return kCount <= limits::kConditions;
}

inline constexpr CommandDescriptor kSetMode{
    .id = 6,
    .name = "set_mode",
    .text = "goes to another mode, where the graph of modes has that way and its guard holds",
    .arguments = {{{.name = "mode", .type = ValueType::kChoice, .choices = kModeNames}}}};
inline constexpr std::array kModeCommands{kSetMode};

enum class ModeCause : std::uint8_t { kTransition, kCommand, kFaultRule, kBudget };
inline constexpr std::string_view kModeCauses =
    "its guard|command|a fault rule|a budget that keeps being broken";

inline constexpr EventDescriptor kModeEntered{
    .id = 61,
    .severity = EventSeverity::kActivity,
    .name = "mode_entered",
    .text = "mode {0} entered from {1}: by {2}",
    .values = {{{"mode", "", kModeNames}, {"before", "", kModeNames}, {"cause", "", kModeCauses}}},
    .burst = 16};
inline constexpr std::array kModeEvents{kModeEntered};
static_assert(are_unique(kModeEvents) && are_well_formed(kModeEvents));

class ModeKeeper final : public Component, public CommandReceiver {
 public:
  /// @param transitions  in order: where several guards hold, the first is taken; outlive this
  ModeKeeper(std::span<const ModeTransition> transitions, Events& events);

  In<ChannelValues> channels;
  Out<ModeState> state;

  std::string_view name() const override { return "mode_keeper"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;

  /// From any thread: safe mode with the next beat.
  void request_safe(ModeCause cause) noexcept;
  /// The bit of the present mode, for the schedule: from the next beat of each rate group on.
  const std::atomic<std::uint32_t>& phase() const { return phase_; }

 private:
  void enter(Mode mode, ModeCause cause, const Tick& tick) noexcept;

  std::span<const ModeTransition> transitions_;
  std::array<Persistence, limits::kConditions> held_{};
  Events& events_;
  std::atomic<std::uint32_t> phase_{modes(Mode::kAcquire)};
  std::atomic<std::uint8_t> asked_{0};  // 1 + cause; 0: nobody
};

}  // namespace omma
