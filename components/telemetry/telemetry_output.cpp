// The life of the telemetry thread.
#include "components/telemetry/telemetry_output.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>

#include "components/telemetry/samples.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/services/event_text.hpp"

namespace omma {
namespace {

// The writer never wakes the thread (that would be a system call in a real-time step), so it looks by itself.
constexpr std::chrono::milliseconds kLookEvery{5};
constexpr int kNiceness = 10;

}  // namespace

TelemetryOutput::TelemetryOutput(Telemetry& telemetry, std::vector<EventDescriptor> events,
                                 CommandVocabulary words)
    : telemetry_(telemetry), reports_(telemetry.reports()), events_(std::move(events)), words_(words) {}

TelemetryOutput::~TelemetryOutput() {
  if (thread_.joinable()) stop();
}

void TelemetryOutput::judge_latency(const telemetry::PerStage<>& budgets, Events* events) {
  latency_ = std::make_unique<telemetry::FrameLatency>(budgets);
  late_events_ = events;
}

void TelemetryOutput::start() {
  if (latency_ == nullptr) judge_latency({}, nullptr);
  thread_ = std::thread([this] { serve(); });
}

void TelemetryOutput::serve() {
  // On Linux a thread has a niceness of its own; refused, it runs as any other.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
  std::unique_lock lock(mutex_);
  while (true) {
    const bool last_round = ending_;
    hurry_ = false;
    lock.unlock();
    while (write_one()) room_.notify_one();
    lock.lock();
    if (last_round) return;
    wake_.wait_for(lock, kLookEvery, [this] { return hurry_ || ending_; });
  }
}

void TelemetryOutput::wait_for_room() {
  while (!reports_.has_room()) {
    std::unique_lock lock(mutex_);
    hurry_ = true;
    wake_.notify_one();
    room_.wait_for(lock, kLookEvery);
  }
}

void TelemetryOutput::stop() {
  if (!thread_.joinable()) return;
  do {
    wait_for_room();
  } while (telemetry_.send_rest());
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
  for (const auto& sink : sinks_) sink->close();
}

std::vector<std::string> TelemetryOutput::failures() const {
  std::vector<std::string> failures;
  for (const auto& sink : sinks_)
    if (std::string failure = sink->failure(); !failure.empty()) failures.push_back(std::move(failure));
  return failures;
}

bool TelemetryOutput::write_one() {
  telemetry::FrameReport* report = reports_.front();
  if (report == nullptr) return false;
  for (const telemetry::FrameReport::Entry& entry : report->entries) write(entry);
  if (report->has_stages) write_frame_timing(*report);
  reports_.release();
  std::uint64_t lost = 0;
  for (const auto& sink : sinks_) lost += sink->is_log() ? sink->lost() : 0;
  reports_.set_log_lost(lost);
  return true;
}

void TelemetryOutput::write(const telemetry::FrameReport::Entry& entry) {
  if (entry.event != nullptr) set_texts(*entry.event);
  if (entry.ack != nullptr) telemetry::set_text(entry.ack->sample.text, ack_text(entry.ack->ack, words_));
  const std::span<const std::byte> cdr = cdr_.write(entry.topic, entry.sample);
  for (const auto& sink : sinks_) sink->write(entry.topic, entry.sample, cdr);
}

void TelemetryOutput::write_frame_timing(telemetry::FrameReport& report) {
  using telemetry::FrameStage;
  report.stages_done[static_cast<std::size_t>(FrameStage::kPublished)] =
      MonotonicClock().now() + report.on_board_offset;
  const FrameStage late = latency_->add(report.stages_done, report.frame_timing);
  write({telemetry::TopicId::kFrameTiming, &report.frame_timing, nullptr});
  if (late == FrameStage::kTrigger || late_events_ == nullptr) return;
  const auto stage = static_cast<std::size_t>(late);
  const TimeNs latency = elapsed(report.stages_done[0], report.stages_done[stage]);
  late_events_->raise<telemetry::kFrameLate>(
      Tick{report.frame_timing.frame, report.stages_done[stage]}, report.frame_timing.frame, stage,
      static_cast<double>(latency) * 1e-6, static_cast<double>(latency_->budget(late)) * 1e-6);
}

void TelemetryOutput::set_texts(telemetry::EventSample& event) const {
  const EventDescriptor* const declared = find_event(events_, event.record.id);
  telemetry::set_text(event.sample.name, event_name(declared, event.record.id));
  telemetry::set_text(event.sample.text,
                      declared != nullptr ? event_text(*declared, event.record) : std::string());
}

}  // namespace omma
