// The commands of the Maestro as bytes, and its error bits as words.
#include "hal/maestro/maestro_protocol.hpp"

#include <string_view>

namespace omma::maestro {

Message encode(Command command, int device, int channel, std::uint16_t value) noexcept {
  Message message;
  const auto append = [&message](unsigned byte) {
    message.bytes[message.size++] = static_cast<std::uint8_t>(byte);
  };
  const auto code = static_cast<unsigned>(command);
  if (device < 0) {
    append(code);
  } else {
    append(0xAA);
    append(static_cast<unsigned>(device) & 0x7FU);
    append(code & 0x7FU);
  }
  switch (command) {
    case Command::kSetTarget:
    case Command::kSetSpeed:
    case Command::kSetAcceleration:
      append(static_cast<unsigned>(channel));
      append(value & 0x7FU);
      append((value >> 7U) & 0x7FU);
      break;
    case Command::kGetPosition:
      append(static_cast<unsigned>(channel));
      break;
    case Command::kGetErrors:
    case Command::kGoHome:
      break;
  }
  return message;
}

std::string error_names(std::uint16_t errors) {
  static constexpr std::array<std::string_view, 9> kNames = {
      "serial signal",   "serial overrun", "serial buffer full", "serial CRC",    "serial protocol",
      "serial time-out", "script stack",   "script call stack",  "script counter"};
  std::string names;
  for (std::size_t bit = 0; bit < kNames.size(); ++bit) {
    if ((errors >> bit & 1U) == 0) continue;
    if (!names.empty()) names += ", ";
    names += kNames[bit];
  }
  return names.empty() ? "none" : names;
}

}  // namespace omma::maestro
