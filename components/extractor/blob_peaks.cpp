#include "components/extractor/blob_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "components/extractor/clones.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/lanes.hpp"

namespace omma {
namespace {

// A valley must be so many standard deviations of the smoothed light below the lower peak.
constexpr float kDepth = 3;
// And this share of the lower peak's light over the background: real spots are lumpy where they are bright.
constexpr float kLeastDepth = 0.05F;
constexpr float kFilterWeights = 16;
constexpr float kFilterDeviation = 6;  // √(Σ weights²)

constexpr int kSide = 96;  // of the smoothed patch, with eight columns to spare on each side
constexpr int kMost = 80;  // pixels on a side of a box

// The smoothed light of `rows` rows of eight pixels; `x` is the first pixel of the row above, `flip` what
// bright and dark are turned about (0: not).
template <class Pixel>
[[gnu::always_inline]] inline void smooth_eight(const Pixel* x, std::ptrdiff_t stride, int rows, int flip,
                                                std::int32_t* out) {
  const auto across = [&](int row) __attribute__((always_inline)) {
    const Pixel* at = x + row * stride;
    return load_pixels(at - 1) + 2 * load_pixels(at) + load_pixels(at + 1);
  };
  Ints above = across(0);
  Ints here = across(1);
  for (int y = 0; y < rows; ++y, out += kSide) {
    const Ints below = across(y + 2);
    const Ints sum = above + 2 * here + below;
    const Ints light = flip > 0 ? 16 * flip - sum : sum;
    std::memcpy(out, &light, sizeof light);
    above = here;
    here = below;
  }
}
OMMA_CLONES void smooth_columns(const std::uint8_t* x, std::ptrdiff_t stride, int rows, int flip,
                                std::int32_t* out) {
  smooth_eight(x, stride, rows, flip, out);
}
OMMA_CLONES void smooth_columns(const std::uint16_t* x, std::ptrdiff_t stride, int rows, int flip,
                                std::int32_t* out) {
  smooth_eight(x, stride, rows, flip, out);
}

// The smoothed light of a box and a border of one pixel.
class Patch {
 public:
  Patch(int left, int top, int right, int bottom)
      : left_(left - 1), top_(top - 1), width_(right - left + 3), height_(bottom - top + 3) {}

  template <class Pixel>
  void smooth(const ImageView& image, int flip) {
    const auto stride = image.stride / static_cast<std::ptrdiff_t>(sizeof(Pixel));
    constexpr int kEight = static_cast<int>(kLanes);
    for (int first = 0; first < width_; first += kEight) {
      // At the right border of the image the last eight lie further left.
      const int left = std::min(left_ + first, image.width - 1 - kEight);
      if (left < 1) return smooth_slowly<Pixel>(image, flip);
      smooth_columns(image.row<Pixel>(top_ - 1) + left, stride, height_, flip,
                     &value_[index_of(left - left_ + kEight)]);
    }
  }
  [[gnu::always_inline]] Ints eight(int u, int v) const {
    Ints x;
    std::memcpy(&x, &value_[index_of(v - top_, u - left_ + kMargin, kSide)], sizeof x);
    return x;
  }
  int operator()(int u, int v) const { return value_[index_of(v - top_, u - left_ + kMargin, kSide)]; }

 private:
  static constexpr int kMargin = static_cast<int>(kLanes);

