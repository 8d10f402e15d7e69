// Cyclone DDS by its C API: waiting is looking again every few milliseconds.
#include "ground/uplink/command_sender.hpp"

#include <functional>
#include <random>
#include <thread>

namespace omma::ground {
namespace {

using telemetry::TopicId;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookEvery{5};
constexpr std::int32_t kReaderDepth = 64;

/// Calls `look` until it says true; false when the time is over.
bool wait_until(CommandSender::Duration patience, const std::function<bool()>& look) {
  const auto give_up = Clock::now() + std::chrono::duration_cast<Clock::duration>(patience);
  while (!look()) {
    if (Clock::now() > give_up) return false;
    std::this_thread::sleep_for(kLookEvery);
  }
  return true;
}

/// Gives each sample there is; `take` says whether to go on.
template <class Sample>
void take_each(dds_entity_t reader, const std::function<bool(const Sample&)>& take) {
  void* sample = nullptr;
  dds_sample_info_t info;
  bool more = true;
  while (more && dds_take(reader, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) more = take(*static_cast<const Sample*>(sample));
    dds_return_loan(reader, &sample, 1);
    sample = nullptr;
  }
}

dds_entity_t reader_of(const telemetry::Participant& participant, const std::string& spacecraft, TopicId id) {
  return telemetry::checked(
      dds_create_reader(participant.entity(), participant.add_topic(spacecraft, id),
                        telemetry::reader_qos(telemetry::topic(id), kReaderDepth).get(), nullptr),
      "the reader of " + telemetry::topic_name(spacecraft, id));
}

std::uint64_t random_number() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

}  // namespace

CommandSender::CommandSender(int domain, const std::string& spacecraft)
    : participant_(domain), sender_(random_number()) {
  status_ = reader_of(participant_, spacecraft, TopicId::kStatus);
  dictionary_ = reader_of(participant_, spacecraft, TopicId::kDictionary);
  acks_ = reader_of(participant_, spacecraft, TopicId::kCommandAck);
  commands_ = telemetry::checked(
      dds_create_writer(participant_.entity(), participant_.add_topic(spacecraft, TopicId::kCommand),
                        telemetry::writer_qos(telemetry::topic(TopicId::kCommand)).get(), nullptr),
      "the writer of commands");
}

std::optional<UplinkStatus> CommandSender::status(Duration patience) {
  std::optional<UplinkStatus> newest;
  wait_until(patience, [&] {
    take_each<omma_Status>(status_, [&](const omma_Status& status) {
      newest = {status.session, status.last_sequence};
      return true;
    });
    return newest.has_value();
  });
  return newest;
}

std::optional<std::string> CommandSender::dictionary(Duration patience) {
  std::optional<std::string> json;
  wait_until(patience, [&] {
    take_each<omma_Dictionary>(dictionary_, [&](const omma_Dictionary& sample) {
      json.emplace(reinterpret_cast<const char*>(sample.json._buffer), sample.json._length);
      return true;
    });
    return json.has_value();
  });
  return json;
}

bool CommandSender::send(const Command& command, Duration patience) {
  const bool heard = wait_until(patience, [&] {
    dds_publication_matched_status_t matched;
    return dds_get_publication_matched_status(commands_, &matched) == DDS_RETCODE_OK &&
           matched.current_count > 0;
  });
  if (!heard) return false;
  Command sent = command;
  omma_Command sample{};
  sample.sender = sent.sender;
  sample.session = sent.session;
  sample.sequence_number = sent.sequence;
  sample.opcode = sent.opcode;
  sample.arguments._buffer = sent.arguments.data();
  sample.arguments._length = sent.argument_count;
  sample.arguments._maximum = sent.argument_count;
  return dds_write(commands_, &sample) == DDS_RETCODE_OK;
}

std::optional<HeardAck> CommandSender::acknowledgement(const Command& command, Duration patience) {
  std::optional<HeardAck> heard;
  wait_until(patience, [&] {
    take_each<omma_CommandAck>(acks_, [&](const omma_CommandAck& ack) {
      if (ack.sender != command.sender || ack.sequence_number != command.sequence) return true;
      heard =
          HeardAck{static_cast<CommandStage>(ack.stage), static_cast<CommandReason>(ack.reason), ack.text};
      return false;
    });
    return heard.has_value();
  });
  return heard;
}

}  // namespace omma::ground
