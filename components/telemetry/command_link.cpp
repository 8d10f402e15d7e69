// Cyclone's reader of commands, in a thread that sleeps until there are some.
#include "components/telemetry/command_link.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace omma::telemetry {
namespace {

constexpr dds_duration_t kLookEvery = DDS_MSECS(100);  // whether the program ends
constexpr std::chrono::milliseconds kFullInlet{2};

Command command_of(const omma_Command& sample) {
  Command command{.sender = sample.sender,
                  .session = sample.session,
                  .sequence = sample.sequence_number,
                  .opcode = sample.opcode,
                  .argument_count = static_cast<std::uint8_t>(sample.arguments._length)};
  const std::size_t count = std::min<std::size_t>(sample.arguments._length, command.arguments.size());
  std::copy_n(sample.arguments._buffer, count, command.arguments.begin());
  return command;
}

}  // namespace

CommandLink::CommandLink(std::string_view spacecraft, int domain, Commander& commander,
                         const std::string& dictionary)
    : participant_(domain), commander_(commander) {
  publish(dictionary, spacecraft);
  const dds_entity_t topic = participant_.add_topic(spacecraft, TopicId::kCommand);
  reader_ = checked(dds_create_reader(participant_.entity(), topic,
                                      reader_qos(telemetry::topic(TopicId::kCommand), 1).get(), nullptr),
                    "the reader of commands");
  thread_ = std::thread([this] { serve(); });
}

CommandLink::~CommandLink() {
  ending_ = true;
  thread_.join();
}

void CommandLink::publish(const std::string& dictionary, std::string_view spacecraft) {
  if (dictionary.size() > omma_MAX_DICTIONARY_BYTES)
    throw std::runtime_error("DDS: the dictionary has " + std::to_string(dictionary.size()) +
                             " bytes, and the link takes " + std::to_string(omma_MAX_DICTIONARY_BYTES));
  const dds_entity_t topic = participant_.add_topic(spacecraft, TopicId::kDictionary);
  const dds_entity_t writer =
      checked(dds_create_writer(participant_.entity(), topic,
                                writer_qos(telemetry::topic(TopicId::kDictionary)).get(), nullptr),
              "the writer of the dictionary");
  std::string bytes = dictionary;
  omma_Dictionary sample{};
  sample.json._buffer = reinterpret_cast<std::uint8_t*>(bytes.data());
  sample.json._length = static_cast<std::uint32_t>(bytes.size());
  sample.json._maximum = sample.json._length;
  checked(dds_write(writer, &sample), "a sample of the dictionary");
}

void CommandLink::serve() {
  const dds_entity_t waitset = dds_create_waitset(participant_.entity());
  dds_set_status_mask(reader_, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset, reader_, 0);
  while (!ending_) {
    dds_waitset_wait(waitset, nullptr, 0, kLookEvery);
    take_commands();
  }
}

void CommandLink::take_commands() {
  void* sample = nullptr;
  dds_sample_info_t info;
  while (!ending_ && dds_take(reader_, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) {
      const Command command = command_of(*static_cast<omma_Command*>(sample));
      // A full inlet holds up this thread and, in the end, the sender; nothing is lost.
      while (!commander_.submit(command) && !ending_) std::this_thread::sleep_for(kFullInlet);
    }
    dds_return_loan(reader_, &sample, 1);
    sample = nullptr;
  }
}

}  // namespace omma::telemetry
