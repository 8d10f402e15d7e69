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
  for (std::size_t c = 0; c < drivers_.size(); ++c) {
    Frame& frame = frames->cameras[c];
    frame = drivers_[c]->grab(trigger->number, trigger->time_ns);
    tell(tick, c);
    if (frame.status == FrameStatus::kMissing) continue;
    // A frame of an earlier trigger is no frame of this one; the same one again and again is a dead camera.
    repeats_[c] = frame.number == last_number_[c] && trigger->number > 0 ? repeats_[c] + 1 : 0;
    last_number_[c] = frame.number;
    if (repeats_[c] >= kStuckAfter) {
      frame.status = FrameStatus::kStuck;
    } else if (frame.number < trigger->number) {
      frame.status = FrameStatus::kLate;
    }
  }
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
