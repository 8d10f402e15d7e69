#include "components/camera/trigger_watch.hpp"

namespace omma {

TriggerWatch::TriggerWatch(std::size_t cameras, const TriggerMatchOptions& options, Events& events)
    : cameras_(cameras, Camera{.matching = TriggerMatching(options)}), events_(events) {}

void TriggerWatch::visit_ports(PortVisitor& visitor) const {
  visitor.input("trigger", trigger);
  visitor.input("frames", frames);
}

void TriggerWatch::step(const Tick& tick) noexcept {
  const std::size_t count = std::min<std::size_t>(cameras_.size(), frames->cameras.size());
  for (std::size_t c = 0; c < count; ++c) {
    Camera& camera = cameras_[c];
    if (trigger->sent) camera.matching.add_trigger(trigger->number, trigger->time_ns);
    const Frame& frame = frames->cameras[c];
    // A frame that is there still, because none came after it, was looked at before.
    if (frame.status == FrameStatus::kMissing || frame.exposure_midpoint_ns == camera.last_stamp_ns) continue;
    camera.last_stamp_ns = frame.exposure_midpoint_ns;
    look(tick, c, frame.exposure_midpoint_ns);
  }
}

void TriggerWatch::look(const Tick& tick, std::size_t index, TimeNs stamp_ns) noexcept {
  Camera& camera = cameras_[index];
  const TriggerMatch match = camera.matching.match(stamp_ns);
  if (match.kind == MatchKind::kRepeated) return;
  if (match.kind == MatchKind::kStray) {
    events_.raise<kFrameOfNoTrigger>(tick, index, static_cast<double>(match.offset_ns) * 1e-6);
    return;
  }
  if (!camera.seen) {
    // What was sent before the camera's first frame was sent while it started.
    camera.seen = true;
    camera.usual = match.behind;
    return;
  }
  if (match.lost > 0) events_.raise<kTriggersWithoutFrame>(tick, index, match.lost, match.number);
  if (match.behind > camera.usual)
    events_.raise<kFrameOfEarlierTrigger>(tick, index, match.number, match.behind - camera.usual);
}

}  // namespace omma
