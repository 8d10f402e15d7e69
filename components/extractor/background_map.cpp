// Local background and noise on a coarse grid.
#include "components/extractor/background_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace omma {
namespace {

constexpr int kCell = BackgroundMap::kCell;
constexpr int kSampledRows = 8;  // every fourth row of a cell
constexpr int kSamples = kSampledRows * kCell;
// A pixel is rounded to a whole grey level: variance 1/12, the least a pixel can have.
constexpr float kQuantisationVariance = 1.0F / 12.0F;
// E[max(0, m − x)] of a Gaussian = σ / √(2π).
constexpr float kRootTwoPi = 2.5066283F;

template <class Pixel>
struct CellSamples {
  std::array<std::array<Pixel, kCell>, kSampledRows> value;
};

/// How many samples are not above `level`. Counters of the pixel's own width let the compiler use whole
/// vectors.
template <class Pixel>
int count_not_above(const CellSamples<Pixel>& samples, Pixel level) {
  std::array<Pixel, kCell> count{};
  for (const auto& row : samples.value) {
    for (int i = 0; i < kCell; ++i) {
      count[i] = static_cast<Pixel>(count[i] + static_cast<Pixel>(row[i] <= level ? 1 : 0));
    }
  }
  int total = 0;
  for (int i = 0; i < kCell; ++i) total += count[i];
  return total;
}

struct CellStatistics {
  float level;
  float noise;
};

/// Median and one-sided mean deviation of the histogram, each grey level taken as a bin one level wide.
template <class Pixel>
CellStatistics cell_statistics(const CellSamples<Pixel>& samples, int top_level) {
  // Smallest level with at least half of the samples not above it, by bisection.
  int low = 0;
  int high = top_level;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (2 * count_not_above(samples, static_cast<Pixel>(middle)) >= kSamples) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  const int median_bin = low;
  const int below = median_bin > 0 ? count_not_above(samples, static_cast<Pixel>(median_bin - 1)) : 0;
  const int within = count_not_above(samples, static_cast<Pixel>(median_bin)) - below;
  const float part = (0.5F * kSamples - static_cast<float>(below)) / static_cast<float>(within);
  const float median = static_cast<float>(median_bin) - 0.5F + part;
  // Σ max(0, m − x): whole bins below the median, and the part of its own bin that lies under it.
  int sum = 0;
  for (const auto& row : samples.value) {
    for (int i = 0; i < kCell; ++i) sum += row[i] < median_bin ? median_bin - row[i] : 0;
  }
  const float deviation = static_cast<float>(sum) + (part - 0.5F) * static_cast<float>(below) +
                          0.5F * part * part * static_cast<float>(within);
  const float spread = deviation * kRootTwoPi / kSamples;
  // The bins spread each sample once more over its own level: take that 1/12 away again.
  const float variance = std::max(spread * spread - kQuantisationVariance, kQuantisationVariance);
  return {median, std::sqrt(variance)};
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

float median_of_neighbours(const std::vector<float>& map, int columns, int rows, int column, int row) {
  std::array<float, 9> value;
  int n = 0;
  for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(columns - 1, column + 1); ++c) {
      value[n++] = map[static_cast<std::size_t>(r * columns + c)];
    }
  }
  for (int i = 1; i < n; ++i) {
    const float x = value[i];
    int j = i;
    for (; j > 0 && value[j - 1] > x; --j) value[j] = value[j - 1];
    value[j] = x;
  }
  return n % 2 == 1 ? value[n / 2] : 0.5F * (value[n / 2 - 1] + value[n / 2]);
}

}  // namespace

BackgroundMap::BackgroundMap(int width, int height) {
  const auto cells = static_cast<std::size_t>((width + kCell - 1) / kCell) *
                     static_cast<std::size_t>((height + kCell - 1) / kCell);
  for (auto* map : {&raw_level_, &raw_noise_, &level_, &noise_, &order_}) map->resize(cells);
}

template <class Pixel>
void BackgroundMap::measure_cells(const ImageView& image, bool dark_dots) noexcept {
  CellSamples<Pixel> samples;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      gather(image, column * kCell, row * kCell, dark_dots, samples);
      const CellStatistics cell = cell_statistics(samples, sizeof(Pixel) == 1 ? 255 : 65535);
      const auto i = static_cast<std::size_t>(row * columns_ + column);
      raw_level_[i] = cell.level;
      raw_noise_[i] = cell.noise;
    }
  }
}

void BackgroundMap::build(const ImageView& image, bool dark_dots) noexcept {
  columns_ = (image.width + kCell - 1) / kCell;
  rows_ = (image.height + kCell - 1) / kCell;
  if (image.format == PixelFormat::kGrey8) {
    measure_cells<std::uint8_t>(image, dark_dots);
  } else {
    measure_cells<std::uint16_t>(image, dark_dots);
  }
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto i = static_cast<std::size_t>(row * columns_ + column);
      level_[i] = median_of_neighbours(raw_level_, columns_, rows_, column, row);
      noise_[i] = median_of_neighbours(raw_noise_, columns_, rows_, column, row);
    }
  }
  const auto cells = static_cast<std::ptrdiff_t>(columns_) * rows_;
  const auto median = [&](const std::vector<float>& map) {
    std::copy(map.begin(), map.begin() + cells, order_.begin());
    std::nth_element(order_.begin(), order_.begin() + cells / 2, order_.begin() + cells);
    return order_[static_cast<std::size_t>(cells / 2)];
  };
  median_level_ = median(level_);
  median_noise_ = median(noise_);
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
  const auto at = [&](int r, int c) { return map[static_cast<std::size_t>(r * columns_ + c)]; };
  const float top = at(row, column) + fx * (at(row, right) - at(row, column));
  const float bottom = at(below, column) + fx * (at(below, right) - at(below, column));
  return top + fy * (bottom - top);
}

}  // namespace omma
