// The MCAP container format (mcap.dev/spec, version 0): magic, opcodes, sizes. Shared by the writer here
// and the ground's reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace omma::mcap {

inline constexpr std::array<unsigned char, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Opcode and length that lead every record [bytes].
inline constexpr std::size_t kRecordHeadBytes = 9;
inline constexpr std::size_t kFooterBytes = 20;

}  // namespace omma::mcap
