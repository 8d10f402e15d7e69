#include "components/camera/trigger_matching.hpp"

#include <algorithm>
#include <cstdlib>

namespace omma {

void TriggerMatching::add_trigger(std::uint64_t number, TimeNs edge_ns) noexcept {
  sent(count_) = {number, edge_ns, false};
  ++count_;
}

void TriggerMatching::learn(TimeNs stamp_ns) noexcept {
  for (std::uint64_t i = count_; i-- > first();) {
    const TimeNs age = elapsed(sent(i).edge_ns, stamp_ns);
    if (age < 0) continue;
    options_.delay_ns = age;
    return;
  }
}

TriggerMatch TriggerMatching::match(TimeNs stamp_ns) noexcept {
  TriggerMatch result;
  if (options_.delay_ns == TriggerMatchOptions::kLearn) learn(stamp_ns);
  if (count_ == 0 || options_.delay_ns == TriggerMatchOptions::kLearn) return result;
  std::uint64_t nearest = first();
  const auto offset = [&](std::uint64_t index) {
    return elapsed(sent(index).edge_ns + options_.delay_ns, stamp_ns);
  };
  for (std::uint64_t i = first() + 1; i < count_; ++i)
    if (std::abs(offset(i)) < std::abs(offset(nearest))) nearest = i;
  result.offset_ns = offset(nearest);
  if (std::abs(result.offset_ns) > options_.tolerance_ns) return result;

  Sent& trigger = sent(nearest);
  result.number = trigger.number;
  result.behind = count_ - 1 - nearest;
  if (trigger.has_frame) {
    result.kind = MatchKind::kRepeated;
    return result;
  }
  trigger.has_frame = true;
  result.kind = result.behind == 0 ? MatchKind::kOnTime : MatchKind::kLate;
  if (nearest >= next_frame_) {
    result.lost = nearest - next_frame_;
    lost_ += result.lost;
    next_frame_ = nearest + 1;
  } else if (lost_ > 0) {
    --lost_;  // it was only overtaken
  }
  return result;
}

}  // namespace omma
