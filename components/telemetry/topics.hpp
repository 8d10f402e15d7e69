// The table of topics: the telemetry that the flight program publishes and logs and the ground reads, and the
// link on which commands come. One line a topic; the types are in omma.idl, the interface control document is
// docs/interfaces.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "components/telemetry/omma.h"

namespace omma::telemetry {

enum class TopicId : std::uint8_t {
  kFrameSet,
  kDots,
  kAttitude,
  kRelativePose,
  kUnknownObjects,
  kApproach,
  kHealth,
  kTiming,
  kFrameTiming,
  kUtc,
  kEvent,
  kImageChunk,
  kMotion,
  kCommandAck,
  kStatus,
  kParameters,
  // Not telemetry: on the link only, and in no log.
  kCommand,
  kDictionary,
};
inline constexpr std::size_t kTopicCount = 16;  ///< of telemetry

/// How a topic travels over DDS.
enum class Delivery : std::uint8_t {
  kStream,  ///< best effort, KEEP_LAST, with a deadline: the newest matters
  kEvent,   ///< reliable, KEEP_LAST with depth, transient local: each one matters, also to who comes late
  kOrder,   ///< reliable, KEEP_ALL, volatile: each one matters, to who is there, and never to who comes late
};

struct Topic {
  TopicId id;
  std::string_view name;       ///< last part of the topic name, as in omma/<spacecraft>/attitude
  std::string_view type_name;  ///< in the IDL, as in omma::Attitude
  const dds_topic_descriptor_t* descriptor;
  Delivery delivery;
  std::int32_t depth;        ///< of the KEEP_LAST history, per key
  std::int32_t deadline_ms;  ///< offered: longest time between two samples (of a key); 0: none is promised
  bool measured;             ///< holds measured durations: not the same from run to run
};

/// Telemetry.
std::span<const Topic, kTopicCount> topics() noexcept;
/// Any topic, those of the link as well.
const Topic& topic(TopicId id) noexcept;
/// Telemetry by the last part of its name, or by the whole name; empty when there is none.
std::optional<TopicId> find_topic(std::string_view name) noexcept;
/// omma/<spacecraft>/<topic>
std::string topic_name(std::string_view spacecraft, TopicId id);
/// The IDL all types come from, as it stands.
std::string_view idl_text() noexcept;

/// TopicOf<omma_Attitude>::id
template <class Sample>
struct TopicOf;
template <>
struct TopicOf<omma_FrameSet> {
  static constexpr TopicId id = TopicId::kFrameSet;
};
template <>
struct TopicOf<omma_CameraDots> {
  static constexpr TopicId id = TopicId::kDots;
};
template <>
struct TopicOf<omma_Attitude> {
  static constexpr TopicId id = TopicId::kAttitude;
};
template <>
struct TopicOf<omma_RelativePose> {
  static constexpr TopicId id = TopicId::kRelativePose;
};
template <>
struct TopicOf<omma_UnknownObjects> {
  static constexpr TopicId id = TopicId::kUnknownObjects;
};
template <>
struct TopicOf<omma_Approach> {
  static constexpr TopicId id = TopicId::kApproach;
};
template <>
struct TopicOf<omma_Health> {
  static constexpr TopicId id = TopicId::kHealth;
};
template <>
struct TopicOf<omma_Timing> {
  static constexpr TopicId id = TopicId::kTiming;
};
template <>
struct TopicOf<omma_FrameTiming> {
  static constexpr TopicId id = TopicId::kFrameTiming;
};
template <>
struct TopicOf<omma_UtcCorrelation> {
  static constexpr TopicId id = TopicId::kUtc;
};
template <>
struct TopicOf<omma_Event> {
  static constexpr TopicId id = TopicId::kEvent;
};
template <>
struct TopicOf<omma_ImageChunk> {
  static constexpr TopicId id = TopicId::kImageChunk;
};
template <>
struct TopicOf<omma_Motion> {
  static constexpr TopicId id = TopicId::kMotion;
};
template <>
struct TopicOf<omma_CommandAck> {
  static constexpr TopicId id = TopicId::kCommandAck;
};
template <>
struct TopicOf<omma_Status> {
  static constexpr TopicId id = TopicId::kStatus;
};
template <>
struct TopicOf<omma_Parameters> {
  static constexpr TopicId id = TopicId::kParameters;
};

}  // namespace omma::telemetry
