#include "components/imaging/rig_exposures.hpp"

#include <algorithm>
#include <cmath>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kUnknownElectrons = 2;  // a grey level, where the mission does not say

constexpr int kEnough = 1'000'000;  // the counts stand still there

}  // namespace

// A camera without a frame so far does not count.
bool RigExposures::electrons_known() const noexcept {
  for (std::size_t c = 0; c < cameras_; ++c)
    if (sensors_[c].electrons <= 0) return false;
  return true;
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
    const Frame& frame = frames.cameras[c];
    const CameraSensor& sensor = sensors_[c];
    CameraExposed& to = exposed_[c];
    to.exposure = 0;
    const auto gain = static_cast<double>(frame.settings.gain);
    if (usable_image(frame).empty() || frame.settings.exposure_ns <= 0 || !(gain > 0)) continue;
    // As gain 1 would have taken it: an amplified grey level is fewer electrons.
    const double exposure = 1e-9 * static_cast<double>(frame.settings.exposure_ns) * gain;
    const double white = frame.image.white_level;
    if (sensor.linear) to.exposure = exposure;
    to.black =
        frame.settings.black_level > 0 ? static_cast<double>(frame.settings.black_level) : sensor.black_level;
    to.unit = white_[c] / fewest_ / white;
    to.sensor.gain = (sensor.electrons > 0 ? sensor.electrons : kUnknownElectrons) / gain;
    to.sensor.read_noise = sensor.read_noise;
    if (!sensor.linear) continue;
    any = true;
    const double noise = root_sum_square(sensor.read_noise / to.sensor.gain, std::sqrt(1.0 / 12));
    const double least = to.unit * noise / exposure;
    const double most = to.unit * (white - to.black) / exposure;
    least_ = told_ == 0 && least_ == 0 ? least : std::min(least_, least);
    most_ = std::max(most_, most);
  }
  if (any && told_ < kEnough) ++told_;
  if (frame_sets_ < kEnough) ++frame_sets_;
}

double RigExposures::scale(std::size_t camera, double reference) const noexcept {
  if (camera >= cameras_ || !(white_[camera] > 0)) return 1;
  const double exposure = exposed_[camera].exposure;
  return white_[camera] / fewest_ * (reference > 0 && exposure > 0 ? reference / exposure : 1);
}

double RigExposures::reference_exposure() const noexcept {
  double longest = 0;
  for (const CameraExposed& camera : exposed_) longest = std::max(longest, camera.exposure);
  return longest;
}

GreyScale RigExposures::fused_scale(int bits) const noexcept {
  return {.scale = ImageScale::kAsinh, .bits = bits, .most = most_, .soft = 3 * least_};
}

}  // namespace omma
