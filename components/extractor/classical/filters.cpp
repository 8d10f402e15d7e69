#include "components/extractor/classical/filters.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "components/extractor/clones.hpp"
#include "components/extractor/lanes.hpp"
#include "components/extractor/median_of_nine.hpp"

namespace omma {
namespace {

constexpr int kEight = static_cast<int>(kLanes);

// Applies `rule` to the 3×3 neighbourhoods of a row, eight side by side; `out` has no room behind its end.
template <class Rule>
[[gnu::always_inline]] inline void for_row(const std::array<const float*, 3>& rows, int width, float* out,
                                           Rule&& rule) {
  std::array<Floats, 9> n;
  for (int u = 0; u < width; u += kEight) {
    for (std::size_t k = 0; k < 9; ++k) n[k] = load(rows[k / 3] + u + static_cast<int>(k % 3) - 1);
    const Floats x = rule(n);
    if (u + kEight <= width) {
      store(out + u, x);
    } else {
      for (int i = 0; u + i < width; ++i) out[u + i] = x[i];
    }
  }
}

[[gnu::always_inline]] inline Floats larger(const Floats& a, const Floats& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Floats smaller(const Floats& a, const Floats& b) {
  return a < b ? a : b;
}

using Rows = std::array<const float*, 3>;
OMMA_CLONES void sobel_row(const Rows& rows, int width, float* out) {
  for_row(
      rows, width, out, [](const std::array<Floats, 9>& n) __attribute__((always_inline)) {
        const Floats du = n[2] + 2.0F * n[5] + n[8] - n[0] - 2.0F * n[3] - n[6];
        const Floats dv = n[6] + 2.0F * n[7] + n[8] - n[0] - 2.0F * n[1] - n[2];
        const Floats square = du * du + dv * dv;
        Floats root;
        for (int i = 0; i < kEight; ++i) root[i] = std::sqrt(square[i]);
        return root;
      });
}
OMMA_CLONES void details_row(const Rows& rows, int width, float* out) {
  for_row(
      rows, width, out, [](const std::array<Floats, 9>& n) __attribute__((always_inline)) {
        const Floats around = n[0] + n[1] + n[2] + n[3] + n[5] + n[6] + n[7] + n[8];
        return larger(9.0F * n[4] - around, Floats{});
      });
}
OMMA_CLONES void largest_row(const Rows& rows, int width, float* out) {
  for_row(
      rows, width, out, [](const std::array<Floats, 9>& n) __attribute__((always_inline)) {
        Floats x = n[0];
        for (std::size_t k = 1; k < 9; ++k) x = larger(x, n[k]);
        return x;
      });
}
OMMA_CLONES void smallest_row(const Rows& rows, int width, float* out) {
  for_row(
      rows, width, out, [](const std::array<Floats, 9>& n) __attribute__((always_inline)) {
        Floats x = n[0];
        for (std::size_t k = 1; k < 9; ++k) x = smaller(x, n[k]);
        return x;
      });
}
OMMA_CLONES void median_row(const Rows& rows, int width, float* out) {
  for_row(
      rows, width, out, [](const std::array<Floats, 9>& n) __attribute__((always_inline)) {
        std::array<Floats, 9> nine = n;
        return median_of_nine(nine);
      });
}

template <class RowRule>
void by_neighbours(GreyImage& image, RowRing& ring, RowRule&& rule) {
  for (int v = 0; v < image.height; ++v) {
    ring.centre_on(image, v, 1);
    rule(Rows{ring.row(v - 1), ring.row(v), ring.row(v + 1)}, image.width, image.row(v));
  }
}

// x^(1/5), x > 0, to float's precision: Newton from a guess by the exponent.
float fifth_root(float x) {
  float y = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) / 5 + 0x32CCAF4CU);
  for (int k = 0; k < 4; ++k) y = 0.2F * (4 * y + x / (y * y * y * y));
  return y;
}

template <class Power>
void look_up(GreyImage& image, Power&& power) {
  const float top = *std::max_element(image.value.begin(), image.value.end());
  if (!(top > 0)) return;
  for (float& x : image.value) x = x > 0 ? top * power(x / top) : 0;
}

struct Range {
  float least, greatest;
};

// Eight medians side by side by bisection of the grey levels: `window` rows of as many pixels.
OMMA_CLONES void median_window(const RowRing& ring, int v, int u, int window, Range range, int steps,
                               float* out) {
  const int reach = window / 2;
  const std::int32_t half = window * window / 2;
  Floats low = Floats{} + range.least;
  Floats high = Floats{} + range.greatest;  // at least half of the samples are not above it
  for (int k = 0; k < steps; ++k) {
    const Floats middle = 0.5F * (low + high);
    Ints count{};  // of those not above, negative
    for (int y = v - reach; y <= v + reach; ++y) {
      const float* row = ring.row(y) + u;
      for (int x = -reach; x <= reach; ++x) count += load(row + x) <= middle;
    }
    const Ints enough = -count > half;
    high = enough ? middle : high;
    low = enough ? low : middle;
  }
  Floats median = Floats{} + range.least;  // the largest sample that is not above
  for (int y = v - reach; y <= v + reach; ++y) {
    const float* row = ring.row(y) + u;
    for (int x = -reach; x <= reach; ++x) {
      const Floats sample = load(row + x);
      median = (sample <= high) & (sample > median) ? sample : median;
    }
  }
  store(out, median);
}

OMMA_CLONES void add_row(const float* row, float weight, int width, float* sum) {
  for (int u = 0; u < width; ++u) sum[u] += weight * row[u];
}

}  // namespace

