#include "components/telemetry/mcap_reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <type_traits>

#include "components/telemetry/mcap_format.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/services/crc32.hpp"

namespace omma::mcap {
namespace {

// More than any recorder puts into one chunk; a damaged length must not ask for all memory.
constexpr std::uint64_t kMostChunkBytes = 256U << 20;
constexpr std::uint64_t kSmallestMessage = 22;

/// Takes numbers and texts off the front of some bytes; false ever after once they did not suffice.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    std::uint64_t value = 0;
    const std::span<const std::byte> raw = take(sizeof(Number));
    for (std::size_t i = 0; i < raw.size(); ++i) value |= std::to_integer<std::uint64_t>(raw[i]) << (8 * i);
    return static_cast<Number>(value);
  }
  std::string text() {
    const std::span<const std::byte> raw = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }
  std::span<const std::byte> take(std::uint64_t count) {
    if (count > bytes_.size()) {
      good_ = false;
      bytes_ = {};
      return {};
    }
    const std::span<const std::byte> front = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return front;
  }
  bool good() const { return good_; }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  bool good_ = true;
};

struct RecordView {
  std::uint8_t opcode = 0;
  std::span<const std::byte> content;
};

std::optional<RecordView> next_record(Cursor& cursor) {
  RecordView record;
  record.opcode = cursor.number<std::uint8_t>();
  record.content = cursor.take(cursor.number<std::uint64_t>());
  if (!cursor.good()) return std::nullopt;
  return record;
}

MessageView message_of(std::span<const std::byte> content) {
  Cursor fields(content);
  MessageView message;
  message.channel = fields.number<std::uint16_t>();
  message.sequence = fields.number<std::uint32_t>();
  message.log_time_ns = static_cast<std::int64_t>(fields.number<std::uint64_t>());
  message.publish_time_ns = static_cast<std::int64_t>(fields.number<std::uint64_t>());
  message.data = fields.take(fields.left());
  return message;
}

bool is(std::uint8_t opcode, Opcode wanted) {
  return opcode == static_cast<std::uint8_t>(wanted);
}

}  // namespace

Reader::Reader(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "rbe")) {
  if (!file_) throw InputError(path, 0, "recording", "a file that can be read", std::strerror(errno));
  if (fseeko(file_.get(), 0, SEEK_END) != 0 || ftello(file_.get()) < 0) {
    throw InputError(path, 0, "recording", "an MCAP file", "something that cannot be read");
  }
  size_ = static_cast<std::uint64_t>(ftello(file_.get()));
  const std::vector<std::byte> magic = bytes_at(0, kMagic.size());
  if (magic.size() < kMagic.size() || std::memcmp(magic.data(), kMagic.data(), kMagic.size()) != 0) {
    throw InputError(path, 0, "recording", "an MCAP file",
                     size_ == 0 ? "an empty file" : "other first bytes");
  }
  if (!read_index()) {
    schemas_.clear();
    channels_.clear();
    chunks_.clear();
    walk_records();
  }
}

std::vector<std::byte> Reader::bytes_at(std::uint64_t offset, std::uint64_t length) const {
  if (offset > size_ || length > size_ - offset) return {};
  std::vector<std::byte> bytes(length);
  if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0) return {};
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file_.get()));
  return bytes;
}

void Reader::note_damage(const std::string& sentence) {
  if (damage_.empty()) damage_ = path_ + ": " + sentence;
}

bool Reader::add_definition(std::uint8_t opcode, std::span<const std::byte> content) {
  Cursor cursor(content);
  if (is(opcode, Opcode::kSchema)) {
    const auto id = cursor.number<std::uint16_t>();
    Schema schema{cursor.text(), cursor.text(), cursor.text()};
    if (!cursor.good()) return false;
    schemas_[id] = std::move(schema);
  } else if (is(opcode, Opcode::kChannel)) {
    Channel channel;
    channel.id = cursor.number<std::uint16_t>();
    channel.schema = cursor.number<std::uint16_t>();
    channel.topic = cursor.text();
    channel.encoding = cursor.text();
    if (!cursor.good()) return false;
    channels_[channel.id] = std::move(channel);
  }
  return true;
}

