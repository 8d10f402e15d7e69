#include "components/exposure/exposure.hpp"

namespace omma {

Exposure::Exposure(std::span<CameraDriver* const> drivers, std::span<const ExposureParameters> parameters,
                   Events& events)
    : events_(events) {
  cameras_.reserve(drivers.size());
  for (std::size_t c = 0; c < drivers.size(); ++c) {
    const ExposureParameters& p = parameters[c];
    cameras_.push_back({drivers[c], ExposureControl(p, drivers[c]->settings_range()), p.bracket_ns});
    report->cameras.push_back({.automatic = p.automatic && p.bracket_ns.empty()});
    if (!p.bracket_ns.empty()) report->cameras.back().state = ExposureState::kBracket;
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
    const bool bracketed = told.state == ExposureState::kBracket;
    if (!told.automatic && !bracketed) continue;
    if (bracketed) {
      bracket(c, tick);
    } else if (!cameras_[c].begun) {
      cameras_[c].begun = true;
      ask(c, cameras_[c].control.first(), tick);
    }
    const Frame& frame = frames->cameras[c];
    const bool usable = frame.status == FrameStatus::kFresh || frame.status == FrameStatus::kSaturated;
    if (!usable || frame.image.empty()) continue;
    told.seen = exposure_statistics(frame.image);
    if (!bracketed) control(c, frame.settings, tick);
  }
}

void Exposure::control(std::size_t c, const CameraSettings& taken, const Tick& tick) noexcept {
  CameraExposure& told = report->cameras[c];
  Controlled& camera = cameras_[c];
  CameraSettings wanted;
  if (camera.control.decide(told.seen, taken, wanted)) ask(c, wanted, tick);
  told.state = camera.control.state();
  const bool at_limit = told.state == ExposureState::kAtLimit;
  if (at_limit && !camera.at_limit)
    events_.raise<kExposureAtLimit>(tick, c, told.seen.level / told.seen.white, told.seen.full);
  camera.at_limit = at_limit;
}

// By the number of the frame set to come, so that all cameras of one bracket take turns together.
void Exposure::bracket(std::size_t c, const Tick& tick) noexcept {
  Controlled& camera = cameras_[c];
  CameraSettings wanted = camera.control.first();
  wanted.exposure_ns = camera.bracket_ns[(frames->number + 1) % camera.bracket_ns.size()];
  ask(c, wanted, tick);
}

void Exposure::ask(std::size_t c, const CameraSettings& settings, const Tick& tick) noexcept {
  Controlled& camera = cameras_[c];
  CameraExposure& told = report->cameras[c];
  const SettingsResult result = camera.driver->apply(settings);
  const bool accepted = result == SettingsResult::kAccepted;
  camera.control.answered(accepted);
  const bool bracketed = told.state == ExposureState::kBracket;
  if (!bracketed) told.settings = camera.control.settings();
  if (bracketed && accepted) told.settings = settings;
  if (accepted) {
    camera.refused_in_row = 0;
    return;
  }
  ++told.refused;
  events_.raise<kExposureRefused>(tick, c, 1e-3 * static_cast<double>(settings.exposure_ns), settings.gain,
                                  static_cast<int>(result));
  if (result != SettingsResult::kNoControl && ++camera.refused_in_row < kPatience) return;
  told.automatic = false;
  if (bracketed) told.state = ExposureState::kGood;
}

}  // namespace omma
