// The newest sample of each topic, as the monitor shows them, with the moment each came.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "components/telemetry/cdr.hpp"

namespace omma::ground {

using SteadyClock = std::chrono::steady_clock;

/// A line of the list of events.
struct EventLine {
  std::int64_t time_ns = 0;  ///< on board
  omma_EventSeverity severity = omma_EVENT_DIAGNOSTIC;
  std::string text;
  std::uint32_t runs_ago = 0;  ///< 0: of this run
};

class NewestSamples {
 public:
  static constexpr std::size_t kEvents = 8;

  /// Bytes that are not of their topic's type are counted and passed over.
  void take(telemetry::TopicId id, std::span<const std::byte> cdr, SteadyClock::time_point now);

  // Null until there is one; valid until the next one is taken.
  const omma_FrameSet* frame_set() const { return frame_set_; }
  const omma_Attitude* attitude() const { return attitude_; }
  const omma_UnknownObjects* objects() const { return objects_; }
  const omma_Health* health() const { return health_; }
  const omma_Timing* timing() const { return timing_; }
  const omma_FrameTiming* frame_timing() const { return frame_timing_; }
  const omma_UtcCorrelation* utc() const { return utc_; }
  const omma_ImageChunk* image_chunk() const { return image_chunk_; }
  const omma_Motion* motion() const { return motion_; }
  const omma_Status* status() const { return status_; }
  const std::map<int, omma_RelativePose>& poses() const { return poses_; }        ///< by body
  const std::map<int, omma_Approach>& approaches() const { return approaches_; }  ///< by body
  /// Events and what became of commands, oldest first.
  const std::deque<EventLine>& events() const { return events_; }

  /// Seconds since a sample of the topic came; none where none has.
  std::optional<double> age(telemetry::TopicId id, SteadyClock::time_point now) const;
  /// Frame sets per second, as they came, over the last few; 0 while unknown.
  double frame_rate() const;
  std::uint64_t undecodable() const { return undecodable_; }

 private:
  void add_event(EventLine line);

  telemetry::CdrReader frame_set_reader_{telemetry::TopicId::kFrameSet};
  telemetry::CdrReader attitude_reader_{telemetry::TopicId::kAttitude};
  telemetry::CdrReader pose_reader_{telemetry::TopicId::kRelativePose};
  telemetry::CdrReader approach_reader_{telemetry::TopicId::kApproach};
  telemetry::CdrReader objects_reader_{telemetry::TopicId::kUnknownObjects};
  telemetry::CdrReader health_reader_{telemetry::TopicId::kHealth};
  telemetry::CdrReader timing_reader_{telemetry::TopicId::kTiming};
  telemetry::CdrReader frame_timing_reader_{telemetry::TopicId::kFrameTiming};
  telemetry::CdrReader utc_reader_{telemetry::TopicId::kUtc};
  telemetry::CdrReader event_reader_{telemetry::TopicId::kEvent};
  telemetry::CdrReader image_reader_{telemetry::TopicId::kImageChunk};
  telemetry::CdrReader motion_reader_{telemetry::TopicId::kMotion};
  telemetry::CdrReader ack_reader_{telemetry::TopicId::kCommandAck};
  telemetry::CdrReader status_reader_{telemetry::TopicId::kStatus};
  const omma_FrameSet* frame_set_ = nullptr;
  const omma_Attitude* attitude_ = nullptr;
  const omma_UnknownObjects* objects_ = nullptr;
  const omma_Health* health_ = nullptr;
  const omma_Timing* timing_ = nullptr;
  const omma_FrameTiming* frame_timing_ = nullptr;
  const omma_UtcCorrelation* utc_ = nullptr;
  const omma_ImageChunk* image_chunk_ = nullptr;
  const omma_Motion* motion_ = nullptr;
  const omma_Status* status_ = nullptr;
  std::map<int, omma_RelativePose> poses_;
  std::map<int, omma_Approach> approaches_;
  std::deque<EventLine> events_;
  std::map<telemetry::TopicId, SteadyClock::time_point> came_;
  std::deque<std::pair<std::uint64_t, SteadyClock::time_point>> frames_;  // number and arrival
  std::uint64_t undecodable_ = 0;
};

}  // namespace omma::ground
