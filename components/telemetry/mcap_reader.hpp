// Reads MCAP files (mcap.dev/spec), also such as were cut off by a crash or damaged: every complete, sound
// chunk is given, and `damage` says in a sentence what is missing. A finished file is read by its index;
// without a sound one the records are walked from the start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace omma::mcap {

struct Schema {
  std::string name;
  std::string encoding;
  std::string text;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;
};

/// One message where it lies; valid during the callback.
struct MessageView {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::int64_t log_time_ns = 0;
  std::int64_t publish_time_ns = 0;
  std::span<const std::byte> data;
  std::size_t chunk = 0;   ///< where it lies, for Reader::message_at
  std::size_t offset = 0;  ///< in the unpacked chunk
};

class Reader {
 public:
  /// Throws InputError where the file cannot be opened or does not begin as an MCAP file.
  explicit Reader(const std::string& path);

  const std::string& path() const { return path_; }
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  /// Empty when the file is whole and sound as far as it was read; may become a sentence while messages are
  /// read.
  const std::string& damage() const { return damage_; }

  /// Gives the messages in the order they were written. Stops early when `take` returns false.
  /// @param wanted  asked once per channel: chunks without a wanted channel are not even unpacked
  void for_each_message(const std::function<bool(const Channel&)>& wanted,
                        const std::function<bool(const MessageView&)>& take);
  /// A message seen before, by its `chunk` and `offset`; none where the file does not hold it any more. Its
  /// chunk is unpacked, unless it was the last one: cheap in the order of the file.
  std::optional<MessageView> message_at(std::size_t chunk, std::size_t offset);

 private:
  struct Chunk {
    std::uint64_t offset = 0;             ///< in the file, of the record's content
    std::uint64_t length = 0;             ///< of the content
    std::vector<std::uint16_t> channels;  ///< known only from the index
    bool channels_known = false;
    std::vector<std::byte> loose;  ///< messages found outside any chunk
  };
  struct FileClose {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::vector<std::byte> bytes_at(std::uint64_t offset, std::uint64_t length) const;
  bool read_index();
  void walk_records();
  bool unpack(const Chunk& chunk);
  void note_damage(const std::string& sentence);
  bool add_definition(std::uint8_t opcode, std::span<const std::byte> content);

  std::string path_;
  std::unique_ptr<std::FILE, FileClose> file_;
  std::uint64_t size_ = 0;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Chunk> chunks_;
  std::vector<std::byte> records_;       // of the chunk being read
  std::optional<std::size_t> unpacked_;  // which one that is
  std::string damage_;
};

}  // namespace omma::mcap
