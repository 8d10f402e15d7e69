// Looking for faults: each is told and reacted to once, until its condition holds no longer.
#include "fsw/services/fault_watch.hpp"

#include <algorithm>

namespace omma {

FaultWatch::FaultWatch(std::span<const FaultRule> rules, Events& events, ModeKeeper& modes,
                       Commander& commander)
    : rules_(rules.first(std::min(rules.size(), limits::kConditions))),
      events_(events),
      modes_(modes),
      commander_(commander) {}

void FaultWatch::step(const Tick& tick) noexcept {
  const Mode mode = modes_.state->mode;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const FaultRule& rule = rules_[i];
    const bool holds = contains(rule.in, mode) && rule.when.holds(*channels);
    if (held_[i].after(holds, rule.when.beats) && !found_[i]) {
      found_[i] = true;
      react(rule, tick);
    } else if (!holds && found_[i]) {
      found_[i] = false;
      events_.raise<kFaultGone>(tick, rule.id);
    }
  }
}

void FaultWatch::react(const FaultRule& rule, const Tick& tick) noexcept {
  events_.raise<kFaultFound>(tick, rule.id, channels->values[rule.when.channel],
                             static_cast<int>(rule.reaction));
  if (rule.reaction == FaultReaction::kSafe) modes_.request_safe(ModeCause::kFaultRule);
  if (rule.reaction == FaultReaction::kCommand) commander_.order(rule.command);
}

}  // namespace omma
