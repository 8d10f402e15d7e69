// The board's side of the protocol, written from the guide and not from the driver's encoder.
#include "sim/devices/maestro_simulator.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "fsw/kernel/input_error.hpp"

namespace omma {

namespace {

bool make_raw(int file) {
  termios line{};
  if (::tcgetattr(file, &line) != 0) return false;
  ::cfmakeraw(&line);
  return ::tcsetattr(file, TCSANOW, &line) == 0;
}

}  // namespace

MaestroSimulator::MaestroSimulator(SerialDevice device, int number) : number_(number) {
  file_ = ::open(device.path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (file_ < 0 || !make_raw(file_))
    throw InputError(device.path, 0, "device", "a serial line", std::strerror(errno));
  thread_ = std::thread([this] { run(); });
}

MaestroSimulator::MaestroSimulator(std::string link, int number) : link_(std::move(link)), number_(number) {
  file_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (file_ < 0 || ::grantpt(file_) != 0 || ::unlockpt(file_) != 0) throw std::runtime_error("no pty");
  std::array<char, 64> name{};
  if (::ptsname_r(file_, name.data(), name.size()) != 0) throw std::runtime_error("pty without a name");
  // Held open, so that the line stays up before the driver comes and is raw from the start.
  line_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  make_raw(line_);
  std::filesystem::remove(link_);
  std::filesystem::create_symlink(name.data(), link_);
  thread_ = std::thread([this] { run(); });
}

MaestroSimulator::~MaestroSimulator() {
  ends_ = true;
  thread_.join();
  if (!link_.empty()) std::filesystem::remove(link_);
  if (line_ >= 0) ::close(line_);
  ::close(file_);
}

bool MaestroSimulator::next(std::uint8_t& byte) {
  while (!ends_) {
    pollfd wait{file_, POLLIN, 0};
    if (::poll(&wait, 1, 5) <= 0) continue;
    if (::read(file_, &byte, 1) == 1) return true;
    ::usleep(5000);  // nobody at the other end
  }
  return false;
}

void MaestroSimulator::run() {
  std::uint8_t byte = 0;
  while (next(byte)) {
    if (byte == 0xAA) {
      std::uint8_t number = 0;
      std::uint8_t command = 0;
      if (next(number) && next(command) && number == number_) obey(static_cast<std::uint8_t>(command | 0x80));
    } else {
      obey(byte);
    }
  }
}

void MaestroSimulator::set(Values& values) {
  std::uint8_t channel = 0;
  std::uint8_t low = 0;
  std::uint8_t high = 0;
  if (!next(channel) || !next(low) || !next(high)) return;
  if (channel >= values.size() || low > 127 || high > 127)
    errors_ = static_cast<std::uint16_t>(errors_ | 16U);
  else
    values[channel] = static_cast<std::uint16_t>(low + 128 * high);
}

void MaestroSimulator::answer(std::uint16_t value) {
  const std::array<std::uint8_t, 2> bytes = {static_cast<std::uint8_t>(value & 255U),
                                             static_cast<std::uint8_t>(value >> 8U)};
  if (!mute_ && ::write(file_, bytes.data(), bytes.size()) != 2) ends_ = true;
}

void MaestroSimulator::obey(std::uint8_t command) {
  std::uint8_t channel = 0;
  ++commands_;
  switch (command) {
    case 0x84:
      set(targets_);
      break;
    case 0x87:
      set(speeds_);
      break;
    case 0x89:
      set(accelerations_);
      break;
    case 0x90:
      if (next(channel)) answer(targets_.at(channel % 24U));
      break;
    case 0xA1:
      answer(errors_.exchange(0));
      break;
    case 0xA2:
      ++homes_;
      break;
    default:
      errors_ = static_cast<std::uint16_t>(errors_ | 16U);
      break;
  }
}

}  // namespace omma
