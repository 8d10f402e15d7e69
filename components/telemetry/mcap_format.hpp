// The MCAP container format (mcap.dev/spec, version 0): magic, opcodes, and the checksum it uses. Shared by
// the writer here and the ground's reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

namespace detail {
constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320U : 0U);
    table[i] = value;
  }
  return table;
}
}  // namespace detail

/// CRC-32 of IEEE 802.3 (the one of zlib). Continues from `before`, the checksum of the bytes so far.
constexpr std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  constexpr std::array<std::uint32_t, 256> kTable = detail::crc32_table();
  std::uint32_t value = ~before;
  for (const std::byte byte : bytes) {
    value = (value >> 8) ^ kTable[(value ^ std::to_integer<std::uint32_t>(byte)) & 0xFFU];
  }
  return ~value;
}

}  // namespace omma::mcap