  // An image of a few columns.
  template <class Pixel>
  void smooth_slowly(const ImageView& image, int flip) {
    for (int y = 0; y < height_; ++y) {
      for (int u = 0; u < width_; ++u) {
        int sum = 0;
        for (int row = -1; row <= 1; ++row) {
          const Pixel* x = image.row<Pixel>(top_ + y + row) + left_ + u;
          sum += (row == 0 ? 2 : 1) * (x[-1] + 2 * x[0] + x[1]);
        }
        value_[index_of(y, u + kMargin, kSide)] = flip > 0 ? 16 * flip - sum : sum;
      }
    }
  }

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

struct Maximum {
  int u, v, height;
};
constexpr std::size_t kMostMaxima = Peaks::capacity();

struct Box {
  int left, top, right, bottom;
};

// Which of eight pixels side by side are higher than their neighbours (no lower than those that come later).
[[gnu::always_inline]] inline Ints are_maxima(const Patch& smoothed, int u, int v) {
  const Ints here = smoothed.eight(u, v);
  return (here > smoothed.eight(u - 1, v)) & (here > smoothed.eight(u, v - 1)) &
         (here >= smoothed.eight(u + 1, v)) & (here >= smoothed.eight(u, v + 1)) &
         (here > smoothed.eight(u - 1, v - 1)) & (here > smoothed.eight(u + 1, v - 1)) &
         (here >= smoothed.eight(u - 1, v + 1)) & (here >= smoothed.eight(u + 1, v + 1));
}

// The local maxima in a box that are not below `floor`, in reading order.
OMMA_CLONES std::size_t find_maxima(const Patch& smoothed, const Box& box, float floor,
                                    std::array<Maximum, kMostMaxima>& maxima) {
  constexpr int kEight = static_cast<int>(kLanes);
  const auto least = static_cast<int>(std::ceil(floor));
  std::size_t count = 0;
  for (int v = box.top; v <= box.bottom; ++v) {
    for (int left = box.left; left <= box.right; left += kEight) {
      Ints highest = are_maxima(smoothed, left, v) & (smoothed.eight(left, v) >= least) &
                     (Ints{0, 1, 2, 3, 4, 5, 6, 7} <= box.right - left);
      std::array<std::uint64_t, kLanes / 2> pairs;
      std::memcpy(pairs.data(), &highest, sizeof highest);
      if ((pairs[0] | pairs[1] | pairs[2] | pairs[3]) == 0) continue;
      for (int i = 0; i < kEight; ++i) {
        if (highest[i] == 0) continue;
        maxima[count] = {left + i, v, smoothed(left + i, v)};
        if (++count == kMostMaxima) return count;
      }
    }
  }
  return count;
}

// Difference over sum of the light on the two sides of a peak, over the background.
float lean(int before, int after, float background) {
  const float sum = static_cast<float>(before + after) - 2 * kFilterWeights * background;
  return sum > 0 ? std::clamp(static_cast<float>(after - before) / sum, -1.0F, 1.0F) : 0.0F;
}

}  // namespace

void find_peaks(const ImageView& image, bool invert, const Candidate& candidate, Peaks& peaks) noexcept {
  peaks.clear();
  const int left = std::max(candidate.left, 2);
  const int right = std::min(candidate.right, image.width - 3);
  const int top = std::max(candidate.top, 2);
  const int bottom = std::min(candidate.bottom, image.height - 3);
  if (right < left || bottom < top || right - left + 3 > kMost || bottom - top + 3 > kMost) return;
  Patch smoothed(left, top, right, bottom);
  const int flip = invert ? image.white_level : 0;
  if (image.format == PixelFormat::kGrey8) {
    smoothed.smooth<std::uint8_t>(image, flip);
  } else {
    smoothed.smooth<std::uint16_t>(image, flip);
  }
  const float floor =
      candidate.noise.background * kFilterWeights + kDepth * kFilterDeviation * candidate.noise.sigma;
  std::array<Maximum, kMostMaxima> maxima;
  const std::size_t count = find_maxima(smoothed, {left, top, right, bottom}, floor, maxima);
  std::sort(maxima.begin(), maxima.begin() + count, [](const Maximum& a, const Maximum& b) {
    if (a.height != b.height) return a.height > b.height;
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  const float variance = candidate.noise.sigma * candidate.noise.sigma;
  for (std::size_t i = 0; i < count; ++i) {
    Peak peak{maxima[i].u, maxima[i].v, maxima[i].height};
    const float light =
        std::max(0.0F, static_cast<float>(peak.height) / kFilterWeights - candidate.noise.background);
    const float photons = candidate.noise.gain > 0 ? light / candidate.noise.gain : 0;
    const float depth = std::max(kDepth * kFilterDeviation * std::sqrt(variance + photons),
                                 kLeastDepth * kFilterWeights * light);
    const bool parted = std::all_of(peaks.begin(), peaks.end(), [&](const Peak& higher) {
      return static_cast<float>(peak.height - lowest_between(smoothed, peak, higher)) > depth;
    });
    if (!parted) continue;
    const float background = candidate.noise.background;
    peak.lean_u = lean(smoothed(peak.u - 1, peak.v), smoothed(peak.u + 1, peak.v), background);
    peak.lean_v = lean(smoothed(peak.u, peak.v - 1), smoothed(peak.u, peak.v + 1), background);
    peaks.push_back(peak);
  }
}

}  // namespace omma
