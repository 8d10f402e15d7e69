#include "components/exposure/exposure.hpp"

namespace omma {

Exposure::Exposure(std::span<CameraDriver* const> drivers, std::span<const ExposureParameters> parameters,
                   Events& events)
    : events_(events) {
  cameras_.reserve(drivers.size());
  for (std::size_t c = 0; c < drivers.size(); ++c) {
    cameras_.push_back({drivers[c], ExposureControl(parameters[c], drivers[c]->settings_range())});
    report->cameras.push_back({.automatic = parameters[c].automatic});
  }
}

void Exposure::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.output("report", report);
}

void Exposure::step(const Tick& tick) noexcept {
  report->frame = frames->number;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    CameraExposure& told = report->cameras[c];
    Controlled& camera = cameras_[c];
    if (!told.automatic) continue;
    if (!camera.begun) {
      camera.begun = true;
      ask(c, camera.control.first(), tick);
    }
    const Frame& frame = frames->cameras[c];
    const bool usable = frame.status == FrameStatus::kFresh || frame.status == FrameStatus::kSaturated;
    if (!usable || frame.image.empty()) continue;
    told.seen = exposure_statistics(frame.image);
    CameraSettings wanted;
    if (camera.control.decide(told.seen, frame.settings, wanted)) ask(c, wanted, tick);
    told.state = camera.control.state();
    const bool at_limit = told.state == ExposureState::kAtLimit;
    if (at_limit && !camera.at_limit)
      events_.raise<kExposureAtLimit>(tick, c, told.seen.level / told.seen.white, told.seen.full);
    camera.at_limit = at_limit;
  }
}

void Exposure::ask(std::size_t c, const CameraSettings& settings, const Tick& tick) noexcept {
  Controlled& camera = cameras_[c];
  CameraExposure& told = report->cameras[c];
  const SettingsResult result = camera.driver->apply(settings);
  const bool accepted = result == SettingsResult::kAccepted;
  camera.control.answered(accepted);
  told.settings = camera.control.settings();
  if (accepted) {
    camera.refused_in_row = 0;
    return;
  }
  ++told.refused;
  events_.raise<kExposureRefused>(tick, c, 1e-3 * static_cast<double>(settings.exposure_ns), settings.gain,
                                  static_cast<int>(result));
  if (result == SettingsResult::kNoControl || ++camera.refused_in_row >= kPatience) told.automatic = false;
}

}  // namespace omma
