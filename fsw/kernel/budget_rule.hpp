// What is done about a component whose steps keep breaking their budget: declared beside the budget, counted
// here, carried out by the scheduler.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace omma {

enum class BreachReaction : std::uint8_t {
  kNone,     ///< an event for each breach, nothing more
  kDegrade,  ///< the component is told to do with less (Component::degrade), one level more each time
  kSkip,     ///< the component is left out for some beats
  kSafe,     ///< the observer is asked for the safe mode
};

constexpr std::string_view reaction_name(BreachReaction reaction) {
  switch (reaction) {
    case BreachReaction::kNone:
      return "none";
    case BreachReaction::kDegrade:
      return "degrade";
    case BreachReaction::kSkip:
      return "skip";
    case BreachReaction::kSafe:
      return "safe";
  }
  return "none";
}

/// React after `breaches` of the last `in_steps` steps; then the counting begins anew.
struct BudgetRule {
  static constexpr int kMaxSteps = 64;

  BreachReaction reaction = BreachReaction::kNone;
  int breaches = 3;
  int in_steps = 0;  ///< at least `breaches`, at most kMaxSteps; 0: as many, so that they are consecutive
  int beats =
      10;  ///< kSkip: left out for so many; kDegrade: a level is given back after so many without breach
  int max_level = 3;  ///< kDegrade

  constexpr int window() const { return in_steps == 0 ? breaches : in_steps; }
  constexpr bool valid() const {
    return reaction == BreachReaction::kNone ||
           (breaches >= 1 && breaches <= window() && window() <= kMaxSteps && beats >= 1 && max_level >= 1);
  }
};

/// Counts the breaches of one component.
class BudgetWatch {
 public:
  BudgetWatch() = default;
  explicit constexpr BudgetWatch(const BudgetRule& rule) : rule_(rule) {}

  constexpr const BudgetRule& rule() const { return rule_; }

  /// After each step. @return what is to be done now, at most once for each rule's worth of breaches
  constexpr BreachReaction after_step(bool breached) noexcept {
    quiet_steps_ = breached ? 0 : quiet_steps_ + (quiet_steps_ < rule_.beats ? 1 : 0);
    if (rule_.reaction == BreachReaction::kNone) return BreachReaction::kNone;
    recent_ = (recent_ << 1 | (breached ? 1U : 0U)) &
              (~std::uint64_t{0} >> (BudgetRule::kMaxSteps - rule_.window()));
    if (std::popcount(recent_) < rule_.breaches) return BreachReaction::kNone;
    recent_ = 0;
    return rule_.reaction;
  }

  /// True once for each `beats` steps in a row without a breach.
  constexpr bool recovered() noexcept {
    if (quiet_steps_ < rule_.beats) return false;
    quiet_steps_ = 0;
    return true;
  }

 private:
  BudgetRule rule_;
  std::uint64_t recent_ = 0;  // the last steps, newest in bit 0; 1: breached
  int quiet_steps_ = 0;
};

}  // namespace omma
