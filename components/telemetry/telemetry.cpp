// One report per frame set: what goes into it, in which order, under which sample numbers.
#include "components/telemetry/telemetry.hpp"

#include <algorithm>

#include "components/telemetry/samples.hpp"

namespace omma {

using telemetry::FrameReport;
using telemetry::TopicId;
using telemetry::TopicOf;

Telemetry::Telemetry(const telemetry::TelemetryNames& names, Events& events)
    : names_(names), events_(events), reports_(names) {}

void Telemetry::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.input("dots", dots);
  visitor.input("pairings", pairings);
  visitor.input("attitude", attitude);
  visitor.input("poses", poses);
  visitor.input("objects", objects);
  if (approaches.source() != nullptr) visitor.input("approaches", approaches);
  visitor.input("image", image);
  visitor.input("health", health);
  visitor.input("timing", timing);
  visitor.input("utc", utc);
  if (exposure.source() != nullptr) visitor.input("exposure", exposure);
  if (motion.source() != nullptr) visitor.input("motion", motion);
  if (commands.source() != nullptr) visitor.input("commands", commands);
  if (acks.source() != nullptr) visitor.input("acks", acks);
  if (parameters.source() != nullptr) visitor.input("parameters", parameters);
  if (parameter_state.source() != nullptr) visitor.input("parameter_state", parameter_state);
  if (mode.source() != nullptr) visitor.input("mode", mode);
  if (limit_counts.source() != nullptr) visitor.input("limit_counts", limit_counts);
}

void Telemetry::step(const Tick& /*tick*/) noexcept {
  frame_ = dots->frame;
  FrameReport* report = reports_.begin();
  if (report == nullptr) {
    count_dropped();
    return;
  }
  add_frame_set(*report);
  add_dots(*report);
  add_products(*report);
  const bool healthy = add_housekeeping(*report);
  add_acks(*report);
  add_status(*report, healthy);
  add_parameters(*report);
  add_stages(*report);
  add_events(*report);
  reports_.send();
}

bool Telemetry::send_rest() noexcept {
  FrameReport* report = reports_.has_room() ? reports_.begin() : nullptr;
  if (report == nullptr) return true;  // once there is room
  add_acks(*report);
  add_events(*report);
  if (report->entries.empty()) return false;
  reports_.send();
  return true;
}

template <class Sample>
void Telemetry::add(Report& report, Sample& sample, std::uint32_t& number) noexcept {
  sample.sample_number = ++number;
  report.entries.push_back({TopicOf<Sample>::id, &sample});
}

void Telemetry::add_frame_set(Report& report) noexcept {
  telemetry::fill(*frames, *dots, *pairings, report.frame_set);
  if (exposure.source() != nullptr) telemetry::fill(*exposure, report.frame_set);
  add(report, report.frame_set, numbers_[static_cast<std::size_t>(TopicId::kFrameSet)]);
}

void Telemetry::add_dots(Report& report) noexcept {
  const std::size_t count = std::min(names_.cameras.size(), dots->cameras.size());
  for (std::size_t c = 0; c < count; ++c) {
    telemetry::fill(*dots, c, report.dots[c]);
    add(report, report.dots[c], dots_numbers_[c]);
  }
  const std::span<omma_CameraDots> cameras(report.dots.data(), count);
  telemetry::claim(pairings->sky, *attitude, cameras);
  for (const BodyPairings& body : pairings->bodies) {
    const auto pose = std::find_if(poses->bodies.begin(), poses->bodies.end(),
                                   [&](const PoseEstimate& estimate) { return estimate.body == body.body; });
    telemetry::claim(body, pose == poses->bodies.end() ? nullptr : pose, cameras);
  }
  telemetry::claim(*objects, cameras);
}

