#include "ground/recording.hpp"

#include "fsw/kernel/input_error.hpp"
#include "ground/idl/idl_schema.hpp"

namespace omma::ground {
namespace {

bool is_topic(const mcap::Channel& channel, telemetry::TopicId id) {
  return channel.topic.starts_with("omma/") && telemetry::find_topic(channel.topic) == id;
}

}  // namespace

std::string Recording::spacecraft() const {
  for (const auto& [id, channel] : reader_.channels()) {
    const std::size_t start = channel.topic.find('/');
    const std::size_t end = channel.topic.rfind('/');
    if (channel.topic.starts_with("omma/") && end > start)
      return channel.topic.substr(start + 1, end - start - 1);
  }
  return {};
}

void Recording::for_each_decoded(telemetry::TopicId id, const std::function<void(const void*)>& take) {
  const telemetry::Topic& topic = telemetry::topic(id);
  auto wanted = [&](const mcap::Channel& channel) {
    if (!is_topic(channel, id)) return false;
    const auto schema = reader_.schemas().find(channel.schema);
    if (schema == reader_.schemas().end() || channel.encoding != "cdr" ||
        schema->second.encoding != "omgidl") {
      throw InputError(reader_.path(), 0, channel.topic, "CDR samples described by OMG IDL",
                       "encoding '" + channel.encoding + "'");
    }
    if (schema->second.text != telemetry::idl_text() &&
        !idl::same_type(idl::parse(schema->second.text, reader_.path()),
                        idl::parse(telemetry::idl_text(), "omma.idl"), topic.type_name)) {
      throw InputError(reader_.path(), 0, channel.topic,
                       std::string(topic.type_name) + " as this program knows it",
                       "another version of it (omma export reads any version)");
    }
    return true;
  };
  telemetry::CdrReader decoder(id);
  reader_.for_each_message(wanted, [&](const mcap::MessageView& message) {
    if (const void* sample = decoder.read(message.data)) {
      take(sample);
    } else {
      ++undecodable_;
    }
    return true;
  });
}

}  // namespace omma::ground
