// Which pixels of an image are not to be looked at: one bit a pixel, rows of whole 64-bit words, so that rows
// of found pixels are cleared by words. Made at start-up from shapes; a frame's own (glare) is joined to it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "components/geometry/lens.hpp"
#include "hal/image.hpp"

namespace omma {

class PixelMask {
 public:
  static constexpr int kWord = 64;  ///< pixels to a word

  PixelMask() = default;  ///< of no image: nothing is masked
  PixelMask(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  bool any() const;
  double share() const;  ///< of the image's pixels that are masked

  bool at(int u, int v) const { return ((word(v, u / kWord) >> (u % kWord)) & 1U) != 0; }
  /// Whether any pixel of the box (bounds included, cut to the image) is masked.
  bool any_in(int left, int top, int right, int bottom) const noexcept;
  /// Bit u % 64 of word u / 64 of row v; bits behind the row's end are 0.
  std::uint64_t word(int v, int k) const {
    return words_[static_cast<std::size_t>(v) * static_cast<std::size_t>(row_words_) +
                  static_cast<std::size_t>(k)];
  }

  void clear() noexcept;
  /// Parts outside the image are ignored.
  void add_box(int left, int top, int right, int bottom) noexcept;
  /// Pixels whose centre lies inside, by the even–odd rule; corners in order, at least three [px].
  void add_polygon(std::span<const Eigen::Vector2d> corners);
  /// Pixels that see further than `angle` off the lens's axis [rad], and those that see nothing.
  void add_outside(const Lens& lens, double angle);
  /// Pixels of another image of the same size that are brighter than half of its white level.
  void add_bright_half(const ImageView& picture);
  /// The union with another mask of the same size.
  void add(const PixelMask& other) noexcept;
  /// Also the pixels within `pixels` of a masked one, along rows and columns. Allocates.
  void grow(int pixels);
  /// The mask of the image at half its resolution: masked where any of the four is. Of the right size
  /// already.
  void halve(const PixelMask& whole) noexcept;

 private:
  std::uint64_t& word_of(int u, int v) {
    return words_[static_cast<std::size_t>(v) * static_cast<std::size_t>(row_words_) +
                  static_cast<std::size_t>(u / kWord)];
  }
  void set(int u, int v) { word_of(u, v) |= std::uint64_t{1} << (u % kWord); }

  int width_ = 0, height_ = 0, row_words_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace omma
