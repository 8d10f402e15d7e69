// The detection filter: each pixel smoothed with (1 2 1)⊗(1 2 1) and compared with a threshold that follows
// the local background. The kernel is close to the matched filter of a spot of 0.7 px. Most of an image is
// quiet: a pass in 8-bit averages that never round down finds the strips of 16 pixels that may hold a pixel
// over the threshold, and only those are computed exactly. Source: matched filtering before thresholding,
// Irwin 1985, MNRAS 214, 575; formulas in docs/algorithms/extractor.md#detection.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/extractor/background_map.hpp"
#include "components/extractor/window_tiles.hpp"
#include "hal/image.hpp"

namespace omma {

inline constexpr int kFilterSum = 16;         ///< sum of the kernel's weights
inline constexpr float kFilterDeviation = 6;  ///< of the smoothed value for pixels of standard deviation 1

class DetectionFilter {
 public:
  static constexpr int kWord = WindowTiles::kWidth;  ///< pixels to a word of bits

  /// Allocates for images of exactly this size.
  DetectionFilter(int width, int height);

  /// Takes an image; rows are then asked for in rising order from 1.
  /// @param threshold  in standard deviations of the smoothed value
  /// @param windows    of an image of this size: nothing is found elsewhere; null: everywhere
  void start(const ImageView& image, bool invert, const BackgroundMap& background, float threshold,
             const WindowTiles* windows = nullptr) noexcept;

  /// The pixels of row v over the threshold, 1 <= v < height − 1.
  /// @return whether there is any; bit u % 64 of word u / 64
  bool row(int v) noexcept;
  std::uint64_t word(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return ((found_[i / 64] >> (i % 64)) & 1U) != 0 ? words_[i] : 0;
  }
  /// The words that have any bit set, 64 of them to a block: bit i for word 64 · block + i.
  std::uint64_t found(int block) const { return found_[static_cast<std::size_t>(block)]; }
  int blocks() const { return static_cast<int>(found_.size()); }
  int words() const { return static_cast<int>(words_.size()); }

 private:
  void choose_scale(const BackgroundMap& background) noexcept;
  void average_row(int v) noexcept;
  void average_words(int v, int first, int last) noexcept;
  void average_down_words(int v, int first, int last) noexcept;
  bool near_full(int k) const noexcept;
  void place_row(int v) noexcept;
  std::uint64_t exact_word(int v, int k, bool all) const noexcept;
  std::uint64_t exact(int v, int strip) const noexcept;
  float threshold_of(int row, int column) const noexcept;

  int width_, height_;
  std::size_t row_length_;  // width rounded up to whole words, and one word
  int columns_ = 0, rows_ = 0;
  const ImageView* image_ = nullptr;
  bool invert_ = false;
  const WindowTiles* windows_ = nullptr;
  std::vector<float> threshold_;  // of the smoothed value, one a cell
  // Of the row at hand: the thresholds of the cells above and below its middle, and how far down it is.
  const float* above_ = nullptr;
  const float* below_ = nullptr;
  float down_ = 0;
  // Pixels as the quick pass sees them: 8 bits of (x − pedestal) · 2^exponent, full where it does not fit.
  int pedestal_ = 0;
  int exponent_ = 0;
  std::vector<std::uint8_t> limit_;              // one a strip of 16 pixels, for the band of rows at hand
  std::vector<std::uint8_t> word_limit_, over_;  // one a word
  int band_ = -2;
  std::vector<std::uint8_t> narrow_, averaged_;
  std::array<std::vector<std::uint8_t>, 3> across_;  // rows v−1, v, v+1, in turn
  std::array<std::vector<std::uint8_t>, 3> full_;    // of the same rows: words with a pixel that does not fit
  std::array<int, 3> averaged_row_{};                // which they are
  std::array<bool, 3> any_full_{};
  std::vector<std::uint8_t> full_limit_;
  std::vector<std::uint64_t> words_;  // those of found_ are of the row at hand
  std::vector<std::uint64_t> found_;
};

}  // namespace omma
