// Local background and noise of an image on a coarse grid, from robust statistics of sampled pixels.
// Stars, dots and text are the minority in a cell, so the median and the spread on the quiet side of it (away
// from the dots) do not see them; a median over 3×3 cells then removes cells that a large blob fills.
// Source: the scheme of SExtractor (Bertin & Arnouts 1996, A&AS 117, 393, §3); formulas in
// docs/algorithms/extractor.md#background.
#pragma once

#include <vector>

#include "components/extractor/index.hpp"
#include "components/sensor/pixel_mask.hpp"
#include "hal/image.hpp"

namespace omma {

class BackgroundMap {
 public:
  static constexpr int kCell = 32;  ///< side of a cell [px]

  /// Allocates for images of up to this size; nothing is allocated later.
  BackgroundMap(int width, int height);

  /// Builds the map of one image (not larger than the map).
  /// @param dark_dots  the dots are darker than the background: noise is then measured on the bright side
  /// @param mask       of the same size: its pixels are left out; null: none. Cells with nothing else take
  /// what
  ///                   the nearest ones have
  void build(const ImageView& image, bool dark_dots, const PixelMask* mask = nullptr) noexcept;

  int columns() const { return columns_; }  ///< cells
  int rows() const { return rows_; }        ///< cells
  const float* level_row(int row) const { return &level_[index_of(row, 0, columns_)]; }
  const float* noise_row(int row) const { return &noise_[index_of(row, 0, columns_)]; }

  /// Background and standard deviation of one pixel at (u, v), bilinear between cell centres [grey levels].
  float level(float u, float v) const noexcept { return interpolate(level_, u, v); }
  float noise(float u, float v) const noexcept { return interpolate(noise_, u, v); }
  float median_level() const { return median_level_; }
  float median_noise() const { return median_noise_; }

 private:
  template <class Pixel>
  void measure_cells(const ImageView& image, bool dark_dots, const PixelMask* mask) noexcept;
  void fill_masked_cells() noexcept;
  void smooth(const std::vector<float>& raw, std::vector<float>& out) noexcept;
  float interpolate(const std::vector<float>& map, float u, float v) const noexcept;

  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> raw_level_, raw_noise_;  // as measured, cell by cell
  std::vector<float> level_, noise_;          // after the 3×3 median
  std::vector<float> rows_above_;             // three rows of cells, padded
  std::vector<float> order_;                  // scratch of the medians over the image
  float median_level_ = 0;
  float median_noise_ = 0;
};

}  // namespace omma
