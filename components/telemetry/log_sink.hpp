// The log on board: a recording (MCAP) of everything that is sent.
#pragma once

#include "components/telemetry/recording_writer.hpp"
#include "components/telemetry/sink.hpp"

namespace omma::telemetry {

class LogSink final : public Sink {
 public:
  /// Throws InputError where the file cannot be created.
  /// @param with_timing  measured durations go to a file of their own beside it (see RecordingWriter)
  LogSink(const std::string& path, std::string_view spacecraft, bool with_timing,
          const mcap::WriterOptions& options = {})
      : writer_(path, spacecraft, with_timing, options) {}

  void write(TopicId id, const void* /*sample*/, std::span<const std::byte> cdr) override {
    if (!writer_.write(id, cdr)) ++refused_;
  }
  void close() override { writer_.close(); }
  std::uint64_t lost() const override { return writer_.samples_lost() + refused_; }
  bool is_log() const override { return true; }
  std::string failure() const override { return writer_.failure(); }

 private:
  RecordingWriter writer_;
  std::uint64_t refused_ = 0;  // bytes that are no sample
};

}  // namespace omma::telemetry
