#include "components/telemetry/cdr.hpp"

#include <dds/ddsi/ddsi_cdrstream.h>

#include <new>

namespace omma::telemetry {
namespace {

constexpr std::uint32_t kXcdr1 = 1;
constexpr std::size_t kHeaderBytes = 4;
constexpr std::byte kLittleEndianCdr{1};

bool is_little_endian_xcdr1(std::span<const std::byte> cdr) noexcept {
  return cdr.size() >= kHeaderBytes && cdr[0] == std::byte{0} && cdr[1] == kLittleEndianCdr;
}

template <class Number>
Number number_at(std::span<const std::byte> cdr, std::size_t offset) noexcept {
  Number value;
  std::memcpy(&value, cdr.data() + offset, sizeof value);
  return value;
}

}  // namespace

CdrWriter::CdrWriter() : stream_(new dds_ostream) {
  dds_ostream_init(stream_, 4096, kXcdr1);
}

CdrWriter::~CdrWriter() {
  dds_ostream_fini(stream_);
  delete stream_;
}

std::span<const std::byte> CdrWriter::write(TopicId id, const void* sample) {
  // Cyclone aligns against the start of its buffer, CDR against the end of the header: so the header is kept
  // in the first eight bytes, of which the last four are used.
  static constexpr std::uint32_t kBodyOffset = 8;
  std::memset(stream_->m_buffer, 0, kBodyOffset);
  stream_->m_index = kBodyOffset;
  auto* little = reinterpret_cast<dds_ostreamLE_t*>(stream_);
  if (dds_stream_writeLE(little, static_cast<const char*>(sample), topic(id).descriptor->m_ops) == nullptr) {
    dds_ostream_init(stream_, 4096, kXcdr1);  // Cyclone has freed the buffer of what it could not write
    return {};
  }
  // The body ends on a multiple of four; the header's last two bits say how much of that is padding.
  std::uint32_t size = stream_->m_index;
  const std::uint32_t padding = (4 - size % 4) % 4;
  for (std::uint32_t i = 0; i < padding; ++i) {
    // There is room: the buffer grows by more than it must, and begins at a multiple of four.
    stream_->m_buffer[size++] = 0;
  }
  unsigned char* header = stream_->m_buffer + kBodyOffset - kHeaderBytes;
  header[1] = static_cast<unsigned char>(kLittleEndianCdr);
  header[3] = static_cast<unsigned char>(padding);
  return {reinterpret_cast<const std::byte*>(header), size - kBodyOffset + kHeaderBytes};
}

bool read_head(std::span<const std::byte> cdr, SampleHead& head) noexcept {
  if (cdr.size() < kHeaderBytes + 21 || !is_little_endian_xcdr1(cdr)) return false;
  head.frame = number_at<std::uint64_t>(cdr, kHeaderBytes);
  head.time_ns = number_at<std::int64_t>(cdr, kHeaderBytes + 8);
  head.sample_number = number_at<std::uint32_t>(cdr, kHeaderBytes + 16);
  head.valid = cdr[kHeaderBytes + 20] != std::byte{0};
  return true;
}

CdrReader::CdrReader(TopicId id) : id_(id), sample_((topic(id).descriptor->m_size + 7) / 8, 0) {}

CdrReader::~CdrReader() {
  dds_stream_free_sample(sample_.data(), topic(id_).descriptor->m_ops);
}

const void* CdrReader::read(std::span<const std::byte> cdr) {
  if (!is_little_endian_xcdr1(cdr)) return nullptr;
  const std::size_t size = cdr.size() - kHeaderBytes;
  const std::size_t padding = std::to_integer<std::size_t>(cdr[3]) & 3U;
  if (padding >= size) return nullptr;
  bytes_.assign((size + 7) / 8, 0);
  std::memcpy(bytes_.data(), cdr.data() + kHeaderBytes, size);
  const std::uint32_t* operations = topic(id_).descriptor->m_ops;
  std::uint32_t end = 0;
  const auto body = static_cast<std::uint32_t>(size - padding);
  if (dds_stream_normalize_data(reinterpret_cast<char*>(bytes_.data()), &end, body, false, kXcdr1,
                                operations) == nullptr ||
      end != body) {
    return nullptr;
  }
  dds_istream_t stream;
  dds_istream_init(&stream, body, bytes_.data(), kXcdr1);
  dds_stream_read(&stream, reinterpret_cast<char*>(sample_.data()), operations);
  return sample_.data();
}

}  // namespace omma::telemetry
