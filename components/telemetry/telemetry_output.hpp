// The telemetry thread: takes the reports that Telemetry filled, in order, makes the events' sentences,
// serialises each sample once and gives it to every sink. An ordinary thread, one that yields to others:
// writing to DDS or to a disk allocates and may take milliseconds.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "components/telemetry/cdr.hpp"
#include "components/telemetry/frame_latency.hpp"
#include "components/telemetry/sink.hpp"
#include "components/telemetry/telemetry.hpp"
#include "fsw/services/command_text.hpp"

namespace omma {

class TelemetryOutput {
 public:
  /// @param events  every event the program can raise: what their names and sentences are made of
  /// @param words   of the commands it takes, likewise; they outlive this
  TelemetryOutput(Telemetry& telemetry, std::vector<EventDescriptor> events, CommandVocabulary words = {});
  ~TelemetryOutput();
  TelemetryOutput(const TelemetryOutput&) = delete;
  TelemetryOutput& operator=(const TelemetryOutput&) = delete;

  /// Before `start`.
  void add(std::unique_ptr<telemetry::Sink> sink) { sinks_.push_back(std::move(sink)); }
  /// Before `start`: what each frame set's way is measured against.
  /// @param events  told of frame sets beyond their budgets; null in a replay, which must not depend on them
  void judge_latency(const telemetry::PerStage<>& budgets, Events* events);
  void start();

  /// Lockstep, between two ticks, on the scheduler's thread: returns when the next step will find room.
  void wait_for_room();

  /// After the scheduler has returned, on the thread that ran it: writes all that is left, ends the thread,
  /// closes the sinks.
  void stop();

  /// What went wrong at the sinks, a sentence each. After `stop`.
  std::vector<std::string> failures() const;

 private:
  void serve();
  bool write_one();
  void write(const telemetry::FrameReport::Entry& entry);
  void write_frame_timing(telemetry::FrameReport& report);
  void set_texts(telemetry::EventSample& event) const;

  Telemetry& telemetry_;
  telemetry::ReportQueue& reports_;
  const std::vector<EventDescriptor> events_;
  const CommandVocabulary words_;
  std::vector<std::unique_ptr<telemetry::Sink>> sinks_;
  telemetry::CdrWriter cdr_;
  std::unique_ptr<telemetry::FrameLatency> latency_;
  Events* late_events_ = nullptr;

  std::thread thread_;
  std::mutex mutex_;  // for sleeping and waking; the reports themselves are passed without it
  std::condition_variable wake_;
  std::condition_variable room_;
  bool hurry_ = false;
  bool ending_ = false;
};

}  // namespace omma
