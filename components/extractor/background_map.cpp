// Local background and noise on a coarse grid.
#include "components/extractor/background_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "components/extractor/clones.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/lanes.hpp"
#include "components/extractor/median_of_nine.hpp"

namespace omma {
namespace {

constexpr int kCell = BackgroundMap::kCell;
constexpr int kSampledRows = 4;  // every eighth row of a cell
constexpr int kSamples = kSampledRows * kCell;
// A pixel is rounded to a whole grey level: variance 1/12, the least a pixel can have.
constexpr float kQuantisationVariance = 1.0F / 12.0F;
// E[max(0, m − x)] of a Gaussian = σ / √(2π).
constexpr float kRootTwoPi = 2.5066283F;

template <class Pixel>
struct CellSamples {
  std::array<std::array<Pixel, kCell>, kSampledRows> value;
};

/// How many samples are not above `level`.
OMMA_CLONES int count_not_above(const CellSamples<std::uint8_t>& samples, std::uint8_t level) {
  // Counters of the pixel's own width fill whole vectors.
  std::array<std::uint8_t, kCell> count{};
  for (const auto& row : samples.value)
    for (int i = 0; i < kCell; ++i)
      count[i] = static_cast<std::uint8_t>(count[i] + (row[i] <= level ? 1 : 0));
  int total = 0;
  for (int i = 0; i < kCell; ++i) total += count[i];
  return total;
}
OMMA_CLONES int count_not_above(const CellSamples<std::uint16_t>& samples, std::uint16_t level) {
  std::array<std::uint16_t, kCell> count{};
  for (const auto& row : samples.value)
    for (int i = 0; i < kCell; ++i)
      count[i] = static_cast<std::uint16_t>(count[i] + (row[i] <= level ? 1 : 0));
  int total = 0;
  for (int i = 0; i < kCell; ++i) total += count[i];
  return total;
}

constexpr float kUnknown = -1;  // level and noise of a cell that is masked

struct CellStatistics {
  int bin;  // the grey level that holds the median
  float level;
  float noise;
};

struct MedianBin {
  int level;   // smallest with at least half of the samples not above it
  int below;   // samples
  int within;  // samples
};

/// From a guess in growing steps, then by bisection: neighbouring cells are alike.
template <class Pixel>
MedianBin median_bin(const CellSamples<Pixel>& samples, int top_level, int guess) {
  int low = 0;
  int high = top_level;
  int below = 0;
  int not_above = kSamples;
  int at = std::min(guess, top_level - 1);
  int step = 1;
  int direction = 0;
  bool bracketed = false;
  while (low < high) {
    const int count = count_not_above(samples, static_cast<Pixel>(at));
    const bool enough = 2 * count >= kSamples;
    (enough ? high : low) = enough ? at : at + 1;
    (enough ? not_above : below) = count;
    const int turn = enough ? -1 : 1;
    bracketed = bracketed || (direction != 0 && turn != direction);
    direction = turn;
    at = bracketed ? (low + high) / 2 : std::clamp(at + turn * step, low, std::max(low, high - 1));
    step *= 2;
  }
  return {low, below, not_above - below};
}

/// Σ max(0, level − x) over the samples.
OMMA_CLONES int sum_below(const CellSamples<std::uint8_t>& samples, int level) {
  const auto top = static_cast<std::uint8_t>(level);
  int sum = 0;
  for (const auto& row : samples.value)
    for (int i = 0; i < kCell; ++i) sum += std::max(row[i], top) == top ? top - row[i] : 0;
  return sum;
}
OMMA_CLONES int sum_below(const CellSamples<std::uint16_t>& samples, int level) {
  int sum = 0;
  for (const auto& row : samples.value)
    for (int i = 0; i < kCell; ++i) sum += std::max(0, level - row[i]);
  return sum;
}

/// Median and one-sided mean deviation of the histogram, each grey level taken as a bin one level wide.
template <class Pixel>
CellStatistics cell_statistics(const CellSamples<Pixel>& samples, int top_level, int guess) {
  const auto [bin, below, within] = median_bin(samples, top_level, guess);
  const float part = (0.5F * kSamples - static_cast<float>(below)) / static_cast<float>(within);
  const float median = static_cast<float>(bin) - 0.5F + part;
  // Σ max(0, m − x): whole bins below the median, and the part of its own bin that lies under it.
  const float deviation = static_cast<float>(sum_below(samples, bin)) +
                          (part - 0.5F) * static_cast<float>(below) +
                          0.5F * part * part * static_cast<float>(within);
  const float spread = deviation * kRootTwoPi / kSamples;
  // The bins spread each sample once more over its own level: take that 1/12 away again.
  const float variance = std::max(spread * spread - kQuantisationVariance, kQuantisationVariance);
  return {bin, median, std::sqrt(variance)};
}

/// Copies the sampled rows of one cell; a cell cut by the image edge is moved inside, and an image smaller
/// than a cell repeats its last pixels. Dark dots are turned into bright ones.
template <class Pixel>
void gather(const ImageView& image, int left, int top, bool invert, CellSamples<Pixel>& samples) {
  left = std::max(0, std::min(left, image.width - kCell));
  top = std::max(0, std::min(top, image.height - kCell));
  const int available = std::min(kCell, image.width - left);
  for (int k = 0; k < kSampledRows; ++k) {
    const int v = std::min(top + k * (kCell / kSampledRows) + 1, image.height - 1);
    const Pixel* row = image.row<Pixel>(v) + left;
    auto& out = samples.value[k];
    std::memcpy(out.data(), row, static_cast<std::size_t>(available) * sizeof(Pixel));
    for (int i = available; i < kCell; ++i) out[i] = row[available - 1];
    if (invert) {
      const auto white = static_cast<Pixel>(image.white_level);
      for (auto& value : out) value = static_cast<Pixel>(white - std::min(value, white));
    }
  }
}

// Masked samples are replaced by others of the same cell, in turn. Returns false where too few are left.
template <class Pixel>
bool replace_masked(const ImageView& image, const PixelMask& mask, int left, int top,
                    CellSamples<Pixel>& samples) {
  left = std::max(0, std::min(left, image.width - kCell));
  top = std::max(0, std::min(top, image.height - kCell));
  if (!mask.any_in(left, top, left + kCell - 1, top + kCell - 1)) return true;
  std::array<Pixel, kSamples> kept{};
  std::size_t count = 0;
  const auto masked = [&](int row, int i) {
    const int v = std::min(top + row * (kCell / kSampledRows) + 1, image.height - 1);
    return mask.at(std::min(left + i, image.width - 1), v);
  };
  for (int row = 0; row < kSampledRows; ++row)
    for (int i = 0; i < kCell; ++i)
      if (!masked(row, i)) kept[count++] = samples.value[index_of(row)][index_of(i)];
  if (4 * count < kSamples) return false;
  std::size_t next = 0;
  for (int row = 0; row < kSampledRows; ++row) {
    for (int i = 0; i < kCell; ++i) {
      if (masked(row, i)) samples.value[index_of(row)][index_of(i)] = kept[next++ % count];
    }
  }
  return true;
}

OMMA_CLONES void median_rows(const std::array<const float*, 3>& rows, std::size_t columns, float* out) {
  for (std::size_t column = 0; column < columns; column += kLanes) {
    std::array<Floats, 9> nine;
    for (std::size_t k = 0; k < 9; ++k) nine[k] = load(rows[k / 3] + column + k % 3);
    std::array<float, kLanes> median{};
    store(median.data(), median_of_nine(nine));
    std::copy_n(median.begin(), std::min(kLanes, columns - column), out + column);
  }
}

}  // namespace

BackgroundMap::BackgroundMap(int width, int height) {
  const auto cells = static_cast<std::size_t>((width + kCell - 1) / kCell) *
                     static_cast<std::size_t>((height + kCell - 1) / kCell);
  for (auto* map : {&raw_level_, &raw_noise_, &level_, &noise_, &order_}) map->resize(cells);
  rows_above_.resize(3 * (static_cast<std::size_t>((width + kCell - 1) / kCell) + 2 * kLanes));
}

template <class Pixel>
void BackgroundMap::measure_cells(const ImageView& image, bool dark_dots, const PixelMask* mask) noexcept {
  CellSamples<Pixel> samples;
  int guess = 16;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      gather(image, column * kCell, row * kCell, dark_dots, samples);
      const auto i = index_of(row, column, columns_);
      if (mask != nullptr && !replace_masked(image, *mask, column * kCell, row * kCell, samples)) {
        raw_level_[i] = raw_noise_[i] = kUnknown;
        continue;
      }
      const CellStatistics cell = cell_statistics(samples, sizeof(Pixel) == 1 ? 255 : 65535, guess);
      guess = cell.bin;
      raw_level_[i] = cell.level;
      raw_noise_[i] = cell.noise;
    }
  }
}

