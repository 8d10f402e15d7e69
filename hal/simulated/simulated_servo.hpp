// A servo board that is not there: takes every command that a board of so many channels would take. Under the
// name "recorded" the gimbal moved when the frames were recorded, and what it is told now goes nowhere.
#pragma once

#include <array>
#include <cstddef>

#include "hal/servo.hpp"

namespace omma {

class SimulatedServo final : public ServoDriver {
 public:
  explicit SimulatedServo(std::string_view name = "simulated") : name_(name) {}
  std::string_view driver_name() const override { return name_; }
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
  std::string_view name_;
  std::array<QuarterMicroseconds, kChannels> targets_{};
};

}  // namespace omma
