#include "components/imaging/exposure_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace omma {
namespace {

double level(const ImageView& image, int u, int v) {
  return image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
}

/// Light of one pixel [grey levels / s].
double fused(std::span<const ExposedImage> images, const FusionSensor& sensor, int u, int v) {
  double weighted = 0;
  double weights = 0;
  const ExposedImage* shortest = &images.front();
  for (const ExposedImage& image : images) {
    if (image.exposure < shortest->exposure) shortest = &image;
    const double grey = level(image.image, u, v);
    if (grey >= sensor.full * image.image.white_level) continue;
    const double signal = grey - image.black;
    // Variance of the rate: photon noise by the signal, read noise, the rounding of the converter.
    const double electrons = std::max(signal, 0.0) * sensor.gain + sensor.read_noise * sensor.read_noise;
    const double variance = electrons / (sensor.gain * sensor.gain) + 1.0 / 12;
    const double weight = image.exposure * image.exposure / variance;
    weighted += weight * signal / image.exposure;
    weights += weight;
  }
  if (weights > 0) return weighted / weights;
  return (shortest->image.white_level - shortest->black) / shortest->exposure;
}

}  // namespace

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
