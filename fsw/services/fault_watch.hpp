// Fault rules, as data: a condition on a channel, how long it must last, and what is done about it.
//
//   FaultRule{.id = 1, .name = "cameras_gone", .text = "no camera gives fresh frames",
//             .when = {.channel = kFreshCameras.id, .comparison = Comparison::kBelow, .value = 1, .beats =
//             50}, .reaction = FaultReaction::kSafe}
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/channel.hpp"
#include "fsw/services/commander.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/mode_keeper.hpp"

namespace omma {

enum class FaultReaction : std::uint8_t {
  kTell,     ///< the event alone
  kSafe,     ///< safe mode
  kCommand,  ///< one of the program's own commands, one that takes no values
};

struct FaultRule {
  std::uint16_t id = 0;   ///< from 1, unique in the program
  std::string_view name;  ///< snake_case, unique in the program
  std::string_view text;  ///< what is wrong
  ModeSet in = kAnyMode;  ///< modes in which it is watched
  Condition when{};
  FaultReaction reaction = FaultReaction::kTell;
  std::uint16_t command = 0;  ///< its opcode
};

constexpr bool is_well_formed(const FaultRule& rule) {
  return rule.id > 0 && !rule.name.empty() && !rule.text.empty() && rule.in != 0 &&
         is_well_formed(rule.when) && rule.when.channel != 0 &&
         (rule.reaction == FaultReaction::kCommand) == (rule.command != 0);
}

inline constexpr EventDescriptor kFaultFound{
    .id = 62,
    .severity = EventSeverity::kFailure,
    .name = "fault_found",
    .text = "fault rule {0}: its channel is at {1}; reaction: {2}",
    .values = {{{"rule"}, {"value"}, {"reaction", "", "none but this|safe mode|a command"}}},
    .burst = 16};
inline constexpr EventDescriptor kFaultGone{.id = 63,
                                            .severity = EventSeverity::kActivity,
                                            .name = "fault_gone",
                                            .text = "fault rule {0}: its condition holds no longer",
                                            .values = {{{"rule"}}},
                                            .burst = 16};
inline constexpr std::array kFaultEvents{kFaultFound, kFaultGone};
static_assert(are_unique(kFaultEvents) && are_well_formed(kFaultEvents));

class FaultWatch final : public Component {
 public:
  /// @param rules  outlive this
  FaultWatch(std::span<const FaultRule> rules, Events& events, ModeKeeper& modes, Commander& commander);

  In<ChannelValues> channels;

  std::string_view name() const override { return "fault_watch"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.input("channels", channels); }
  void step(const Tick& tick) noexcept override;

 private:
  void react(const FaultRule& rule, const Tick& tick) noexcept;

  std::span<const FaultRule> rules_;
  std::array<Persistence, limits::kConditions> held_{};
  std::array<bool, limits::kConditions> found_{};
  Events& events_;
  ModeKeeper& modes_;
  Commander& commander_;
};

}  // namespace omma
