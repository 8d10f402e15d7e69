// The bytes of the serial commands of Pololu's Maestro servo boards, compact and Pololu protocol.
// Source: Pololu, Maestro Servo Controller User's Guide, chapter 5 (serial commands) and section 4.b
// (errors).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace omma::maestro {

inline constexpr int kMaxChannels = 24;                ///< of the largest board
inline constexpr std::uint16_t kLargestValue = 16383;  ///< two bytes of seven bits

enum class Command : std::uint8_t {
  kSetTarget = 0x84,        ///< channel, pulse [0.25 us]
  kSetSpeed = 0x87,         ///< channel, [0.25 us / 10 ms], 0: no limit
  kSetAcceleration = 0x89,  ///< channel, [0.25 us / 10 ms / 80 ms], at most 255, 0: no limit
  kGetPosition = 0x90,      ///< channel; answers two bytes, low first [0.25 us]
  kGetErrors = 0xA1,        ///< answers two bytes, low first, and clears the errors
  kGoHome = 0xA2,
};

/// One command as it goes on the wire.
struct Message {
  std::array<std::uint8_t, 6> bytes{};
  std::size_t size = 0;
  std::span<const std::uint8_t> span() const { return {bytes.data(), size}; }
};

/// The compact protocol where `device` is negative (one board on the line), else Pololu's: 0xAA, the device's
/// number 0 ... 127, the command without its highest bit. Channel and value are for the commands that take
/// them.
Message encode(Command command, int device, int channel = 0, std::uint16_t value = 0) noexcept;

/// What each error bit says, the lowest first.
inline constexpr std::array<std::string_view, 9> kErrorNames = {
    "serial signal",   "serial overrun", "serial buffer full", "serial CRC",    "serial protocol",
    "serial time-out", "script stack",   "script call stack",  "script counter"};

/// The names of the errors whose bits are set, joined by ", "; "none" where none is.
std::string error_names(std::uint16_t errors);

}  // namespace omma::maestro
