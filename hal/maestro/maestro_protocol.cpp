// The commands of the Maestro as bytes, and its error bits as words.
#include "hal/maestro/maestro_protocol.hpp"

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
  std::string names;
  for (std::size_t bit = 0; bit < kErrorNames.size(); ++bit) {
    if ((errors >> bit & 1U) == 0) continue;
    if (!names.empty()) names += ", ";
    names += kErrorNames[bit];
  }
  return names.empty() ? "none" : names;
}

}  // namespace omma::maestro
