// A servo board that is not there: takes every command that a board of so many channels would take.
#pragma once

#include <array>
#include <cstddef>

#include "hal/servo.hpp"

namespace omma {

class SimulatedServo final : public ServoDriver {
 public:
  std::string_view driver_name() const override { return "simulated"; }
  bool set_target(int channel, QuarterMicroseconds pulse) noexcept override {
    if (channel < 0 || channel >= kChannels) return false;
    targets_[static_cast<std::size_t>(channel)] = pulse;
    return true;
  }
  bool stop() noexcept override {
    targets_.fill(0);
    return true;
  }
  QuarterMicroseconds target(int channel) const { return targets_[static_cast<std::size_t>(channel)]; }

 private:
  static constexpr int kChannels = 24;
  std::array<QuarterMicroseconds, kChannels> targets_{};
};

}  // namespace omma