void take_levels(const ImageView& image, bool invert, GreyImage& grey) noexcept {
  const auto take = [&](const auto* from, float* to) {
    for (int u = 0; u < image.width; ++u)
      to[u] = static_cast<float>(invert ? image.white_level - from[u] : int{from[u]});
  };
  for (int v = 0; v < image.height; ++v) {
    if (image.format == PixelFormat::kGrey8) {
      take(image.row<std::uint8_t>(v), grey.row(v));
    } else {
      take(image.row<std::uint16_t>(v), grey.row(v));
    }
  }
}

GreyImage grey_image(const ImageView& image) {
  GreyImage grey(image.width, image.height);
  take_levels(image, false, grey);
  return grey;
}

void square_root_look_up(GreyImage& image) noexcept {
  look_up(image, [](float x) { return std::sqrt(x); });
}

void four_fifths_look_up(GreyImage& image) noexcept {
  look_up(image, [](float x) {
    const float root = fifth_root(x);
    const float square = root * root;
    return square * square;
  });
}

void median_filter(GreyImage& image, int window, RowRing& ring) noexcept {
  if (window <= 3) return by_neighbours(image, ring, median_row);
  const auto [least, greatest] = std::minmax_element(image.value.begin(), image.value.end());
  const Range range{*least, *greatest};
  int steps = 0;
  for (float step = range.greatest - range.least; step > 0.125F && steps < 24; step *= 0.5F) ++steps;
  std::array<float, kLanes> eight;
  for (int v = 0; v < image.height; ++v) {
    ring.centre_on(image, v, window / 2);
    for (int u = 0; u < image.width; u += kEight) {
      median_window(ring, v, u, window, range, steps, eight.data());
      std::copy_n(eight.begin(), std::min(kEight, image.width - u), image.row(v) + u);
    }
  }
}

void gaussian_smooth(GreyImage& image, double sigma, RowRing& ring) noexcept {
  const int reach = gaussian_reach(sigma);
  std::array<float, 2 * kLargestReach + 1> kernel{};
  float sum = 0;
  for (int k = -reach; k <= reach; ++k)
    sum += kernel[index_of(k + reach)] = static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma)));
  for (float& weight : kernel) weight /= sum;
  for (int v = 0; v < image.height; ++v) {  // along the rows
    ring.centre_on(image, v, 0);
    float* out = image.row(v);
    std::fill_n(out, image.width, 0.0F);
    for (int k = -reach; k <= reach; ++k)
      add_row(ring.row(v) + k, kernel[index_of(k + reach)], image.width, out);
  }
  for (int v = 0; v < image.height; ++v) {  // along the columns
    ring.centre_on(image, v, reach);
    float* out = image.row(v);
    std::fill_n(out, image.width, 0.0F);
    for (int k = -reach; k <= reach; ++k)
      add_row(ring.row(v + k), kernel[index_of(k + reach)], image.width, out);
  }
}

void sobel(GreyImage& image, RowRing& ring) noexcept {
  by_neighbours(image, ring, sobel_row);
}
void highlight_details(GreyImage& image, RowRing& ring) noexcept {
  by_neighbours(image, ring, details_row);
}
void dilate(GreyImage& image, RowRing& ring) noexcept {
  by_neighbours(image, ring, largest_row);
}
void close(GreyImage& image, RowRing& ring) noexcept {
  dilate(image, ring);
  by_neighbours(image, ring, smallest_row);
}

void subtract(const GreyImage& other, GreyImage& image) noexcept {
  for (std::size_t i = 0; i < image.value.size(); ++i) image.value[i] -= other.value[i];
}

void leave_masked(const GreyImage& mask, GreyImage& image) noexcept {
  for (std::size_t i = 0; i < image.value.size(); ++i)
    if (mask.value[i] == 0) image.value[i] = 0;
}

}  // namespace omma
