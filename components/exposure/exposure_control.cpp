#include "components/exposure/exposure_control.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double kMostUp = 2, kMostDown = 4;  // factors of one step
constexpr double kLeastTurn = 1.05;           // smaller steps are not asked for
constexpr int kLongestWait = 20;              // frames, for a camera that says it does something else
// The background stands so many standard deviations over 0: below the first it is raised, above the second
// lowered.
constexpr double kLeastRoom = 4, kMostRoom = 24, kRoom = 8;
constexpr double kLeastBlackStep = 1;  // [grey levels]

double sensitivity(const CameraSettings& settings) {
  return static_cast<double>(settings.exposure_ns) * static_cast<double>(settings.gain);
}

// As near as the camera's own steps come.
bool alike(const CameraSettings& a, const CameraSettings& b) {
  const double ratio = sensitivity(a) / std::max(1.0, sensitivity(b));
  return ratio > 0.9 && ratio < 1.1 && std::abs(a.black_level - b.black_level) < 1.0F;
}

}  // namespace

ExposureControl::ExposureControl(const ExposureParameters& parameters, const CameraSettingsRange& range)
    : parameters_(parameters), range_(range) {
  range_.least.exposure_ns =
      std::clamp(parameters.shortest_ns, range.least.exposure_ns, range.most.exposure_ns);
  range_.most.exposure_ns =
      std::clamp(parameters.longest_ns, range_.least.exposure_ns, range.most.exposure_ns);
  range_.most.gain = std::clamp(static_cast<float>(parameters.most_gain), range.least.gain, range.most.gain);
  now_ = asked_ = first();
}

CameraSettings ExposureControl::first() const {
  return {range_.most.exposure_ns, range_.least.gain,
          0.5F * (range_.least.black_level + range_.most.black_level)};
}

// Time first: it brings photons, gain does not.
CameraSettings ExposureControl::with_sensitivity(double wanted) const {
  CameraSettings settings = now_;
  const auto least_gain = static_cast<double>(range_.least.gain);
  const double exposure = std::clamp(wanted / least_gain, static_cast<double>(range_.least.exposure_ns),
                                     static_cast<double>(range_.most.exposure_ns));
  settings.exposure_ns = static_cast<TimeNs>(std::llround(exposure));
  settings.gain =
      static_cast<float>(std::clamp(wanted / exposure, least_gain, static_cast<double>(range_.most.gain)));
  return settings;
}

// By what the sensitivity is to be multiplied; 1 within the bounds.
double ExposureControl::wanted_ratio(const ExposureStatistics& frame) noexcept {
  const double range = frame.white - static_cast<double>(now_.black_level);
  const double over = std::max(1e-6, (frame.level - static_cast<double>(now_.black_level)) / range);
  ++since_full_;
  if (frame.full > parameters_.most_full) {
    ceiling_ = sensitivity(now_);
    since_full_ = 0;
    return 1 / kMostDown;
  }
  if (over > parameters_.bright) return std::max(1 / kMostDown, parameters_.target / over);
  if (over >= parameters_.dark || frame.noise >= parameters_.enough_noise) return 1;
  double ratio = std::clamp(parameters_.target / over, 1.0, kMostUp);
  if (since_full_ > parameters_.patience) ceiling_ = 0;
  // Not back to where pixels were full, nor near it: half of it at most.
  if (ceiling_ > 0) ratio = std::max(1.0, std::min(ratio, 0.5 * ceiling_ / sensitivity(now_)));
  return ratio;
}

double ExposureControl::wanted_black_level(const ExposureStatistics& frame) const noexcept {
  const double noise = std::max(frame.noise, 0.3);
  const auto now = static_cast<double>(now_.black_level);
  double wanted = now;
  if (frame.level < kLeastRoom * noise || frame.clipped > 0.01) wanted = now + kRoom * noise - frame.level;
  // Only where the black level is what keeps the background up.
  if (frame.level > kMostRoom * noise && now > kRoom * noise)
    wanted = now - std::min(frame.level, now) + kRoom * noise;
  if (std::abs(wanted - now) < kLeastBlackStep) wanted = now;
  return std::clamp(wanted, static_cast<double>(range_.least.black_level),
                    static_cast<double>(range_.most.black_level));
}

// A frame taken before the change says nothing about it.
bool ExposureControl::still_on_its_way(const CameraSettings& taken) noexcept {
  if (state_ != ExposureState::kWaiting) return false;
  ++waited_;
  if (taken.exposure_ns > 0) return !alike(taken, now_) && waited_ < kLongestWait;
  return waited_ < parameters_.settle;
}

bool ExposureControl::decide(const ExposureStatistics& frame, const CameraSettings& taken,
                             CameraSettings& wanted) noexcept {
  if (still_on_its_way(taken)) return false;
  const double ratio = wanted_ratio(frame);
  wanted = with_sensitivity(ratio * sensitivity(now_));
  wanted.black_level = static_cast<float>(wanted_black_level(frame));
  const double turn = sensitivity(wanted) / sensitivity(now_);
  const bool turned = turn > kLeastTurn || turn < 1 / kLeastTurn;
  if (!turned) {
    wanted.exposure_ns = now_.exposure_ns;
    wanted.gain = now_.gain;
  }
  const bool asks = turned || wanted.black_level != now_.black_level;
  state_ = asks ? ExposureState::kWaiting : ratio == 1 ? ExposureState::kGood : ExposureState::kAtLimit;
  asked_ = wanted;
  return asks;
}

void ExposureControl::answered(bool accepted) noexcept {
  waited_ = 0;
  if (accepted) now_ = asked_;
}

}  // namespace omma
