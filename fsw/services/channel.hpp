// Telemetry channels: single numbers of the frame set, which limits, fault rules and modes look at. Each is
// declared once, as a constant beside the component that fills it in.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "config/service_limits.hpp"
#include "fsw/kernel/tick.hpp"
#include "fsw/services/descriptors.hpp"

namespace omma {

struct ChannelDescriptor {
  std::uint16_t id = 0;     ///< 1 … limits::kChannelIds − 1, unique in the program
  std::string_view name;    ///< "attitude.residual", unique in the program
  std::string_view unit{};  ///< empty: a count or a state
  std::string_view text{};  ///< what it is
};

constexpr bool is_well_formed(const ChannelDescriptor& channel) {
  return channel.id > 0 && channel.id < limits::kChannelIds && !channel.name.empty() && !channel.text.empty();
}

struct ChannelValues {
  std::uint64_t tick = 0;
  TimeNs time_ns = 0;
  std::array<double, limits::kChannelIds> values = unknown();  ///< NaN: not known in this frame set

  double& operator[](const ChannelDescriptor& channel) noexcept { return values[channel.id]; }
  double operator[](const ChannelDescriptor& channel) const noexcept { return values[channel.id]; }

 private:
  static constexpr std::array<double, limits::kChannelIds> unknown() {
    std::array<double, limits::kChannelIds> all{};
    all.fill(std::numeric_limits<double>::quiet_NaN());
    return all;
  }
};

enum class Comparison : std::uint8_t { kBelow, kAbove, kEqual };

/// A channel against a number, so many beats in a row.
struct Condition {
  std::uint16_t channel = 0;  ///< id; 0: it always holds
  Comparison comparison = Comparison::kAbove;
  double value = 0;
  std::uint32_t beats = 1;

  /// In this beat. What is not known does not hold.
  constexpr bool holds(const ChannelValues& values) const noexcept {
    if (channel == 0) return true;
    const double present = values.values[channel];
    switch (comparison) {
      case Comparison::kBelow:
        return present < value;
      case Comparison::kAbove:
        return present > value;
      case Comparison::kEqual:
        return present == value;
    }
    return false;
  }
};

constexpr bool is_well_formed(const Condition& condition) {
  return condition.channel < limits::kChannelIds && condition.beats > 0 && condition.value == condition.value;
}

/// Counts beats in a row.
class Persistence {
 public:
  /// True from the `beats`-th beat in a row on.
  constexpr bool after(bool holds, std::uint32_t beats) noexcept {
    count_ = holds ? (count_ < beats ? count_ + 1 : count_) : 0;
    return holds && count_ >= beats;
  }
  constexpr void reset() noexcept { count_ = 0; }

 private:
  std::uint32_t count_ = 0;
};

}  // namespace omma
