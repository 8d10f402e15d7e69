// Trigger watch: holds the frames of fired cameras against the pulses that were sent, by time, and names what
// was lost, late or of no pulse. Frames of a recording carry the numbers of their triggers and agree by
// themselves.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "components/camera/frames.hpp"
#include "components/camera/trigger_matching.hpp"
#include "components/sync_trigger/trigger.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/events.hpp"

namespace omma {

inline constexpr EventDescriptor kTriggersWithoutFrame{
    .id = 67,
    .severity = EventSeverity::kWarning,
    .name = "triggers_without_frame",
    .text = "camera {0}: {1} triggers before that of frame set {2} got no frame",
    .values = {{{"camera"}, {"count"}, {"frame"}}}};

inline constexpr EventDescriptor kFrameOfEarlierTrigger{
    .id = 68,
    .severity = EventSeverity::kWarning,
    .name = "frame_of_earlier_trigger",
    .text = "camera {0}: the frame of trigger {1} came {2} triggers later than usual",
    .values = {{{"camera"}, {"frame"}, {"triggers"}}}};

inline constexpr EventDescriptor kFrameOfNoTrigger{
    .id = 69,
    .severity = EventSeverity::kWarning,
    .name = "frame_of_no_trigger",
    .text = "camera {0}: a frame of no trigger, {1} from where the nearest one's would be",
    .values = {{{"camera"}, {"offset", "ms"}}}};

inline constexpr std::array kTriggerWatchEvents{kTriggersWithoutFrame, kFrameOfEarlierTrigger,
                                                kFrameOfNoTrigger};
static_assert(are_unique(kTriggerWatchEvents) && are_well_formed(kTriggerWatchEvents));

class TriggerWatch final : public Component {
 public:
  /// @param cameras  of the rig
  TriggerWatch(std::size_t cameras, const TriggerMatchOptions& options, Events& events);

  In<Trigger> trigger;
  In<Frames> frames;

  std::string_view name() const override { return "trigger_watch"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

  /// Triggers of a camera that got no frame, so far.
  std::uint64_t lost(std::size_t camera) const { return cameras_[camera].matching.lost(); }

 private:
  struct Camera {
    TriggerMatching matching;
    TimeNs last_stamp_ns = 0;
    bool seen = false;        // a frame was matched
    std::uint64_t usual = 0;  // triggers between a frame's own and the one at which it is taken
  };
  void look(const Tick& tick, std::size_t index, TimeNs stamp_ns) noexcept;

  std::vector<Camera> cameras_;
  Events& events_;
};

}  // namespace omma
