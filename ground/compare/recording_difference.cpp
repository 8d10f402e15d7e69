// Both files topic by topic: one topic of the first is held in memory while the second is read.
#include "ground/compare/recording_difference.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "components/telemetry/cdr.hpp"
#include "components/telemetry/mcap_reader.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/compare/tolerance.hpp"
#include "ground/idl/cdr_values.hpp"

namespace omma::ground {
namespace {

using Bytes = std::vector<std::byte>;

std::string last_part(const std::string& topic) {
  return topic.substr(topic.rfind('/') + 1);
}

std::vector<Bytes> samples_of(mcap::Reader& reader, const std::string& topic) {
  std::vector<Bytes> samples;
  reader.for_each_message([&](const mcap::Channel& channel) { return last_part(channel.topic) == topic; },
                          [&](const mcap::MessageView& message) {
                            samples.emplace_back(message.data.begin(), message.data.end());
                            return true;
                          });
  if (!reader.damage().empty())
    throw InputError(reader.path(), 0, "recording", "a whole file", reader.damage());
  return samples;
}

/// The sample by the file's own description; none where it cannot be read by it.
std::optional<std::vector<idl::Leaf>> leaves_of(const mcap::Reader& reader, const std::string& topic,
                                                const Bytes& sample) {
  for (const auto& [id, channel] : reader.channels()) {
    const auto schema = reader.schemas().find(channel.schema);
    if (last_part(channel.topic) != topic || schema == reader.schemas().end()) continue;
    if (channel.encoding != "cdr" || schema->second.encoding != "omgidl") continue;
    const idl::Schema parsed = idl::parse(schema->second.text, reader.path());
    const auto type = parsed.structs.find(schema->second.name);
    if (type != parsed.structs.end()) return idl::leaves(parsed, type->second, sample);
  }
  return std::nullopt;
}

std::string field_difference(const std::vector<idl::Leaf>& a, const std::vector<idl::Leaf>& b) {
  const std::size_t both = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (a[i].path != b[i].path)
      return "field " + a[i].path + " in the first, " + b[i].path + " in the second";
    if (a[i].text != b[i].text)
      return a[i].path + ": " + a[i].text + " in the first, " + b[i].text + " in the second";
  }
  if (a.size() != b.size()) return (a.size() > b.size() ? a : b)[both].path + ": only in one of them";
  return "the same values in other bytes";
}

std::string sample_difference(const mcap::Reader& reader_a, const mcap::Reader& reader_b,
                              const std::string& topic, std::size_t index, const Bytes& a, const Bytes& b) {
  telemetry::SampleHead head;
  std::string place = "sample " + std::to_string(index + 1);
  if (telemetry::read_head(a, head)) place += " (frame " + std::to_string(head.frame) + ")";
  const auto leaves_a = leaves_of(reader_a, topic, a);
  const auto leaves_b = leaves_of(reader_b, topic, b);
  if (!leaves_a || !leaves_b) return place + ": bytes that are not of the topic's type";
  return place + ": " + field_difference(*leaves_a, *leaves_b);
}

/// The samples of one topic by the file's own description; the schema is parsed once.
class TopicReader {
 public:
  TopicReader(const mcap::Reader& reader, const std::string& topic) {
    for (const auto& [id, channel] : reader.channels()) {
      const auto schema = reader.schemas().find(channel.schema);
      if (last_part(channel.topic) != topic || schema == reader.schemas().end()) continue;
      if (channel.encoding != "cdr" || schema->second.encoding != "omgidl") continue;
      schema_ = idl::parse(schema->second.text, reader.path());
      const auto type = schema_.structs.find(schema->second.name);
      if (type == schema_.structs.end()) continue;
      type_ = &type->second;
      return;
    }
  }
  std::optional<std::vector<idl::Leaf>> leaves(const Bytes& sample) const {
    if (type_ == nullptr) return std::nullopt;
    return idl::leaves(schema_, *type_, sample);
  }

 private:
  idl::Schema schema_;
  const idl::Struct* type_ = nullptr;
};

// Samples whose bytes differ are read, their fields' magnitudes gathered, and then each difference judged.
void judge(const mcap::Reader& reader_a, const mcap::Reader& reader_b, const std::vector<Bytes>& a,
           const std::vector<Bytes>& b, const Tolerance& tolerance, TopicComparison& result) {
  const TopicReader topic_a(reader_a, result.topic);
  const TopicReader topic_b(reader_b, result.topic);
  FieldJudge fields(tolerance, result.topic);
  struct Pair {
    std::size_t index;
    std::vector<idl::Leaf> a;
    std::vector<idl::Leaf> b;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] == b[i]) continue;
    const auto leaves_a = topic_a.leaves(a[i]);
    const auto leaves_b = topic_b.leaves(b[i]);
    if (!leaves_a || !leaves_b) {
      ++result.different;
      if (result.first_difference.empty())
        result.first_difference = sample_difference(reader_a, reader_b, result.topic, i, a[i], b[i]);
      continue;
    }
    fields.measure(*leaves_a);
    fields.measure(*leaves_b);
    pairs.push_back({i, *leaves_a, *leaves_b});
  }
  for (const Pair& pair : pairs) {
    const std::string difference = fields.difference(pair.a, pair.b);
    if (difference.empty()) {
      ++result.tolerated;
      continue;
    }
    ++result.different;
    if (!result.first_difference.empty()) continue;
    telemetry::SampleHead head;
    result.first_difference = "sample " + std::to_string(pair.index + 1);
    if (telemetry::read_head(a[pair.index], head))
      result.first_difference += " (frame " + std::to_string(head.frame) + ")";
    result.first_difference += ": " + difference;
  }
  result.largest = fields.largest();
}

TopicComparison compare_topic(mcap::Reader& reader_a, mcap::Reader& reader_b, const std::string& topic,
                              const Tolerance* tolerance) {
  const std::vector<Bytes> a = samples_of(reader_a, topic);
  const std::vector<Bytes> b = samples_of(reader_b, topic);
  TopicComparison result;
  result.topic = topic;
  result.samples_a = a.size();
  result.samples_b = b.size();
  if (tolerance != nullptr) judge(reader_a, reader_b, a, b, *tolerance, result);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (tolerance != nullptr || a[i] == b[i]) continue;
    if (result.different++ == 0)
      result.first_difference = sample_difference(reader_a, reader_b, topic, i, a[i], b[i]);
  }
  if (a.size() != b.size() && result.first_difference.empty())
    result.first_difference =
        std::to_string(a.size()) + " samples in the first, " + std::to_string(b.size()) + " in the second";
  return result;
}

}  // namespace

std::vector<TopicComparison> compare_recordings(const std::string& path_a, const std::string& path_b,
                                                const Tolerance* tolerance) {
  mcap::Reader reader_a(path_a);
  mcap::Reader reader_b(path_b);
  std::set<std::string> topics;
  for (const mcap::Reader* reader : {&reader_a, &reader_b}) {
    if (!reader->damage().empty())
      throw InputError(reader->path(), 0, "recording", "a whole file", reader->damage());
    for (const auto& [id, channel] : reader->channels()) topics.insert(last_part(channel.topic));
  }
  std::vector<TopicComparison> result;
  result.reserve(topics.size());
  for (const std::string& topic : topics)
    result.push_back(compare_topic(reader_a, reader_b, topic, tolerance));
  return result;
}

}  // namespace omma::ground
