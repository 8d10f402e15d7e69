#include "components/telemetry/mcap_writer.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/crc32.hpp"

namespace omma::mcap {
namespace {

using Bytes = std::vector<std::byte>;

// Little endian, as the format asks, on any machine.
template <class Number>
void put(Bytes& out, Number value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    out.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
}
void put_bytes(Bytes& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}
void put_text(Bytes& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  put_bytes(out, std::as_bytes(std::span(text)));
}

/// Writes the head of a record when it begins and its length when it ends.
class Record {
 public:
  Record(Bytes& out, Opcode opcode) : out_(out) {
    put(out_, static_cast<std::uint8_t>(opcode));
    put(out_, std::uint64_t{0});
    start_ = out_.size();
  }
  ~Record() {
    const std::uint64_t length = out_.size() - start_;
    for (std::size_t i = 0; i < 8; ++i) out_[start_ - 8 + i] = static_cast<std::byte>(length >> (8 * i));
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

 private:
  Bytes& out_;
  std::size_t start_;
};

}  // namespace

Writer::Writer(const std::string& path, const WriterOptions& options) : path_(path), options_(options) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) {
    throw InputError(path, 0, "recording", "a file that can be written", std::strerror(errno));
  }
  compressor_ = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(compressor_, ZSTD_c_compressionLevel, std::max(options.compression_level, 1));
  chunk_.reserve(options.chunk_bytes + options.chunk_bytes / 4);
  compressed_.resize(ZSTD_compressBound(chunk_.capacity()));
  out_.reserve(compressed_.size());
  put_bytes(out_, std::as_bytes(std::span(kMagic)));
  Record header(out_, Opcode::kHeader);
  put_text(out_, "");
  put_text(out_, "omma");
}

Writer::~Writer() {
  close();
  ZSTD_freeCCtx(compressor_);
}

std::uint16_t Writer::add_schema(std::string_view name, std::string_view encoding, std::string_view text) {
  Record record(schemas_, Opcode::kSchema);
  put(schemas_, ++schema_count_);
  put_text(schemas_, name);
  put_text(schemas_, encoding);
  put_text(schemas_, text);
  return schema_count_;
}

std::uint16_t Writer::add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding) {
  Record record(channels_, Opcode::kChannel);
  put(channels_, ++channel_count_);
  put(channels_, schema);
  put_text(channels_, topic);
  put_text(channels_, encoding);
  put(channels_, std::uint32_t{0});  // no metadata
  return channel_count_;
}

void Writer::write(std::uint16_t channel, std::uint32_t sequence, std::int64_t log_time_ns,
                   std::int64_t publish_time_ns, std::span<const std::byte> data) {
  if (!failure_.empty()) {
    ++messages_lost_;
    return;
  }
  const auto log_time = static_cast<std::uint64_t>(log_time_ns);
  const bool old = chunk_messages_ > 0 && log_time > chunk_start_time_ &&
                   log_time - chunk_start_time_ >= static_cast<std::uint64_t>(options_.chunk_span_ns);
  if (old || chunk_.size() >= options_.chunk_bytes) flush();
  chunk_start_time_ = chunk_messages_ == 0 ? log_time : std::min(chunk_start_time_, log_time);
  chunk_end_time_ = chunk_messages_ == 0 ? log_time : std::max(chunk_end_time_, log_time);
  chunk_index_[channel].push_back({log_time, chunk_.size()});
  ++chunk_messages_;
  Record record(chunk_, Opcode::kMessage);
  put(chunk_, channel);
  put(chunk_, sequence);
  put(chunk_, log_time);
  put(chunk_, static_cast<std::uint64_t>(publish_time_ns));
  put_bytes(chunk_, data);
}

void Writer::flush() {
  if (file_ < 0) return;
  if (!definitions_written_) {
    definitions_written_ = true;
    // Outside the chunks, so that a damaged chunk does not take the meaning of the others with it.
    put_bytes(out_, schemas_);
    put_bytes(out_, channels_);
  }
  if (chunk_messages_ > 0) {
    ChunkRecord record;
    append_chunk_record(record);
    append_message_indexes(record);
    if (messages_written_ == 0) first_time_ = chunk_start_time_;
    first_time_ = std::min(first_time_, chunk_start_time_);
    last_time_ = std::max(last_time_, chunk_end_time_);
    for (auto& [channel, entries] : chunk_index_) {
      channel_messages_[channel] += entries.size();
      entries.clear();
    }
    chunks_.push_back(record);
    messages_written_ += chunk_messages_;
  }
  put_out(true);
  if (!failure_.empty()) {
    messages_lost_ += chunk_messages_;
    messages_written_ -= chunk_messages_;
  }
  chunk_.clear();
  chunk_messages_ = 0;
}