// From the left and from above, then from the right and from below.
void BackgroundMap::fill_masked_cells() noexcept {
  const auto take = [&](int row, int column, int from_row, int from_column) {
    const auto i = index_of(row, column, columns_);
    if (raw_noise_[i] > 0 || from_row < 0 || from_row >= rows_ || from_column < 0 || from_column >= columns_)
      return;
    const auto from = index_of(from_row, from_column, columns_);
    raw_level_[i] = raw_level_[from];
    raw_noise_[i] = raw_noise_[from];
  };
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      take(row, column, row, column - 1);
      take(row, column, row - 1, column);
    }
  }
  for (int row = rows_ - 1; row >= 0; --row) {
    for (int column = columns_ - 1; column >= 0; --column) {
      take(row, column, row, column + 1);
      take(row, column, row + 1, column);
    }
  }
  // All masked: nothing is found there anyway.
  for (std::size_t i = 0; i < raw_noise_.size(); ++i) {
    if (raw_noise_[i] > 0) continue;
    raw_noise_[i] = 1;
    raw_level_[i] = 0;
  }
}

void BackgroundMap::build(const ImageView& image, bool dark_dots, const PixelMask* mask) noexcept {
  columns_ = (image.width + kCell - 1) / kCell;
  rows_ = (image.height + kCell - 1) / kCell;
  if (image.format == PixelFormat::kGrey8) {
    measure_cells<std::uint8_t>(image, dark_dots, mask);
  } else {
    measure_cells<std::uint16_t>(image, dark_dots, mask);
  }
  if (mask != nullptr) fill_masked_cells();
  smooth(raw_level_, level_);
  smooth(raw_noise_, noise_);
  const auto cells = static_cast<std::ptrdiff_t>(columns_) * rows_;
  const auto median = [&](const std::vector<float>& map) {
    std::copy(map.begin(), map.begin() + cells, order_.begin());
    std::nth_element(order_.begin(), order_.begin() + cells / 2, order_.begin() + cells);
    return order_[static_cast<std::size_t>(cells / 2)];
  };
  median_level_ = median(level_);
  median_noise_ = median(noise_);
}

