// Cyclone DDS by its C API: discovery from the built-in topic, samples in their serialised form.
#include "ground/dds/subscriber.hpp"

#include <dds/ddsi/ddsi_serdata.h>

#include <vector>

#include "components/telemetry/cdr.hpp"

namespace omma::ground {
namespace {

using telemetry::TopicId;

// Room for a second of a fast camera between two polls.
constexpr std::int32_t kReaderDepth = 512;
constexpr std::uint32_t kAtOnce = 64;

/// The middle of "omma/<spacecraft>/<topic>"; empty for another name.
std::string spacecraft_of(const std::string& topic) {
  const std::size_t end = topic.rfind('/');
  if (!topic.starts_with("omma/") || end <= 5 || !telemetry::find_topic(topic)) return {};
  return topic.substr(5, end - 5);
}

/// Camera or body, which follow the head in the topics that have a key; else 0.
int key_of(TopicId id, std::span<const std::byte> cdr) {
  constexpr std::size_t kKeyAt = 4 + 21;
  const bool keyed = id == TopicId::kDots || id == TopicId::kRelativePose || id == TopicId::kApproach;
  return keyed && cdr.size() > kKeyAt ? std::to_integer<int>(cdr[kKeyAt]) : 0;
}

std::vector<std::byte> bytes_of(struct ddsi_serdata* serdata) {
  const std::uint32_t size = ddsi_serdata_size(serdata);
  ddsrt_iovec_t bytes{};
  struct ddsi_serdata* held = ddsi_serdata_to_ser_ref(serdata, 0, size, &bytes);
  const auto* first = static_cast<const std::byte*>(bytes.iov_base);
  std::vector<std::byte> copy(first, first + bytes.iov_len);
  ddsi_serdata_to_ser_unref(held, &bytes);
  return copy;
}

}  // namespace

Subscriber::Subscriber(int domain, std::string spacecraft)
    : participant_(domain), spacecraft_(std::move(spacecraft)) {
  publications_ = telemetry::checked(
      dds_create_reader(participant_.entity(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
      "the reader of publications");
  if (!spacecraft_.empty()) subscribe();
}

void Subscriber::subscribe() {
  for (const telemetry::Topic& entry : telemetry::topics()) {
    const dds_entity_t topic = participant_.add_topic(spacecraft_, entry.id);
    readers_[static_cast<std::size_t>(entry.id)] =
        telemetry::checked(dds_create_reader(participant_.entity(), topic,
                                             telemetry::reader_qos(entry, kReaderDepth).get(), nullptr),
                           "the reader of " + telemetry::topic_name(spacecraft_, entry.id));
  }
  subscribed_ = true;
}

void Subscriber::discover() {
  void* sample = nullptr;
  dds_sample_info_t info;
  while (spacecraft_.empty() && dds_take(publications_, &sample, &info, 1, 1) > 0) {
    if (info.valid_data)
      spacecraft_ = spacecraft_of(static_cast<dds_builtintopic_endpoint_t*>(sample)->topic_name);
    dds_return_loan(publications_, &sample, 1);
    sample = nullptr;
  }
  if (!spacecraft_.empty()) subscribe();
}

std::size_t Subscriber::poll(const Take& take) {
  if (!subscribed_) discover();
  if (!subscribed_) return 0;
  std::size_t taken = 0;
  for (const telemetry::Topic& entry : telemetry::topics()) taken += take_from(entry.id, take);
  return taken;
}

std::size_t Subscriber::take_from(TopicId id, const Take& take) {
  std::array<struct ddsi_serdata*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  std::size_t taken = 0;
  while (true) {
    const dds_return_t count = dds_takecdr(readers_[static_cast<std::size_t>(id)], samples.data(), kAtOnce,
                                           infos.data(), DDS_ANY_STATE);
    if (count <= 0) return taken;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (infos[i].valid_data) {
        const std::vector<std::byte> cdr = bytes_of(samples[i]);
        this->count(id, cdr);
        take(id, cdr);
        ++taken;
      }
      ddsi_serdata_unref(samples[i]);
      samples[i] = nullptr;
    }
  }
}

void Subscriber::count(TopicId id, std::span<const std::byte> cdr) {
  telemetry::SampleHead head;
  if (!telemetry::read_head(cdr, head)) return;
  ++received_[static_cast<std::size_t>(id)];
  const auto [last, is_first] = last_numbers_.try_emplace({id, key_of(id, cdr)}, head.sample_number);
  // A smaller number is a program that was started anew.
  if (!is_first && head.sample_number > last->second)
    lost_[static_cast<std::size_t>(id)] += head.sample_number - last->second - 1;
  last->second = head.sample_number;
}

std::uint64_t Subscriber::lost(TopicId id) const {
  return lost_[static_cast<std::size_t>(id)];
}

}  // namespace omma::ground
