// The frame-sync pulse on a line of a GPIO chip, through libgpiod. Debian 12 has version 1 of its interface;
// version 2 (libgpiod 2.0, Debian 13) names everything anew: gpiod_trigger.cpp is the one file that includes
// it.
//
// The leading edge is made by who calls `pulse` (one system call; on a chip behind a slow bus, as I2C, that
// call sleeps: such chips are no frame sync). The other edge is PulseEnd's.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

#include "hal/pulse_end.hpp"
#include "hal/trigger.hpp"

struct gpiod_chip;
struct gpiod_line;

namespace omma {

struct GpiodOptions {
  std::string chip;  ///< "gpiochip0", a path, or the chip's label
  std::string line;  ///< its number on the chip, or its name
  TriggerPulse pulse;
  int priority = 0;  ///< of the thread that ends the pulses
};

class GpiodTrigger final : public TriggerDriver {
 public:
  /// Takes the line as an output, at rest.
  /// @throws InputError: no such chip, no such line, a line that is in use, or no right to it
  explicit GpiodTrigger(const GpiodOptions& options);
  /// Leaves the line at rest.
  ~GpiodTrigger() override;
  GpiodTrigger(const GpiodTrigger&) = delete;
  GpiodTrigger& operator=(const GpiodTrigger&) = delete;

  std::string_view driver_name() const override { return "gpiod"; }
  std::optional<TimeNs> pulse(std::uint64_t number, TimeNs due_ns) noexcept override;
  void attend() noexcept override;
  std::vector<std::string> complaints() const override;
  bool connected() const noexcept { return connected_.load(std::memory_order_acquire); }

 private:
  /// Where the line could not be had: which field of the options is to blame, and why.
  struct Fault {
    std::string_view field;
    std::string_view expected;
    std::string found;
  };
  std::optional<Fault> open();
  void close() noexcept;
  bool set(bool active) noexcept;

  GpiodOptions options_;
  gpiod_chip* chip_ = nullptr;
  gpiod_line* line_ = nullptr;
  std::atomic<bool> connected_{false};
  std::atomic<std::uint64_t> times_lost_{0};
  std::atomic<std::uint64_t> not_sent_{0};
  std::atomic<std::uint64_t> overlapped_{0};
  PulseEnd end_;  // last: its thread uses what is above
};

}  // namespace omma
