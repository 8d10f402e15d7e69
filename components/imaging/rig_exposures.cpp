#include "components/imaging/rig_exposures.hpp"

#include <algorithm>
#include <cmath>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kUnknownElectrons = 2;  // a grey level, where the mission does not say

constexpr int kEnough = 1'000'000;  // the counts stand still there
constexpr int kLevels = 65536;

}  // namespace

// A camera without a frame so far does not count.
bool RigExposures::electrons_known() const noexcept {
  for (std::size_t c = 0; c < cameras_; ++c)
    if (sensors_[c].electrons <= 0) return false;
  return true;
}

RigExposures::RigExposures(const std::array<CameraSensor, limits::kCameras>& sensors) : sensors_(sensors) {
  for (std::size_t c = 0; c < sensors_.size(); ++c)
    if (!sensors_[c].response.empty()) even_[c].levels.resize(kLevels);
}

void RigExposures::take(const Frames& frames) noexcept {
  cameras_ = std::min(frames.cameras.size(), sensors_.size());
  const bool known = electrons_known();
  fewest_ = 0;
  for (std::size_t c = 0; c < cameras_; ++c) {
    const Frame& frame = frames.cameras[c];
    if (!usable_image(frame).empty()) white_[c] = known ? sensors_[c].electrons * frame.image.white_level : 1;
    if (white_[c] > 0) fewest_ = fewest_ == 0 ? white_[c] : std::min(fewest_, white_[c]);
  }
  bool any = false;
  for (std::size_t c = 0; c < cameras_; ++c) {
    take(c, frames.cameras[c]);
    any = any || exposed_[c].exposure > 0;
  }
  if (any && told_ < kEnough) ++told_;
  if (frame_sets_ < kEnough) ++frame_sets_;
}

void RigExposures::take(std::size_t c, const Frame& frame) noexcept {
  const CameraSensor& sensor = sensors_[c];
  CameraExposed& to = exposed_[c];
  to.exposure = 0;
  const auto gain = static_cast<double>(frame.settings.gain);
  if (usable_image(frame).empty() || frame.settings.exposure_ns <= 0 || !(gain > 0)) return;
  // As gain 1 would have taken it: an amplified grey level is fewer electrons.
  to.exposure = 1e-9 * static_cast<double>(frame.settings.exposure_ns) * gain;
  to.black =
      frame.settings.black_level > 0 ? static_cast<double>(frame.settings.black_level) : sensor.black_level;
  to.white = frame.image.white_level;
  to.unit = white_[c] / fewest_ / to.white;
  to.sensor.gain = (sensor.electrons > 0 ? sensor.electrons : kUnknownElectrons) / gain;
  to.sensor.read_noise = sensor.read_noise;
  to.sensor.relative_noise = sensor.relative_noise;
  if (EvenTable& even = even_[c]; !even.levels.empty()) {
    if (frame.image.white_level != even.white || to.black != even.black) {
      even.white = frame.image.white_level;
      even.black = to.black;
      sensor.response.even_levels(even.white, even.black, even.levels);
    }
    to.even = even.levels;
    to.white = kLevels - 1;
  }
  const double noise = root_sum_square(sensor.read_noise / to.sensor.gain, std::sqrt(1.0 / 12));
  const double least = to.unit * noise / to.exposure;
  least_ = told_ == 0 && least_ == 0 ? least : std::min(least_, least);
  most_ = std::max(most_, to.unit * (to.white - to.black) / to.exposure);
}

double RigExposures::scale(std::size_t camera, double reference) const noexcept {
  if (camera >= cameras_ || !(white_[camera] > 0)) return 1;
  const double exposure = exposed_[camera].even.empty() ? exposed_[camera].exposure : 0;
  return white_[camera] / fewest_ * (reference > 0 && exposure > 0 ? reference / exposure : 1);
}

double RigExposures::reference_exposure() const noexcept {
  double longest = 0;
  for (const CameraExposed& camera : exposed_)
    if (camera.even.empty()) longest = std::max(longest, camera.exposure);
  return longest;
}

GreyScale RigExposures::fused_scale(int bits) const noexcept {
  return {.scale = ImageScale::kAsinh, .bits = bits, .most = most_, .soft = 3 * least_};
}

}  // namespace omma
