// Limits of channels, as data: warning and alarm, low and high. A channel changes its state after it was
// beyond a limit, or back by the hysteresis, so many beats in a row.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/channel.hpp"
#include "fsw/services/events.hpp"

namespace omma {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct LimitDescriptor {
  std::uint16_t id = 0;       ///< from 1, unique in the program
  std::string_view name;      ///< snake_case, unique in the program
  std::uint16_t channel = 0;  ///< id
  double alarm_low = -kNoLimit;
  double warning_low = -kNoLimit;
  double warning_high = kNoLimit;
  double alarm_high = kNoLimit;
  double hysteresis = 0;    ///< a limit is left only when the channel is back by so much
  std::uint32_t beats = 1;  ///< in a row, before the state changes
};

constexpr bool is_well_formed(const LimitDescriptor& limit) {
  return limit.id > 0 && !limit.name.empty() && limit.channel > 0 && limit.channel < limits::kChannelIds &&
         limit.beats > 0 && limit.hysteresis >= 0 && limit.alarm_low <= limit.warning_low &&
         limit.warning_low < limit.warning_high && limit.warning_high <= limit.alarm_high &&
         limit.warning_high - limit.warning_low > 2 * limit.hysteresis;
}

enum class LimitState : std::uint8_t { kInside, kWarning, kAlarm };

inline constexpr EventDescriptor kLimitWarning{
    .id = 64,
    .severity = EventSeverity::kWarning,
    .name = "limit_warning",
    .text = "limit {0}: channel {1} is at {2}, beyond its warning limit",
    .values = {{{"limit"}, {"channel"}, {"value"}}},
    .burst = 16};
inline constexpr EventDescriptor kLimitAlarm{
    .id = 65,
    .severity = EventSeverity::kFailure,
    .name = "limit_alarm",
    .text = "limit {0}: channel {1} is at {2}, beyond its alarm limit",
    .values = {{{"limit"}, {"channel"}, {"value"}}},
    .burst = 16};
inline constexpr EventDescriptor kLimitInside{.id = 66,
                                              .severity = EventSeverity::kActivity,
                                              .name = "limit_inside",
                                              .text = "limit {0}: channel {1} is back inside, at {2}",
                                              .values = {{{"limit"}, {"channel"}, {"value"}}},
                                              .burst = 16};
inline constexpr std::array kLimitEvents{kLimitWarning, kLimitAlarm, kLimitInside};
static_assert(are_unique(kLimitEvents) && are_well_formed(kLimitEvents));

/// How one limit stands; values in, state out.
class LimitJudge {
 public:
  /// @param value  NaN: not known; then nothing changes
  /// @return true when the state has changed
  bool judge(const LimitDescriptor& limit, double value) noexcept;
  LimitState state() const { return state_; }

 private:
  LimitState state_ = LimitState::kInside;
  LimitState next_ = LimitState::kInside;
  Persistence held_;
};

/// What telemetry tells of them.
struct LimitCounts {
  std::uint16_t warned = 0;
  std::uint16_t alarmed = 0;
  friend bool operator==(const LimitCounts&, const LimitCounts&) = default;
};

class LimitWatch final : public Component {
 public:
  /// @param watched  outlive this
  LimitWatch(std::span<const LimitDescriptor> watched, Events& events);

  In<ChannelValues> channels;
  Out<LimitCounts> counts;

  std::string_view name() const override { return "limit_watch"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  std::span<const LimitDescriptor> watched_;
  std::array<LimitJudge, limits::kLimits> judges_{};
  Events& events_;
};

}  // namespace omma
