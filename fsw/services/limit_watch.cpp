// Watching limits.
#include "fsw/services/limit_watch.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

/// Beyond `warning` or `alarm`, each narrower by the hysteresis where the state is that already.
LimitState state_of(const LimitDescriptor& limit, double value, LimitState before) {
  const auto beyond = [&](double low, double high, bool was) {
    const double margin = was ? limit.hysteresis : 0;
    return was ? value <= low + margin || value >= high - margin : value < low || value > high;
  };
  if (beyond(limit.alarm_low, limit.alarm_high, before == LimitState::kAlarm)) return LimitState::kAlarm;
  if (beyond(limit.warning_low, limit.warning_high, before != LimitState::kInside))
    return LimitState::kWarning;
  return LimitState::kInside;
}

}  // namespace

bool LimitJudge::judge(const LimitDescriptor& limit, double value) noexcept {
  if (std::isnan(value)) return false;
  const LimitState now = state_of(limit, value, state_);
  if (now != next_) held_.reset();
  next_ = now;
  if (!held_.after(now != state_, limit.beats)) return false;
  state_ = now;
  held_.reset();
  return true;
}

LimitWatch::LimitWatch(std::span<const LimitDescriptor> watched, Events& events)
    : watched_(watched.first(std::min(watched.size(), limits::kLimits))), events_(events) {}

void LimitWatch::visit_ports(PortVisitor& visitor) const {
  visitor.input("channels", channels);
  visitor.output("counts", counts);
}

void LimitWatch::step(const Tick& tick) noexcept {
  *counts = {};
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const LimitDescriptor& limit = watched_[i];
    const double value = channels->values[limit.channel];
    const bool changed = judges_[i].judge(limit, value);
    const LimitState state = judges_[i].state();
    counts->warned = static_cast<std::uint16_t>(counts->warned + (state == LimitState::kWarning ? 1 : 0));
    counts->alarmed = static_cast<std::uint16_t>(counts->alarmed + (state == LimitState::kAlarm ? 1 : 0));
    if (!changed) continue;
    if (state == LimitState::kAlarm) events_.raise<kLimitAlarm>(tick, limit.id, limit.channel, value);
    if (state == LimitState::kWarning) events_.raise<kLimitWarning>(tick, limit.id, limit.channel, value);
    if (state == LimitState::kInside) events_.raise<kLimitInside>(tick, limit.id, limit.channel, value);
  }
}

}  // namespace omma
