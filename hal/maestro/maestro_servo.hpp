// A Pololu Maestro on a serial device. Commands are written without waiting; questions wait for their answer
// no longer than the time-out. A board that is unplugged is noticed at the next command and comes back by
// attend(): from the first command it did not take until then the line belongs to the attending thread, so
// that neither waits for the other and closing the line, which may take seconds, holds up no command.
// Commands may come from several threads (servos, a trigger): each is one write.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/maestro/maestro_protocol.hpp"
#include "hal/servo.hpp"

namespace omma {

struct MaestroOptions {
  std::string device;   ///< e.g. /dev/ttyACM0
  int number = -1;      ///< of the board in Pololu's protocol, 0 ... 127; -1: the compact protocol
  int channels = 12;    ///< 6, 12, 18 or 24
  int timeout_ms = 20;  ///< of an answer
};

class MaestroServo final : public ServoDriver {
 public:
  /// Opens the device.
  /// @throws InputError: options out of range, or a device that is missing or no serial line
  explicit MaestroServo(MaestroOptions options);
  ~MaestroServo() override;
  MaestroServo(const MaestroServo&) = delete;
  MaestroServo& operator=(const MaestroServo&) = delete;

  std::string_view driver_name() const override { return "maestro"; }
  bool set_target(int channel, QuarterMicroseconds pulse) noexcept override;
  bool stop() noexcept override;
  bool set_speed(int channel, std::uint16_t speed) noexcept;                ///< unit: Command::kSetSpeed
  bool set_acceleration(int channel, std::uint16_t acceleration) noexcept;  ///< Command::kSetAcceleration
  bool go_home() noexcept;

  /// Where the board's pulse is now; nothing where no answer came in time.
  std::optional<QuarterMicroseconds> position(int channel) noexcept;
  /// The error bits since the last question (maestro::error_names says them).
  std::optional<std::uint16_t> errors() noexcept;

  bool connected() const noexcept { return connected_.load(std::memory_order_acquire); }
  std::uint64_t lost_commands() const noexcept { return lost_.load(); }  ///< not taken by the line
  /// Opens the device again after it was lost.
  /// @return true where it is open
  bool connect() noexcept;
  /// Opens a lost device; asks a connected board for its errors and counts them.
  void attend() noexcept override;
  std::vector<std::string> complaints() const override;

 private:
  bool valid(int channel) const noexcept { return channel >= 0 && channel < options_.channels; }
  bool send(maestro::Command command, int channel = 0, std::uint16_t value = 0) noexcept;
  std::optional<std::uint16_t> ask(maestro::Command command, int channel = 0) noexcept;
  /// Leaves the line to the attending thread.
  void give_up() noexcept { connected_.store(false, std::memory_order_release); }

  MaestroOptions options_;
  std::atomic<int> file_{-1};     // the commanding threads' while connected, else the attending thread's
  bool given_up_before_ = false;  // the attending thread found it so the last time
  std::atomic<bool> connected_{false};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<std::uint64_t> times_lost_{0};
  std::array<std::atomic<std::uint32_t>, maestro::kErrorNames.size()>
      errors_{};  // how often each bit was set
  std::atomic<std::uint32_t> unanswered_{0};
};

}  // namespace omma
