#include "components/imaging/exposure_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace omma {
namespace {

double level(const ImageView& image, int u, int v) {
  return image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
}

/// Light of one pixel [grey levels / s].
double fused(std::span<const ExposedImage> images, const FusionSensor& sensor, int u, int v) {
  FusedLight light;
  for (const ExposedImage& image : images) {
    const double grey = level(image.image, u, v);
    light.add({grey, grey, 1.0 * image.image.white_level, image.black, image.exposure}, sensor);
  }
  return light.light();
}

}  // namespace

void FusedLight::add(const ExposedLevel& seen, const FusionSensor& sensor, double unit,
                     double share) noexcept {
  if (seen.brightest >= sensor.full * seen.white) {
    bound_ = std::max(bound_, static_cast<float>(unit * (seen.white - seen.black) / seen.exposure));
    return;
  }
  const double signal = seen.level - seen.black;
  // Variance of the rate: photon noise by the signal, read noise, the rounding of the converter.
  const double electrons = std::max(signal, 0.0) * sensor.gain + sensor.read_noise * sensor.read_noise;
  const double relative = sensor.relative_noise * signal;
  const double variance = electrons / (sensor.gain * sensor.gain) + 1.0 / 12 + relative * relative;
  const double weight = share * seen.exposure * seen.exposure / (variance * unit * unit);
  weighted_ += static_cast<float>(weight * unit * signal / seen.exposure);
  weights_ += static_cast<float>(weight);
  if (share > 0) information_ += static_cast<float>(weight / share);
}

double FusedLight::light() const noexcept {
  if (weights_ > 0) return static_cast<double>(weighted_) / static_cast<double>(weights_);
  return bound_ > 0 ? static_cast<double>(bound_) : std::numeric_limits<double>::quiet_NaN();
}

double FusedLight::sigma() const noexcept {
  return information_ > 0 ? 1 / std::sqrt(static_cast<double>(information_))
                          : std::numeric_limits<double>::infinity();
}

bool FusedLight::says_something(double noise) const noexcept {
  constexpr double kPoor = 10;  // times the noise of the better exposures
  constexpr double kSure = 5;   // of its own
  if (!(weights_ > 0)) return bound_ > 0;
  return sigma() < kPoor * noise || light() > kSure * sigma();
}

bool fuse_exposures(std::span<const ExposedImage> images, const FusionSensor& sensor,
                    std::span<float> out) noexcept {
  if (images.empty() || images.front().image.empty()) return false;
  const ImageView& first = images.front().image;
  for (const ExposedImage& image : images) {
    if (image.image.empty() || image.image.width != first.width || image.image.height != first.height ||
        !(image.exposure > 0))
      return false;
  }
  if (out.size() < static_cast<std::size_t>(first.width) * static_cast<std::size_t>(first.height))
    return false;
  for (int v = 0; v < first.height; ++v)
    for (int u = 0; u < first.width; ++u)
      out[static_cast<std::size_t>(v) * static_cast<std::size_t>(first.width) + static_cast<std::size_t>(u)] =
          static_cast<float>(fused(images, sensor, u, v));
  return true;
}

}  // namespace omma