void Telemetry::add_products(Report& report) noexcept {
  telemetry::fill(*attitude, report.attitude);
  add(report, report.attitude, numbers_[static_cast<std::size_t>(TopicId::kAttitude)]);
  for (std::size_t b = 0; b < poses->bodies.size(); ++b) {
    const PoseEstimate& pose = poses->bodies[b];
    if (pose.body >= names_.bodies.size()) continue;
    telemetry::fill(pose, names_.bodies[pose.body].view(), report.poses[b]);
    add(report, report.poses[b], pose_numbers_[pose.body]);
  }
  telemetry::fill(*objects, report.objects);
  add(report, report.objects, numbers_[static_cast<std::size_t>(TopicId::kUnknownObjects)]);
  if (approaches.source() != nullptr) {
    for (std::size_t b = 0; b < approaches->bodies.size(); ++b) {
      const ApproachEstimate& approach = approaches->bodies[b];
      if (approach.body >= names_.bodies.size()) continue;
      telemetry::fill(approach, names_.bodies[approach.body].view(), report.approaches[b]);
      add(report, report.approaches[b], approach_numbers_[approach.body]);
    }
  }
  if (image->valid) {
    telemetry::fill(*image, report.image_chunk);
    add(report, report.image_chunk, numbers_[static_cast<std::size_t>(TopicId::kImageChunk)]);
  }
  if (motion.source() != nullptr && motion->valid) {
    telemetry::fill(*motion, report.motion);
    report.motion.frame = frame_;
    add(report, report.motion, numbers_[static_cast<std::size_t>(TopicId::kMotion)]);
  }
}

bool Telemetry::add_housekeeping(Report& report) noexcept {
  const bool reported = health->valid && (!has_health_ || health->time_ns != health_time_ns_);
  if (reported) {
    has_health_ = true;
    health_time_ns_ = health->time_ns;
    telemetry::fill(*health, report.health);
    report.health.frame = frame_;
    report.health.telemetry_dropped = reports_.dropped();
    report.health.log_lost = reports_.log_lost();
    add(report, report.health, numbers_[static_cast<std::size_t>(TopicId::kHealth)]);
  }
  if (timing->valid && (!has_timing_ || timing->time_ns != timing_time_ns_)) {
    has_timing_ = true;
    timing_time_ns_ = timing->time_ns;
    telemetry::fill(*timing, report.timing);
    report.timing.frame = frame_;
    add(report, report.timing, numbers_[static_cast<std::size_t>(TopicId::kTiming)]);
  }
  if (utc->source != UtcSource::kNone && (!has_utc_ || utc->time_ns != utc_time_ns_)) {
    has_utc_ = true;
    utc_time_ns_ = utc->time_ns;
    telemetry::fill(*utc, report.utc);
    report.utc.frame = frame_;
    add(report, report.utc, numbers_[static_cast<std::size_t>(TopicId::kUtc)]);
  }
  return reported;
}

void Telemetry::add_stages(Report& report) noexcept {
  if (stages_ == nullptr) return;
  using telemetry::FrameStage;
  report.has_stages = true;
  report.on_board_offset = stages_->on_board_offset();
  report.stages_done = stages_->done();
  report.stages_done[static_cast<std::size_t>(FrameStage::kTrigger)] = frames->trigger_time_ns;
  report.stages_done[static_cast<std::size_t>(FrameStage::kExposure)] = dots->time_ns;
  report.frame_timing.frame = frame_;
  report.frame_timing.time_ns = dots->time_ns;
  report.frame_timing.valid = true;
  report.frame_timing.sample_number = ++numbers_[static_cast<std::size_t>(TopicId::kFrameTiming)];
}

void Telemetry::add_acks(Report& report) noexcept {
  if (acks.source() == nullptr) return;
  for (telemetry::AckSample& ack : report.acks) {
    if (!acks.receive(ack.ack)) return;
    telemetry::fill(ack.ack, ack.sample);
    ack.sample.frame = frame_;
    ack.sample.sample_number = ++numbers_[static_cast<std::size_t>(TopicId::kCommandAck)];
    report.entries.push_back({.topic = TopicId::kCommandAck, .sample = &ack.sample, .ack = &ack});
  }
}

