#include "components/telemetry/topics.hpp"

#include <array>

namespace omma::telemetry {

namespace {

constexpr std::size_t kAllTopics = kTopicCount + 2;

const std::array<Topic, kAllTopics>& all_topics() noexcept {
  static const std::array<Topic, kAllTopics> table{{
      {TopicId::kFrameSet, "frame_set", "omma::FrameSet", &omma_FrameSet_desc, Delivery::kStream, 1, 2000,
       false},
      {TopicId::kDots, "dots", "omma::CameraDots", &omma_CameraDots_desc, Delivery::kStream, 1, 2000, false},
      {TopicId::kAttitude, "attitude", "omma::Attitude", &omma_Attitude_desc, Delivery::kStream, 1, 2000,
       false},
      {TopicId::kRelativePose, "relative_pose", "omma::RelativePose", &omma_RelativePose_desc,
       Delivery::kStream, 1, 2000, false},
      {TopicId::kUnknownObjects, "unknown_objects", "omma::UnknownObjects", &omma_UnknownObjects_desc,
       Delivery::kStream, 1, 2000, false},
      {TopicId::kApproach, "approach", "omma::Approach", &omma_Approach_desc, Delivery::kStream, 1, 2000,
       false},
      {TopicId::kHealth, "health", "omma::Health", &omma_Health_desc, Delivery::kStream, 1, 3000, false},
      {TopicId::kTiming, "timing", "omma::Timing", &omma_Timing_desc, Delivery::kStream, 1, 3000, true},
      {TopicId::kFrameTiming, "frame_timing", "omma::FrameTiming", &omma_FrameTiming_desc, Delivery::kStream,
       1, 2000, true},
      {TopicId::kUtc, "utc", "omma::UtcCorrelation", &omma_UtcCorrelation_desc, Delivery::kStream, 1, 3000,
       false},
      {TopicId::kEvent, "event", "omma::Event", &omma_Event_desc, Delivery::kEvent, 64, 0, false},
      {TopicId::kImageChunk, "image_chunk", "omma::ImageChunk", &omma_ImageChunk_desc, Delivery::kStream, 1,
       0, false},
      {TopicId::kMotion, "motion", "omma::Motion", &omma_Motion_desc, Delivery::kStream, 1, 2000, false},
      {TopicId::kCommandAck, "command_ack", "omma::CommandAck", &omma_CommandAck_desc, Delivery::kEvent, 64,
       0, false},
      {TopicId::kStatus, "status", "omma::Status", &omma_Status_desc, Delivery::kEvent, 1, 0, false},
      {TopicId::kParameters, "parameters", "omma::Parameters", &omma_Parameters_desc, Delivery::kEvent, 1, 0,
       false},
      {TopicId::kCommand, "command", "omma::Command", &omma_Command_desc, Delivery::kOrder, 1, 0, false},
      {TopicId::kDictionary, "dictionary", "omma::Dictionary", &omma_Dictionary_desc, Delivery::kEvent, 1, 0,
       false},
  }};
  return table;
}

}  // namespace

std::span<const Topic, kTopicCount> topics() noexcept {
  return std::span(all_topics()).first<kTopicCount>();
}

const Topic& topic(TopicId id) noexcept {
  return all_topics()[static_cast<std::size_t>(id)];
}

std::optional<TopicId> find_topic(std::string_view name) noexcept {
  const std::size_t slash = name.rfind('/');
  const std::string_view last = slash == std::string_view::npos ? name : name.substr(slash + 1);
  for (const Topic& entry : topics()) {
    if (entry.name == last) return entry.id;
  }
  return std::nullopt;
}

std::string topic_name(std::string_view spacecraft, TopicId id) {
  return "omma/" + std::string(spacecraft) + "/" + std::string(topic(id).name);
}

}  // namespace omma::telemetry
