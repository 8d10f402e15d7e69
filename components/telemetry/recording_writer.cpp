#include "components/telemetry/recording_writer.hpp"

#include "components/telemetry/cdr.hpp"

namespace omma::telemetry {

std::string timing_path(const std::string& path) {
  static constexpr std::string_view kEnding = ".mcap";
  const std::string stem = path.ends_with(kEnding) ? path.substr(0, path.size() - kEnding.size()) : path;
  return stem + ".timing.mcap";
}

RecordingWriter::File RecordingWriter::open(const std::string& path, std::string_view spacecraft,
                                            bool measured, const mcap::WriterOptions& options) {
  File file;
  file.writer = std::make_unique<mcap::Writer>(path, options);
  for (const Topic& entry : topics()) {
    if (entry.measured != measured) continue;
    const std::uint16_t schema = file.writer->add_schema(entry.type_name, "omgidl", idl_text());
    file.channels[static_cast<std::size_t>(entry.id)] =
        file.writer->add_channel(schema, topic_name(spacecraft, entry.id), "cdr");
  }
  return file;
}

RecordingWriter::RecordingWriter(const std::string& path, std::string_view spacecraft, bool with_timing,
                                 const mcap::WriterOptions& options)
    : main_(open(path, spacecraft, false, options)) {
  if (with_timing) timing_ = open(timing_path(path), spacecraft, true, options);
}

bool RecordingWriter::write(TopicId id, std::span<const std::byte> cdr) {
  File& file = topic(id).measured ? timing_ : main_;
  SampleHead head;
  if (!read_head(cdr, head)) return false;
  if (file.writer) {
    file.writer->write(file.channels[static_cast<std::size_t>(id)], head.sample_number, head.time_ns,
                       head.time_ns, cdr);
  }
  return true;
}

void RecordingWriter::close() {
  main_.writer->close();
  if (timing_.writer) timing_.writer->close();
}

const std::string& RecordingWriter::failure() const {
  const bool main_failed = !main_.writer->failure().empty();
  return main_failed || !timing_.writer ? main_.writer->failure() : timing_.writer->failure();
}

std::uint64_t RecordingWriter::samples_lost() const {
  return main_.writer->messages_lost() + (timing_.writer ? timing_.writer->messages_lost() : 0);
}

std::uint64_t RecordingWriter::samples_written() const {
  return main_.writer->messages_written() + (timing_.writer ? timing_.writer->messages_written() : 0);
}

}  // namespace omma::telemetry