void Writer::append_chunk_record(ChunkRecord& record) {
  record.start_time = chunk_start_time_;
  record.end_time = chunk_end_time_;
  record.offset = position_ + out_.size();
  record.uncompressed_size = chunk_.size();
  std::span<const std::byte> payload = chunk_;
  if (options_.compression_level > 0) {
    compressed_.resize(std::max(compressed_.size(), ZSTD_compressBound(chunk_.size())));
    const std::size_t size =
        ZSTD_compress2(compressor_, compressed_.data(), compressed_.size(), chunk_.data(), chunk_.size());
    payload = std::span(compressed_).first(size);  // with room for the bound, zstd has no other failure
  }
  record.compressed_size = payload.size();
  {
    Record chunk(out_, Opcode::kChunk);
    put(out_, record.start_time);
    put(out_, record.end_time);
    put(out_, record.uncompressed_size);
    put(out_, crc32(chunk_));
    put_text(out_, options_.compression_level > 0 ? "zstd" : "");
    put(out_, record.compressed_size);
    put_bytes(out_, payload);
  }
  record.length = position_ + out_.size() - record.offset;
}

void Writer::append_message_indexes(ChunkRecord& record) {
  const std::uint64_t start = position_ + out_.size();
  for (const auto& [channel, entries] : chunk_index_) {
    if (entries.empty()) continue;
    record.index_offsets[channel] = position_ + out_.size();
    Record index(out_, Opcode::kMessageIndex);
    put(out_, channel);
    put(out_, static_cast<std::uint32_t>(entries.size() * 16));
    for (const IndexEntry& entry : entries) {
      put(out_, entry.log_time);
      put(out_, entry.offset);
    }
  }
  record.index_length = position_ + out_.size() - start;
}

void Writer::append_statistics() {
  Record statistics(out_, Opcode::kStatistics);
  put(out_, messages_written_);
  put(out_, schema_count_);
  put(out_, static_cast<std::uint32_t>(channel_count_));
  put(out_, std::uint32_t{0});  // attachments
  put(out_, std::uint32_t{0});  // metadata records
  put(out_, static_cast<std::uint32_t>(chunks_.size()));
  put(out_, first_time_);
  put(out_, last_time_);
  put(out_, static_cast<std::uint32_t>(channel_messages_.size() * 10));
  for (const auto& [channel, count] : channel_messages_) {
    put(out_, channel);
    put(out_, count);
  }
}

void Writer::append_chunk_indexes() {
  for (const ChunkRecord& chunk : chunks_) {
    Record record(out_, Opcode::kChunkIndex);
    put(out_, chunk.start_time);
    put(out_, chunk.end_time);
    put(out_, chunk.offset);
    put(out_, chunk.length);
    put(out_, static_cast<std::uint32_t>(chunk.index_offsets.size() * 10));
    for (const auto& [channel, offset] : chunk.index_offsets) {
      put(out_, channel);
      put(out_, offset);
    }
    put(out_, chunk.index_length);
    put_text(out_, options_.compression_level > 0 ? "zstd" : "");
    put(out_, chunk.compressed_size);
    put(out_, chunk.uncompressed_size);
  }
}

void Writer::append_summary() {
  struct Group {
    Opcode opcode;
    std::uint64_t start;
    std::uint64_t length;
  };
  const std::uint64_t summary_start = position_;  // out_ is empty here
  std::vector<Group> groups;
  auto group = [&](Opcode opcode, auto&& append) {
    const std::uint64_t start = position_ + out_.size();
    append();
    const std::uint64_t length = position_ + out_.size() - start;
    if (length > 0) groups.push_back({opcode, start, length});
  };
  group(Opcode::kSchema, [&] { put_bytes(out_, schemas_); });
  group(Opcode::kChannel, [&] { put_bytes(out_, channels_); });
  group(Opcode::kStatistics, [&] { append_statistics(); });
  group(Opcode::kChunkIndex, [&] { append_chunk_indexes(); });
  const std::uint64_t offsets_start = position_ + out_.size();
  for (const Group& entry : groups) {
    Record record(out_, Opcode::kSummaryOffset);
    put(out_, static_cast<std::uint8_t>(entry.opcode));
    put(out_, entry.start);
    put(out_, entry.length);
  }
  append_footer(summary_start, offsets_start);
}

void Writer::append_footer(std::uint64_t summary_start, std::uint64_t offsets_start) {
  // The checksum covers the summary and the footer up to the checksum itself.
  put(out_, static_cast<std::uint8_t>(Opcode::kFooter));
  put(out_, std::uint64_t{kFooterBytes});
  put(out_, summary_start);
  put(out_, offsets_start);
  put(out_, crc32(out_));
}

void Writer::close() {
  if (file_ < 0) return;
  flush();
  if (failure_.empty()) {
    {
      Record end(out_, Opcode::kDataEnd);
      put(out_, data_checksum_);
    }
    put_out(false);
    append_summary();
    put_bytes(out_, std::as_bytes(std::span(kMagic)));
    put_out(false);
  }
  if (::close(file_) != 0 && failure_.empty()) failure_ = path_ + ": " + std::strerror(errno);
  file_ = -1;
}

void Writer::put_out(bool in_data_section) {
  if (in_data_section) data_checksum_ = crc32(out_, data_checksum_);
  std::span<const std::byte> rest = out_;
  while (!rest.empty() && failure_.empty()) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      failure_ = path_ + ": cannot write: " + std::strerror(errno);
      break;
    }
    rest = rest.subspan(static_cast<std::size_t>(written));
  }
  if (options_.sync_each_chunk && failure_.empty()) ::fdatasync(file_);
  position_ += out_.size();
  out_.clear();
}

}  // namespace omma::mcap