telemetry::SpacecraftStatus Telemetry::status() const noexcept {
  telemetry::SpacecraftStatus now;
  now.commands = *commands;
  if (parameter_state.source() != nullptr) now.parameters = *parameter_state;
  if (mode.source() != nullptr) now.mode = *mode;
  if (limit_counts.source() != nullptr) now.limits = *limit_counts;
  return now;
}

// With each health report, and whenever it has changed.
void Telemetry::add_status(Report& report, bool due) noexcept {
  if (commands.source() == nullptr) return;
  const telemetry::SpacecraftStatus now = status();
  const bool changed = !has_status_ || now != sent_status_;
  if (!changed && !due) return;
  has_status_ = true;
  sent_status_ = now;
  telemetry::fill(now, report.status);
  report.status.frame = frame_;
  report.status.time_ns = dots->time_ns;
  report.status.valid = true;
  add(report, report.status, numbers_[static_cast<std::size_t>(TopicId::kStatus)]);
}

// At first, and with each commit.
void Telemetry::add_parameters(Report& report) noexcept {
  if (parameters.source() == nullptr) return;
  if (has_parameters_ && parameters->number == sent_parameters_) return;
  has_parameters_ = true;
  sent_parameters_ = parameters->number;
  telemetry::fill(*parameters, parameter_entries_, report.parameters);
  report.parameters.frame = frame_;
  report.parameters.time_ns = dots->time_ns;
  report.parameters.valid = true;
  add(report, report.parameters, numbers_[static_cast<std::size_t>(TopicId::kParameters)]);
}

void Telemetry::add_events(Report& report) noexcept {
  for (telemetry::EventSample& event : report.events) {
    if (!take_event(event)) return;
    const EventRecord& record = event.record;
    event.sample.frame = frame_;
    event.sample.time_ns = record.time_ns;
    event.sample.sample_number = ++numbers_[static_cast<std::size_t>(TopicId::kEvent)];
    event.sample.valid = true;
    event.sample.id = record.id;
    event.sample.severity = static_cast<omma_EventSeverity>(record.severity);
    event.sample.held_back = record.held_back;
    event.sample.values._length = record.value_count;
    report.entries.push_back({.topic = TopicId::kEvent, .sample = &event.sample, .event = &event});
  }
}

bool Telemetry::take_event(telemetry::EventSample& event) noexcept {
  event.sample.runs_ago = 0;
  if (earlier_sent_ == earlier_.size()) return events_.take(event.record);
  event.record = earlier_[earlier_sent_].record;
  event.sample.runs_ago = earlier_[earlier_sent_].runs_ago;
  ++earlier_sent_;
  return true;
}

// What was not sent has a number all the same, so that the ground sees the gap. Events, health and timing are
// not lost: they wait for the next report.
void Telemetry::count_dropped() noexcept {
  ++numbers_[static_cast<std::size_t>(TopicId::kFrameSet)];
  ++numbers_[static_cast<std::size_t>(TopicId::kAttitude)];
  if (stages_ != nullptr) ++numbers_[static_cast<std::size_t>(TopicId::kFrameTiming)];
  ++numbers_[static_cast<std::size_t>(TopicId::kUnknownObjects)];
  if (image->valid) ++numbers_[static_cast<std::size_t>(TopicId::kImageChunk)];
  if (motion.source() != nullptr && motion->valid) ++numbers_[static_cast<std::size_t>(TopicId::kMotion)];
  const std::size_t count = std::min(names_.cameras.size(), dots->cameras.size());
  for (std::size_t c = 0; c < count; ++c) ++dots_numbers_[c];
  for (const PoseEstimate& pose : poses->bodies)
    if (pose.body < names_.bodies.size()) ++pose_numbers_[pose.body];
  if (approaches.source() == nullptr) return;
  for (const ApproachEstimate& approach : approaches->bodies)
    if (approach.body < names_.bodies.size()) ++approach_numbers_[approach.body];
}

}  // namespace omma
