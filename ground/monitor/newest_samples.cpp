// One decoder a topic: it keeps the sample it decoded last.
#include "ground/monitor/newest_samples.hpp"

namespace omma::ground {
namespace {

constexpr std::size_t kRateFrames = 30;

/// Leaves the newest in `kept`; a sample that cannot be decoded leaves none, as its reader's is spoilt.
template <class Sample>
bool keep(telemetry::CdrReader& reader, std::span<const std::byte> cdr, const Sample*& kept) {
  kept = reader.read_as<Sample>(cdr);
  return kept != nullptr;
}

}  // namespace

void NewestSamples::take(telemetry::TopicId id, std::span<const std::byte> cdr, SteadyClock::time_point now) {
  using telemetry::TopicId;
  bool sound = true;
  switch (id) {
    case TopicId::kFrameSet:
      sound = keep(frame_set_reader_, cdr, frame_set_);
      if (!sound) break;
      frames_.emplace_back(frame_set_->frame, now);
      if (frames_.size() > kRateFrames) frames_.pop_front();
      break;
    case TopicId::kAttitude:
      sound = keep(attitude_reader_, cdr, attitude_);
      break;
    case TopicId::kRelativePose: {
      const omma_RelativePose* pose = nullptr;
      sound = keep(pose_reader_, cdr, pose);
      if (sound) poses_[pose->body] = *pose;
      break;
    }
    case TopicId::kUnknownObjects:
      sound = keep(objects_reader_, cdr, objects_);
      break;
    case TopicId::kApproach: {
      const omma_Approach* approach = nullptr;
      sound = keep(approach_reader_, cdr, approach);
      if (sound) approaches_[approach->body] = *approach;
      break;
    }
    case TopicId::kHealth:
      sound = keep(health_reader_, cdr, health_);
      break;
    case TopicId::kTiming:
      sound = keep(timing_reader_, cdr, timing_);
      break;
    case TopicId::kFrameTiming:
      sound = keep(frame_timing_reader_, cdr, frame_timing_);
      break;
    case TopicId::kUtc:
      sound = keep(utc_reader_, cdr, utc_);
      break;
    case TopicId::kImageChunk:
      sound = keep(image_reader_, cdr, image_chunk_);
      break;
    case TopicId::kMotion:
      sound = keep(motion_reader_, cdr, motion_);
      break;
    case TopicId::kEvent: {
      const omma_Event* event = nullptr;
      sound = keep(event_reader_, cdr, event);
      if (!sound) break;
      add_event({event->time_ns, event->severity, event->text[0] != '\0' ? event->text : event->name,
                 event->runs_ago});
      break;
    }
    case TopicId::kCommandAck: {
      const omma_CommandAck* ack = nullptr;
      sound = keep(ack_reader_, cdr, ack);
      if (!sound) break;
      const bool good = ack->stage == omma_COMMAND_ACCEPTED || ack->stage == omma_COMMAND_COMPLETED;
      add_event({ack->time_ns, good ? omma_EVENT_ACTIVITY : omma_EVENT_WARNING, ack->text, 0});
      break;
    }
    case TopicId::kStatus:
      sound = keep(status_reader_, cdr, status_);
      break;
    case TopicId::kParameters:
    case TopicId::kDots:  // the frame set has their counts
    case TopicId::kCommand:
    case TopicId::kDictionary:
      break;
  }
  if (sound)
    came_[id] = now;
  else
    ++undecodable_;
}

void NewestSamples::add_event(EventLine line) {
  events_.push_back(std::move(line));
  if (events_.size() > kEvents) events_.pop_front();
}

std::optional<double> NewestSamples::age(telemetry::TopicId id, SteadyClock::time_point now) const {
  const auto came = came_.find(id);
  if (came == came_.end()) return std::nullopt;
  return std::chrono::duration<double>(now - came->second).count();
}

double NewestSamples::frame_rate() const {
  if (frames_.size() < 2) return 0;
  const auto& [first, first_came] = frames_.front();
  const auto& [last, last_came] = frames_.back();
  const double seconds = std::chrono::duration<double>(last_came - first_came).count();
  return last > first && seconds > 0 ? static_cast<double>(last - first) / seconds : 0;
}

}  // namespace omma::ground
