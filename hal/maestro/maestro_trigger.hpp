// The frame-sync pulse on a channel of a Maestro that is set up as a digital output: high from 1500 us on,
// low below (User's Guide, section 4.a). The board may move servos at the same time. A command takes about
// half a millisecond on its way, so the width is kept to that.
#pragma once

#include <atomic>

#include "hal/maestro/maestro_servo.hpp"
#include "hal/pulse_end.hpp"
#include "hal/trigger.hpp"

namespace omma {

class MaestroTrigger final : public TriggerDriver {
 public:
  /// @param board    outlives this object; who owns it attends to it
  /// @param channel  of the board, set up as an output
  MaestroTrigger(MaestroServo& board, int channel, TriggerPulse pulse, int priority);
  ~MaestroTrigger() override;
  MaestroTrigger(const MaestroTrigger&) = delete;
  MaestroTrigger& operator=(const MaestroTrigger&) = delete;

  std::string_view driver_name() const override { return "maestro"; }
  /// The edge is dated when its command is handed to the line.
  std::optional<TimeNs> pulse(std::uint64_t number, TimeNs due_ns) noexcept override;
  std::vector<std::string> complaints() const override;

 private:
  bool set(bool active) noexcept;

  MaestroServo& board_;
  int channel_;
  TriggerPulse pulse_;
  std::atomic<std::uint64_t> not_sent_{0};
  PulseEnd end_;  // last: its thread uses what is above
};

}  // namespace omma
