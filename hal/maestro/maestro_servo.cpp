// The serial line of a Maestro: raw bytes, never waited for but for an answer.
#include "hal/maestro/maestro_servo.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "fsw/kernel/input_error.hpp"

namespace omma {

using maestro::Command;

MaestroServo::MaestroServo(MaestroOptions options) : options_(std::move(options)) {
  const auto hold = [this](int value, int low, int high, std::string_view field, std::string_view expected) {
    if (value < low || value > high)
      throw InputError(options_.device, 0, field, expected, std::to_string(value));
  };
  hold(options_.number, -1, 127, "number", "0 to 127, or -1 for the compact protocol");
  hold(options_.channels, 1, maestro::kMaxChannels, "channels", "1 to 24");
  hold(options_.timeout_ms, 1, 1000, "timeout", "1 to 1000 ms");
  if (!connect())
    throw InputError(options_.device, 0, "device", "the serial line of a Maestro", std::strerror(errno));
}

MaestroServo::~MaestroServo() {
  if (const int file = file_.load(); file >= 0) ::close(file);
}

bool MaestroServo::connect() noexcept {
  if (connected()) return true;
  if (const int file = file_.exchange(-1); file >= 0) ::close(file);
  const int file = ::open(options_.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  termios line{};
  if (::tcgetattr(file, &line) == 0) {
    ::cfmakeraw(&line);
    line.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    if (::tcsetattr(file, TCSANOW, &line) == 0) {
      ::tcflush(file, TCIOFLUSH);
      file_ = file;
      connected_.store(true, std::memory_order_release);
      return true;
    }
  }
  const int reason = errno;
  ::close(file);
  errno = reason;
  return false;
}

bool MaestroServo::send(Command command, int channel, std::uint16_t value) noexcept {
  const maestro::Message message = maestro::encode(command, options_.number, channel, value);
  if (connected()) {
    const ssize_t written = ::write(file_, message.bytes.data(), message.size);
    if (written == static_cast<ssize_t>(message.size)) return true;
    // A full line may take the next command; after half a command, or any other error, nothing is sure.
    if (written >= 0 || errno != EAGAIN) {
      times_lost_.fetch_add(1, std::memory_order_relaxed);
      give_up();
    }
  }
  lost_.fetch_add(1, std::memory_order_relaxed);
  return false;
}

std::optional<std::uint16_t> MaestroServo::ask(Command command, int channel) noexcept {
  using Clock = std::chrono::steady_clock;
  if (!connected()) return std::nullopt;
  ::tcflush(file_, TCIFLUSH);  // an answer that came too late belongs to an older question
  if (!send(command, channel)) return std::nullopt;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(options_.timeout_ms);
  std::array<std::uint8_t, 2> answer{};
  std::size_t size = 0;
  while (size < answer.size()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd wait{file_, POLLIN, 0};
    if (left <= 0 || ::poll(&wait, 1, static_cast<int>(left)) <= 0) return std::nullopt;
    const ssize_t got = ::read(file_, answer.data() + size, answer.size() - size);
    if (got <= 0) {
      if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      times_lost_.fetch_add(1, std::memory_order_relaxed);
      give_up();
      return std::nullopt;
    }
    size += static_cast<std::size_t>(got);
  }
  return static_cast<std::uint16_t>(answer[0] | answer[1] << 8U);
}

bool MaestroServo::set_target(int channel, QuarterMicroseconds pulse) noexcept {
  return valid(channel) && pulse <= maestro::kLargestValue && send(Command::kSetTarget, channel, pulse);
}

bool MaestroServo::set_speed(int channel, std::uint16_t speed) noexcept {
  return valid(channel) && speed <= maestro::kLargestValue && send(Command::kSetSpeed, channel, speed);
}

bool MaestroServo::set_acceleration(int channel, std::uint16_t acceleration) noexcept {
  return valid(channel) && acceleration <= 255 && send(Command::kSetAcceleration, channel, acceleration);
}

bool MaestroServo::stop() noexcept {
  bool all = true;
  for (int channel = 0; channel < options_.channels; ++channel)
    all = send(Command::kSetTarget, channel, 0) && all;
  return all;
}

bool MaestroServo::go_home() noexcept {
  return send(Command::kGoHome);
}

std::optional<QuarterMicroseconds> MaestroServo::position(int channel) noexcept {
  return valid(channel) ? ask(Command::kGetPosition, channel) : std::nullopt;
}

std::optional<std::uint16_t> MaestroServo::errors() noexcept {
  return ask(Command::kGetErrors);
}

void MaestroServo::attend() noexcept {
  if (!connected()) {
    // Another thread may have been in the middle of a command when it was given up; by the next time it has
    // long ended.
    if (std::exchange(given_up_before_, true)) connect();
    return;
  }
  given_up_before_ = false;
  const std::optional<std::uint16_t> bits = errors();
  if (!bits) unanswered_.fetch_add(1, std::memory_order_relaxed);
  for (std::size_t bit = 0; bit < errors_.size(); ++bit)
    if ((bits.value_or(0) >> bit & 1U) != 0) errors_[bit].fetch_add(1, std::memory_order_relaxed);
}

std::vector<std::string> MaestroServo::complaints() const {
  std::vector<std::string> sentences;
  const auto say = [&](std::uint64_t count, std::string_view what) {
    if (count > 0)
      sentences.push_back(options_.device + ": " + std::string(what) + ", " + std::to_string(count) +
                          " times");
  };
  say(times_lost_, "the board was lost");
  say(lost_, "the line did not take a command");
  say(unanswered_, "the board did not tell its errors in time");
  for (std::size_t bit = 0; bit < errors_.size(); ++bit)
    say(errors_[bit], "board error '" + std::string(maestro::kErrorNames[bit]) + "'");
  return sentences;
}

}  // namespace omma