// Median over 3×3 cells; the outermost are repeated outside.
void BackgroundMap::smooth(const std::vector<float>& raw, std::vector<float>& out) noexcept {
  const auto columns = static_cast<std::size_t>(columns_);
  std::array<float*, 3> padded{};
  for (std::size_t k = 0; k < 3; ++k) padded[k] = &rows_above_[k * (columns + 2 * kLanes)];
  for (int row = 0; row < rows_; ++row) {
    for (int k = -1; k <= 1; ++k) {
      const float* from = &raw[static_cast<std::size_t>(std::clamp(row + k, 0, rows_ - 1)) * columns];
      float* to = padded[index_of(k + 1)];
      to[0] = from[0];
      std::copy_n(from, columns, to + 1);
      std::fill_n(to + 1 + columns, kLanes + 1, from[columns - 1]);
    }
    median_rows({padded[0], padded[1], padded[2]}, columns, &out[static_cast<std::size_t>(row) * columns]);
  }
}

float BackgroundMap::interpolate(const std::vector<float>& map, float u, float v) const noexcept {
  const float x = std::clamp((u + 0.5F) / kCell - 0.5F, 0.0F, static_cast<float>(columns_ - 1));
  const float y = std::clamp((v + 0.5F) / kCell - 0.5F, 0.0F, static_cast<float>(rows_ - 1));
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const int right = std::min(column + 1, columns_ - 1);
  const int below = std::min(row + 1, rows_ - 1);
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(row);
  const auto at = [&](int r, int c) { return map[index_of(r, c, columns_)]; };
  const float top = at(row, column) + fx * (at(row, right) - at(row, column));
  const float bottom = at(below, column) + fx * (at(below, right) - at(below, column));
  return top + fy * (bottom - top);
}

}  // namespace omma
