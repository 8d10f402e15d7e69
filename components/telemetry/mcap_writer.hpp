// Writes an MCAP file (mcap.dev/spec): messages in zstd chunks with checksums, an index and a summary at the
// end. It lives beside the telemetry component because the flight program's log is written with it; the
// ground, which may include a component's pure files, records with it too.
//
// Each chunk reaches the file in one piece as soon as it is full or old, so a program that dies loses the
// chunk it was filling and nothing else. The same messages give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "components/telemetry/mcap_format.hpp"

struct ZSTD_CCtx_s;

namespace omma::mcap {

struct WriterOptions {
  std::size_t chunk_bytes = 1U << 20;          ///< a chunk is closed when it has grown to this (uncompressed)
  std::int64_t chunk_span_ns = 1'000'000'000;  ///< or when it spans this much log time
  int compression_level = 1;                   ///< of zstd; 0 writes chunks as they are
  bool sync_each_chunk = false;                ///< wait until the disk has it: survives a power cut, slower
};

class Writer {
 public:
  /// Creates or empties the file. Throws InputError where that cannot be done.
  explicit Writer(const std::string& path, const WriterOptions& options = {});
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// All schemas and channels are added before the first message. @return its number
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view text);
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding);

  /// A write error (a full disk) does not throw: the message is counted as lost, and so are all after it.
  void write(std::uint16_t channel, std::uint32_t sequence, std::int64_t log_time_ns,
             std::int64_t publish_time_ns, std::span<const std::byte> data);
  /// Ends the open chunk now.
  void flush();
  /// Ends the chunk, writes the summary and closes. Called by the destructor where it was not before.
  void close();

  /// Empty while all is well, else what went wrong, in a sentence.
  const std::string& failure() const { return failure_; }
  std::uint64_t messages_lost() const { return messages_lost_; }
  std::uint64_t messages_written() const { return messages_written_; }

 private:
  struct ChunkRecord {
    std::uint64_t start_time = 0;
    std::uint64_t end_time = 0;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
    std::uint64_t index_length = 0;
    std::uint64_t compressed_size = 0;
    std::uint64_t uncompressed_size = 0;
  };
  struct IndexEntry {
    std::uint64_t log_time;
    std::uint64_t offset;
  };

  void append_chunk_record(ChunkRecord& record);
  void append_message_indexes(ChunkRecord& record);
  void append_summary();
  void append_chunk_indexes();
  void append_footer(std::uint64_t summary_start, std::uint64_t offsets_start);
  void append_statistics();
  void put_out(bool in_data_section);

  std::string path_;
  WriterOptions options_;
  int file_ = -1;
  ZSTD_CCtx_s* compressor_ = nullptr;
  std::string failure_;

  std::uint64_t position_ = 0;       // in the file, of what follows
  std::uint32_t data_checksum_ = 0;  // of the data section so far
  std::vector<std::byte> out_;       // bytes on their way to the file
  std::vector<std::byte> chunk_;     // messages of the open chunk
  std::vector<std::byte> compressed_;
  std::uint64_t chunk_start_time_ = 0;
  std::uint64_t chunk_end_time_ = 0;
  std::uint64_t chunk_messages_ = 0;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_index_;

  std::vector<std::byte> schemas_;  // records, repeated in the summary
  std::vector<std::byte> channels_;
  bool definitions_written_ = false;
  std::uint16_t schema_count_ = 0;
  std::uint16_t channel_count_ = 0;
  std::vector<ChunkRecord> chunks_;
  std::map<std::uint16_t, std::uint64_t> channel_messages_;
  std::uint64_t first_time_ = 0;
  std::uint64_t last_time_ = 0;
  std::uint64_t messages_written_ = 0;
  std::uint64_t messages_lost_ = 0;
};

}  // namespace omma::mcap
