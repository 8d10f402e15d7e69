#include "components/camera/cameras.hpp"

namespace omma {

Cameras::Cameras(std::span<CameraDriver* const> drivers, Events& events) : events_(events) {
  for (CameraDriver* driver : drivers) drivers_.push_back(driver);
  frames->cameras.resize(drivers_.size());
}

void Cameras::visit_ports(PortVisitor& visitor) const {
  visitor.input("trigger", trigger);
  visitor.output("frames", frames);
}

void Cameras::step(const Tick& tick) noexcept {
  frames->number = trigger->number;
  frames->trigger_time_ns = trigger->time_ns;
  since_last_trigger_ns_ = trigger->number > 0 ? elapsed(last_trigger_ns_, trigger->time_ns) : 0;
  last_trigger_ns_ = trigger->time_ns;
  for (std::size_t c = 0; c < drivers_.size(); ++c) {
    Frame& frame = frames->cameras[c];
    frame = drivers_[c]->grab(trigger->number, trigger->time_ns);
    tell(tick, c);
    frame.status = judge(frame, c);
    const bool rejected = frame.status == FrameStatus::kLate || frame.status == FrameStatus::kStuck ||
                          frame.status == FrameStatus::kMismatched;
    if (rejected) ++frames->rejected[c];
  }
}

// A frame of another trigger is no frame of this one; the same one again and again is a dead camera.
FrameStatus Cameras::judge(const Frame& frame, std::size_t camera) noexcept {
  if (frame.status == FrameStatus::kMissing) return frame.status;
  const bool repeated = frame.number == last_number_[camera] && trigger->number > 0;
  repeats_[camera] = repeated ? repeats_[camera] + 1 : 0;
  last_number_[camera] = frame.number;
  if (repeats_[camera] >= kStuckAfter) return FrameStatus::kStuck;
  if (frame.number < trigger->number) return FrameStatus::kLate;
  if (frame.number > trigger->number) return FrameStatus::kMismatched;
  const TimeNs from_trigger = elapsed(trigger->time_ns, frame.exposure_midpoint_ns);
  // Free-running cameras' frames are collected up to two periods after their exposure.
  const bool another_trigger = since_last_trigger_ns_ > 0 && (from_trigger >= since_last_trigger_ns_ ||
                                                              from_trigger <= -2 * since_last_trigger_ns_);
  return another_trigger ? FrameStatus::kMismatched : frame.status;
}

void Cameras::tell(const Tick& tick, std::size_t camera) noexcept {
  const CameraHealth now = drivers_[camera]->health();
  CameraHealth& told = told_[camera];
  if (now.losses != told.losses) events_.raise<kCameraLost>(tick, camera, now.losses);
  if (now.connected && !told.connected) events_.raise<kCameraBack>(tick, camera);
  const auto lost = [](const CameraHealth& health) { return health.gaps + health.damaged + health.overrun; };
  if (lost(now) != lost(told)) {
    events_.raise<kCameraFramesLost>(tick, camera, now.gaps - told.gaps, now.damaged - told.damaged,
                                     now.overrun - told.overrun);
  }
  if (now.unmatched != told.unmatched)
    events_.raise<kCameraFramesUnmatched>(tick, camera, now.unmatched - told.unmatched);
  told = now;
}

bool Cameras::at_end() const noexcept {
  for (const CameraDriver* driver : drivers_) {
    if (!driver->at_end()) return false;
  }
  return true;
}

}  // namespace omma
