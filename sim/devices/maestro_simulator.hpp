// A Maestro that speaks both protocols on a serial line of its own: a pseudo-terminal, or a device such as
// the gadget's end of a USB serial line. The driver opens the other end as it would a board's.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace omma {

struct SerialDevice {
  std::string path;  ///< e.g. /dev/ttyGS0
};

class MaestroSimulator {
 public:
  /// Answers on a device that is there. @throws InputError: no such serial line
  explicit MaestroSimulator(SerialDevice device, int number = 12);
  /// Makes `link` point at its line and answers as device `number` in Pololu's protocol.
  explicit MaestroSimulator(std::string link, int number = 12);
  /// Unplugs the board.
  ~MaestroSimulator();
  MaestroSimulator(const MaestroSimulator&) = delete;
  MaestroSimulator& operator=(const MaestroSimulator&) = delete;

  std::uint16_t target(int channel) const { return targets_.at(static_cast<std::size_t>(channel)); }
  std::uint16_t speed(int channel) const { return speeds_.at(static_cast<std::size_t>(channel)); }
  std::uint16_t acceleration(int channel) const {
    return accelerations_.at(static_cast<std::size_t>(channel));
  }
  int homes() const { return homes_; }
  std::uint64_t commands() const { return commands_; }  ///< heard, all kinds
  bool has_errors() const { return errors_ != 0; }      ///< not asked for yet
  void set_errors(std::uint16_t errors) { errors_ = errors; }
  void mute(bool on) { mute_ = on; }  ///< takes commands, answers nothing

 private:
  using Values = std::array<std::atomic<std::uint16_t>, 24>;
  void run();
  bool next(std::uint8_t& byte);
  void obey(std::uint8_t command);
  void set(Values& values);
  void answer(std::uint16_t value);

  std::string link_;
  int number_;
  int file_ = -1;
  int line_ = -1;
  Values targets_{}, speeds_{}, accelerations_{};
  std::atomic<int> homes_{0};
  std::atomic<std::uint64_t> commands_{0};
  std::atomic<std::uint16_t> errors_{0};
  std::atomic<bool> mute_{false}, ends_{false};
  std::thread thread_;
};

}  // namespace omma