bool Reader::read_index() {
  const std::uint64_t tail_bytes = kRecordHeadBytes + kFooterBytes + kMagic.size();
  if (size_ < tail_bytes + kMagic.size()) return false;
  const std::vector<std::byte> tail = bytes_at(size_ - tail_bytes, tail_bytes);
  if (tail.size() != tail_bytes ||
      std::memcmp(tail.data() + tail_bytes - kMagic.size(), kMagic.data(), kMagic.size()) != 0) {
    return false;
  }
  Cursor footer(std::span<const std::byte>(tail).subspan(kRecordHeadBytes));
  const auto summary_start = footer.number<std::uint64_t>();
  footer.number<std::uint64_t>();
  const auto checksum = footer.number<std::uint32_t>();
  const std::uint64_t checked_end = size_ - kMagic.size() - 4;
  if (summary_start < kMagic.size() || summary_start >= checked_end) return false;
  const std::vector<std::byte> summary = bytes_at(summary_start, checked_end - summary_start);
  if (summary.size() != checked_end - summary_start) return false;
  if (checksum != 0 && crc32(summary) != checksum) return false;

  constexpr std::size_t kFooterChecked = kRecordHeadBytes + kFooterBytes - 4;
  if (summary.size() < kFooterChecked) return false;
  Cursor cursor(std::span<const std::byte>(summary).first(summary.size() - kFooterChecked));
  while (cursor.left() > 0) {
    const std::optional<RecordView> record = next_record(cursor);
    if (!record || !add_definition(record->opcode, record->content)) return false;
    if (!is(record->opcode, Opcode::kChunkIndex)) continue;
    Cursor index(record->content);
    index.take(16);  // first and last time
    Chunk chunk;
    chunk.offset = index.number<std::uint64_t>() + kRecordHeadBytes;
    const auto length = index.number<std::uint64_t>();
    Cursor offsets(index.take(index.number<std::uint32_t>()));
    if (!index.good() || length < kRecordHeadBytes) return false;
    chunk.length = length - kRecordHeadBytes;
    while (offsets.left() >= 10) {
      chunk.channels.push_back(offsets.number<std::uint16_t>());
      offsets.number<std::uint64_t>();
    }
    chunk.channels_known = true;
    chunks_.push_back(std::move(chunk));
  }
  // A file without chunk indexes may still hold messages.
  return !chunks_.empty();
}

void Reader::walk_records() {
  std::uint64_t at = kMagic.size();
  while (true) {
    const std::vector<std::byte> head = bytes_at(at, std::min<std::uint64_t>(kRecordHeadBytes, size_ - at));
    if (head.size() < kRecordHeadBytes) break;
    Cursor cursor(head);
    const auto opcode = cursor.number<std::uint8_t>();
    const auto length = cursor.number<std::uint64_t>();
    if (is(opcode, Opcode::kDataEnd) && length == 4) {
      const std::vector<std::byte> tail = bytes_at(size_ - kMagic.size(), kMagic.size());
      const bool ended =
          tail.size() == kMagic.size() && std::memcmp(tail.data(), kMagic.data(), kMagic.size()) == 0;
      if (!ended)
        note_damage("the recording's last bytes are missing; all its chunks are there");
      else if (!chunks_.empty())
        note_damage("the summary is damaged; the chunks are read without it");
      return;
    }
    const std::uint64_t content = at + kRecordHeadBytes;
    if (length > size_ - content) break;
    if (is(opcode, Opcode::kChunk)) {
      chunks_.push_back({content, length, {}, false, {}});
    } else if (is(opcode, Opcode::kMessage)) {
      if (chunks_.empty() || chunks_.back().loose.empty()) chunks_.emplace_back();
      const std::vector<std::byte> record = bytes_at(at, kRecordHeadBytes + length);
      chunks_.back().loose.insert(chunks_.back().loose.end(), record.begin(), record.end());
    } else if (is(opcode, Opcode::kSchema) || is(opcode, Opcode::kChannel)) {
      if (!add_definition(opcode, bytes_at(content, length))) {
        note_damage("a damaged record at byte " + std::to_string(at));
      }
    } else if (opcode == 0 || opcode > static_cast<std::uint8_t>(Opcode::kDataEnd)) {
      break;
    }
    at = content + length;
  }
  note_damage("the recording is cut off or damaged at byte " + std::to_string(at) + " of " +
              std::to_string(size_) + "; the " + std::to_string(chunks_.size()) +
              " chunks before that are read");
}

