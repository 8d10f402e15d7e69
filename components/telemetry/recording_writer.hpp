// A recording: an MCAP file with one channel a topic, the samples' CDR bytes as they stand, and the IDL
// inside, so that it can be read without this program. Log time is on-board time. What is measured
// (durations) goes to a file of its own beside it: the main file is then the same, byte for byte, in every
// replay.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "components/telemetry/mcap_writer.hpp"
#include "components/telemetry/topics.hpp"

namespace omma::telemetry {

/// demo.mcap → demo.timing.mcap
std::string timing_path(const std::string& path);

class RecordingWriter {
 public:
  /// Throws InputError where a file cannot be created.
  /// @param with_timing  also writes the file of measured durations
  RecordingWriter(const std::string& path, std::string_view spacecraft, bool with_timing,
                  const mcap::WriterOptions& options = {});

  /// @param cdr  with its encapsulation header; bytes that do not begin as a sample are refused (false)
  bool write(TopicId id, std::span<const std::byte> cdr);
  void close();

  /// Empty while all is well, else what went wrong, in a sentence.
  const std::string& failure() const;
  std::uint64_t samples_lost() const;
  std::uint64_t samples_written() const;

 private:
  struct File {
    std::unique_ptr<mcap::Writer> writer;
    std::array<std::uint16_t, kTopicCount> channels{};
  };
  static File open(const std::string& path, std::string_view spacecraft, bool measured,
                   const mcap::WriterOptions& options);

  File main_;
  File timing_;
};

}  // namespace omma::telemetry
