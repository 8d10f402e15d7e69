#include "components/extractor/blob_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace omma {
namespace {

// A valley must be so many standard deviations of the smoothed light below the lower peak.
constexpr float kDepth = 3;
// And this share of the lower peak's light over the background: real spots are lumpy where they are bright.
constexpr float kLeastDepth = 0.05F;
constexpr float kFilterWeights = 16;
constexpr float kFilterDeviation = 6;  // √(Σ weights²)

constexpr int kSide = 80;  // most pixels on a side of the smoothed patch

// The smoothed light of a box and a border of one pixel.
class Patch {
 public:
  Patch(int left, int top, int right, int bottom)
      : left_(left - 1), top_(top - 1), width_(right - left + 3), height_(bottom - top + 3) {}

  template <class Pixel>
  void smooth(const ImageView& image, int flip) {
    std::array<std::int32_t, kSide> across[3];
    for (int y = -1; y <= height_; ++y) {
      const Pixel* x = image.row<Pixel>(top_ + y) + left_;
      auto& row = across[(y + 3) % 3];
      for (int u = 0; u < width_; ++u) row[static_cast<std::size_t>(u)] = x[u - 1] + 2 * x[u] + x[u + 1];
      if (y < 1) continue;
      const auto& above = across[(y + 1) % 3];
      const auto& here = across[(y + 2) % 3];
      std::int32_t* out = &value_[static_cast<std::size_t>(y - 1) * kSide];
      for (int u = 0; u < width_; ++u) {
        const auto i = static_cast<std::size_t>(u);
        const std::int32_t sum = above[i] + 2 * here[i] + row[i];
        out[u] = flip > 0 ? 16 * flip - sum : sum;
      }
    }
  }
  int operator()(int u, int v) const {
    return value_[static_cast<std::size_t>(v - top_) * kSide + static_cast<std::size_t>(u - left_)];
  }

 private:
  int left_, top_, width_, height_;
  std::array<std::int32_t, std::size_t{kSide} * kSide> value_;
};

// Lowest smoothed light on the straight way between two peaks.
int lowest_between(const Patch& smoothed, const Peak& a, const Peak& b) {
  const int steps = std::max(std::abs(a.u - b.u), std::abs(a.v - b.v));
  int lowest = std::min(a.height, b.height);
  for (int k = 1; k < steps; ++k) {
    const int u = a.u + (2 * k * (b.u - a.u) + steps) / (2 * steps);
    const int v = a.v + (2 * k * (b.v - a.v) + steps) / (2 * steps);
    lowest = std::min(lowest, smoothed(u, v));
  }
  return lowest;
}

}  // namespace

void find_peaks(const ImageView& image, bool invert, const Candidate& candidate, Peaks& peaks) noexcept {
  peaks.clear();
  const int left = std::max(candidate.left, 2);
  const int right = std::min(candidate.right, image.width - 3);
  const int top = std::max(candidate.top, 2);
  const int bottom = std::min(candidate.bottom, image.height - 3);
  if (right < left || bottom < top || right - left + 3 > kSide || bottom - top + 3 > kSide) return;
  Patch smoothed(left, top, right, bottom);
  const int flip = invert ? image.white_level : 0;
  if (image.format == PixelFormat::kGrey8) {
    smoothed.smooth<std::uint8_t>(image, flip);
  } else {
    smoothed.smooth<std::uint16_t>(image, flip);
  }
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

}  // namespace omma
