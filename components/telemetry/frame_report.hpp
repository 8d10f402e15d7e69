// FrameReport: everything telemetry says about one frame set, as the C structs of the IDL with all their
// storage inside. Filled in a step, written out by the telemetry thread.
#pragma once

#include <array>
#include <vector>

#include "components/motion/motion_report.hpp"
#include "components/telemetry/frame_stages.hpp"
#include "components/telemetry/topics.hpp"
#include "config/limits.hpp"
#include "config/sky_limits.hpp"
#include "fsw/kernel/fixed_string.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/event.hpp"

namespace omma::telemetry {

/// Names that samples carry, in the order of the rig and of the mission.
struct TelemetryNames {
  StaticVector<Name, limits::kCameras> cameras;
  StaticVector<Name, limits::kTargetBodies> bodies;
  StaticVector<Name, kMostAxes> axes;  ///< in the order of the gimbal; none where there is none
};

/// An event on its way: the numbers; its name and its sentence are made off the real-time path.
struct EventSample {
  omma_Event sample{};
  EventRecord record;
};

/// The same for what is said about a command.
struct AckSample {
  omma_CommandAck sample{};
  CommandAck ack;
};

class FrameReport {
 public:
  static constexpr std::size_t kEvents = 16;  ///< more wait for the next frame set
  static constexpr std::size_t kAcks = 16;    ///< likewise

  /// Allocates the dots of so many cameras; nothing afterwards.
  explicit FrameReport(const TelemetryNames& names);
  FrameReport(const FrameReport&) = delete;
  FrameReport& operator=(const FrameReport&) = delete;

  /// One sample to send. `event` or `ack` is set where the sample still wants its texts.
  struct Entry {
    TopicId topic = TopicId::kFrameSet;
    const void* sample = nullptr;
    EventSample* event = nullptr;
    AckSample* ack = nullptr;
  };
  static constexpr std::size_t kEntries = 1 + limits::kCameras + 1 + 2 * limits::kTargetBodies + 3 + kEvents +
                                          kAcks + 5;  // as the members below, but frame_timing
  StaticVector<Entry, kEntries> entries;              ///< in the order they are sent

  omma_FrameSet frame_set{};
  std::array<omma_CameraDots, limits::kCameras> dots{};
  omma_Attitude attitude{};
  std::array<omma_RelativePose, limits::kTargetBodies> poses{};
  omma_UnknownObjects objects{};
  std::array<omma_Approach, limits::kTargetBodies> approaches{};
  omma_ImageChunk image_chunk{};
  std::array<EventSample, kEvents> events{};
  std::array<AckSample, kAcks> acks{};
  omma_Status status{};
  omma_Parameters parameters{};
  omma_Health health{};
  omma_Timing timing{};
  omma_Motion motion{};
  omma_UtcCorrelation utc{};

  // Completed and sent last by the telemetry thread, where the frame set's way ends.
  bool has_stages = false;
  PerStage<> stages_done{};    // on-board time of each but the last
  TimeNs on_board_offset = 0;  // from the stopwatch's time to on-board time
  omma_FrameTiming frame_timing{};

 private:
  std::vector<omma_Dot> dot_storage_;
  std::vector<std::uint8_t> pixels_;
  std::array<omma_CameraStatus, limits::kCameras> cameras_{};
  std::array<omma_UnknownObject, limits::kUnknownObjects> objects_{};
  std::array<omma_GroupHealth, limits::kRateGroups> groups_{};
  std::array<omma_StepTiming, limits::kComponents> steps_{};
  std::array<omma_StageTiming, kFrameStages> stages_{};
  std::array<omma_AxisCommand, kMostAxes> axes_{};
  std::array<omma_ParameterValue, limits::kParameterIds> parameters_{};
};

}  // namespace omma::telemetry
