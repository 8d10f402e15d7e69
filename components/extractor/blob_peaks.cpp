#include "components/extractor/blob_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// A valley must be so many standard deviations of the smoothed light below the lower peak.
constexpr float kDepth = 3;
// And this share of the lower peak's light over the background: real spots are lumpy where they are bright.
constexpr float kLeastDepth = 0.05F;
constexpr float kFilterWeights = 16;
constexpr float kFilterDeviation = 6;  // √(Σ weights²)

template <class Pixel>
struct Smoothed {
  const ImageView& image;
  int flip;  // white level where the dots are dark
  int operator()(int u, int v) const {
    const auto row = [&](int y) {
      const Pixel* x = image.row<Pixel>(y) + u;
      return x[-1] + 2 * x[0] + x[1];
    };
    const int sum = row(v - 1) + 2 * row(v) + row(v + 1);
    return flip > 0 ? 16 * flip - sum : sum;
  }
};

// Lowest smoothed light on the straight way between two peaks.
template <class Pixel>
int lowest_between(const Smoothed<Pixel>& smoothed, const Peak& a, const Peak& b) {
  const int steps = std::max(std::abs(a.u - b.u), std::abs(a.v - b.v));
  int lowest = std::min(a.height, b.height);
  for (int k = 1; k < steps; ++k) {
    const int u = a.u + (2 * k * (b.u - a.u) + steps) / (2 * steps);
    const int v = a.v + (2 * k * (b.v - a.v) + steps) / (2 * steps);
    lowest = std::min(lowest, smoothed(u, v));
  }
  return lowest;
}

template <class Pixel>
void find(const ImageView& image, bool invert, const Candidate& candidate, Peaks& peaks) {
  const Smoothed<Pixel> smoothed{image, invert ? image.white_level : 0};
  const int left = std::max(candidate.left, 2);
  const int right = std::min(candidate.right, image.width - 3);
  const int top = std::max(candidate.top, 2);
  const int bottom = std::min(candidate.bottom, image.height - 3);
  Peaks maxima;
  const float floor =
      candidate.noise.background * kFilterWeights + kDepth * kFilterDeviation * candidate.noise.sigma;
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const int here = smoothed(u, v);
      if (static_cast<float>(here) < floor) continue;
      const bool highest = here > smoothed(u - 1, v) && here > smoothed(u, v - 1) &&
                           here >= smoothed(u + 1, v) && here >= smoothed(u, v + 1) &&
                           here > smoothed(u - 1, v - 1) && here > smoothed(u + 1, v - 1) &&
                           here >= smoothed(u - 1, v + 1) && here >= smoothed(u + 1, v + 1);
      if (highest && !maxima.push_back({u, v, here})) break;
    }
  }
  std::sort(maxima.begin(), maxima.end(), [](const Peak& a, const Peak& b) {
    if (a.height != b.height) return a.height > b.height;
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  const float variance = candidate.noise.sigma * candidate.noise.sigma;
  for (const Peak& peak : maxima) {
    const float light =
        std::max(0.0F, static_cast<float>(peak.height) / kFilterWeights - candidate.noise.background);
    const float photons = candidate.noise.gain > 0 ? light / candidate.noise.gain : 0;
    const float depth = std::max(kDepth * kFilterDeviation * std::sqrt(variance + photons),
                                 kLeastDepth * kFilterWeights * light);
    const bool parted = std::all_of(peaks.begin(), peaks.end(), [&](const Peak& higher) {
      return static_cast<float>(peak.height - lowest_between(smoothed, peak, higher)) > depth;
    });
    if (parted) peaks.push_back(peak);
  }
}

}  // namespace

void find_peaks(const ImageView& image, bool invert, const Candidate& candidate, Peaks& peaks) noexcept {
  peaks.clear();
  if (image.format == PixelFormat::kGrey8) {
    find<std::uint8_t>(image, invert, candidate, peaks);
  } else {
    find<std::uint16_t>(image, invert, candidate, peaks);
  }
}

}  // namespace omma