bool Reader::unpack(const Chunk& chunk) {
  unpacked_.reset();
  if (!chunk.loose.empty()) {
    records_ = chunk.loose;
    return true;
  }
  const std::vector<std::byte> content = bytes_at(chunk.offset, chunk.length);
  Cursor cursor(content);
  cursor.take(16);
  const auto size = cursor.number<std::uint64_t>();
  const auto checksum = cursor.number<std::uint32_t>();
  const std::string compression = cursor.text();
  const std::span<const std::byte> payload = cursor.take(cursor.number<std::uint64_t>());
  if (content.size() != chunk.length || !cursor.good() || size > kMostChunkBytes) return false;
  if (compression == "zstd") {
    records_.resize(size);
    const std::size_t got = ZSTD_decompress(records_.data(), records_.size(), payload.data(), payload.size());
    if (ZSTD_isError(got) != 0 || got != size) return false;
  } else if (compression.empty() && payload.size() == size) {
    records_.assign(payload.begin(), payload.end());
  } else if (compression == "lz4") {
    throw InputError(path_, 0, "chunk", "no compression or zstd (mcap compress --compression zstd)",
                     compression);
  } else {
    return false;
  }
  return checksum == 0 || crc32(records_) == checksum;
}

void Reader::for_each_message(const std::function<bool(const Channel&)>& wanted,
                              const std::function<bool(const MessageView&)>& take) {
  std::map<std::uint16_t, bool> answers;
  auto is_wanted = [&](std::uint16_t id) {
    const auto known = channels_.find(id);
    if (known == channels_.end()) return false;
    const auto [answer, fresh] = answers.try_emplace(id, false);
    if (fresh) answer->second = wanted(known->second);
    return answer->second;
  };
  for (const Chunk& chunk : chunks_) {
    if (chunk.channels_known && std::none_of(chunk.channels.begin(), chunk.channels.end(), is_wanted))
      continue;
    if (!unpack(chunk)) {
      note_damage("the chunk at byte " + std::to_string(chunk.offset - kRecordHeadBytes) +
                  " is damaged and left out");
      continue;
    }
    Cursor cursor(records_);
    while (cursor.left() > 0) {
      const std::size_t offset = records_.size() - cursor.left();
      const std::optional<RecordView> record = next_record(cursor);
      if (!record || !add_definition(record->opcode, record->content)) {
        note_damage("a record in the chunk at byte " + std::to_string(chunk.offset - kRecordHeadBytes) +
                    " is damaged; the rest of that chunk is left out");
        break;
      }
      if (!is(record->opcode, Opcode::kMessage) || record->content.size() < kSmallestMessage) continue;
      MessageView message = message_of(record->content);
      message.chunk = static_cast<std::size_t>(&chunk - chunks_.data());
      message.offset = offset;
      if (is_wanted(message.channel) && !take(message)) return;
    }
  }
}

std::optional<MessageView> Reader::message_at(std::size_t chunk, std::size_t offset) {
  if (unpacked_ != chunk) {
    if (chunk >= chunks_.size() || !unpack(chunks_[chunk])) return std::nullopt;
    unpacked_ = chunk;
  }
  if (offset >= records_.size()) return std::nullopt;
  Cursor cursor(std::span<const std::byte>(records_).subspan(offset));
  const std::optional<RecordView> record = next_record(cursor);
  if (!record || !is(record->opcode, Opcode::kMessage) || record->content.size() < kSmallestMessage)
    return std::nullopt;
  MessageView message = message_of(record->content);
  message.chunk = chunk;
  message.offset = offset;
  return message;
}

}  // namespace omma::mcap
