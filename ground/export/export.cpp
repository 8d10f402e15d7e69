// Every topic by the description the recording carries, so that recordings of other versions can be read too.
#include "ground/export/export.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "components/telemetry/mcap_reader.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/export/csv_table.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string recording;
  std::string out = ".";
  std::vector<std::string> topics;
};

std::string last_part(const std::string& topic) {
  return topic.substr(topic.rfind('/') + 1);
}

/// The file of one topic while it is written.
struct TopicFile {
  std::filesystem::path path;
  idl::Schema schema;
  std::unique_ptr<CsvTable> table;
  std::ofstream stream;
  std::uint64_t samples = 0;
  std::uint64_t undecodable = 0;
};

std::unique_ptr<TopicFile> open_topic(const mcap::Reader& reader, const mcap::Channel& channel,
                                      const std::string& folder) {
  const auto schema = reader.schemas().find(channel.schema);
  if (schema == reader.schemas().end() || channel.encoding != "cdr" || schema->second.encoding != "omgidl")
    throw InputError(reader.path(), 0, channel.topic, "CDR samples described by OMG IDL",
                     "encoding '" + channel.encoding + "'");
  auto file = std::make_unique<TopicFile>();
  file->schema = idl::parse(schema->second.text, reader.path());
  if (!file->schema.structs.contains(schema->second.name))
    throw InputError(reader.path(), 0, channel.topic, "type " + schema->second.name + " in its IDL", "none");
  file->table = std::make_unique<CsvTable>(file->schema, schema->second.name, reader.path());
  file->path = std::filesystem::path(folder) / (last_part(channel.topic) + ".csv");
  file->stream.open(file->path, std::ios::binary | std::ios::trunc);
  if (!file->stream) throw InputError(file->path.string(), 0, "--out", "a file that can be written", "none");
  file->stream << file->table->header();
  return file;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder, 0, "--out", "a folder that can be made", error.message());
}

std::set<std::string> wanted_topics(const mcap::Reader& reader, const std::vector<std::string>& asked) {
  std::set<std::string> there;
  for (const auto& [id, channel] : reader.channels()) there.insert(last_part(channel.topic));
  if (asked.empty()) return there;
  for (const std::string& topic : asked)
    if (!there.contains(topic))
      throw InputError(reader.path(), 0, "--topic", "a topic of this recording", "'" + topic + "'");
  return {asked.begin(), asked.end()};
}

/// @return false where something was lost on the way, which has been said
bool write_all(mcap::Reader& reader, std::map<std::uint16_t, std::unique_ptr<TopicFile>>& files) {
  reader.for_each_message([&](const mcap::Channel& channel) { return files.contains(channel.id); },
                          [&](const mcap::MessageView& message) {
                            TopicFile& file = *files.at(message.channel);
                            if (const std::optional<std::string> rows = file.table->rows(message.data)) {
                              file.stream << *rows;
                              ++file.samples;
                            } else {
                              ++file.undecodable;
                            }
                            return true;
                          });
  bool whole = reader.damage().empty();
  if (!whole) std::fprintf(stderr, "omma export: %s\n", reader.damage().c_str());
  for (const auto& [channel, file] : files) {
    file->stream.close();
    if (!file->stream) {
      std::fprintf(stderr, "omma export: %s: cannot write\n", file->path.c_str());
      whole = false;
    }
    if (file->undecodable > 0) {
      std::fprintf(stderr, "omma export: %s: %llu samples are not of their type\n", file->path.c_str(),
                   static_cast<unsigned long long>(file->undecodable));
      whole = false;
    }
    std::printf("%s: %llu samples\n", file->path.c_str(), static_cast<unsigned long long>(file->samples));
  }
  return whole;
}

int export_recording(const Arguments& arguments) {
  mcap::Reader reader(arguments.recording);
  const std::set<std::string> wanted = wanted_topics(reader, arguments.topics);
  make_folder(arguments.out);
  std::map<std::uint16_t, std::unique_ptr<TopicFile>> files;
  for (const auto& [id, channel] : reader.channels())
    if (wanted.contains(last_part(channel.topic))) files[id] = open_topic(reader, channel, arguments.out);
  return write_all(reader, files) ? 0 : 2;
}

}  // namespace

void add_export(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("export", "A recording as CSV, one file a topic");
  command->add_option("recording", arguments->recording, "MCAP file")->required();
  command->add_option("--out", arguments->out, "folder for the files; default: this one");
  command->add_option("--topic", arguments->topics, "only these, by the last part of their names");
  command->callback([arguments, &context] { context.exit_code = export_recording(*arguments); });
}

}  // namespace omma::ground
