#include "components/exposure/exposure_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace omma {
namespace {

constexpr int kStride = 8;
constexpr int kBins = 4096;  // of 16 bits: the upper ones
constexpr double kRootTwoPi = 2.5066283;

template <class Pixel>
ExposureStatistics statistics(const ImageView& image) noexcept {
  int shift = 0;
  while ((image.white_level >> shift) >= kBins) ++shift;
  std::array<std::uint32_t, kBins> count{};
  std::uint32_t samples = 0, full = 0, clipped = 0;
  for (int v = kStride / 2; v < image.height; v += kStride) {
    const Pixel* x = image.row<Pixel>(v);
    for (int u = kStride / 2; u < image.width; u += kStride, ++samples) {
      ++count[static_cast<std::size_t>(std::min<int>(x[u] >> shift, kBins - 1))];
      full += x[u] >= image.white_level ? 1 : 0;
      clipped += x[u] == 0 ? 1 : 0;
    }
  }
  ExposureStatistics result;
  result.white = image.white_level;
  if (samples == 0) return result;
  std::uint32_t below = 0;
  std::size_t bin = 0;
  while (2 * (below + count[bin]) < samples) below += count[bin++];
  // Each level is taken as a bin one level wide, as in the background map.
  const double part = (0.5 * samples - below) / count[bin];
  double deviation = 0;  // Σ max(0, median − x)
  for (std::size_t k = 0; k < bin; ++k)
    deviation += static_cast<double>(count[k]) * static_cast<double>(bin - k);
  deviation += (part - 0.5) * below + 0.5 * part * part * count[bin];
  const double width = 1 << shift;
  result.level = width * (static_cast<double>(bin) + part) - 0.5;
  result.noise = width * deviation * kRootTwoPi / samples;
  result.full = static_cast<double>(full) / samples;
  result.clipped = static_cast<double>(clipped) / samples;
  return result;
}

}  // namespace

ExposureStatistics exposure_statistics(const ImageView& image) noexcept {
  if (image.empty()) return {};
  return image.format == PixelFormat::kGrey8 ? statistics<std::uint8_t>(image)
                                             : statistics<std::uint16_t>(image);
}

}  // namespace omma
