#include "components/sensor/pixel_mask.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace omma {

PixelMask::PixelMask(int width, int height)
    : width_(width),
      height_(height),
      row_words_((width + kWord - 1) / kWord),
      words_(static_cast<std::size_t>(row_words_) * static_cast<std::size_t>(height)) {}

bool PixelMask::any() const {
  return std::any_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word != 0; });
}

double PixelMask::share() const {
  if (words_.empty()) return 0;
  std::int64_t count = 0;
  for (const std::uint64_t word : words_) count += std::popcount(word);
  return static_cast<double>(count) / (static_cast<double>(width_) * height_);
}

bool PixelMask::any_in(int left, int top, int right, int bottom) const noexcept {
  left = std::max(left, 0);
  right = std::min(right, width_ - 1);
  for (int v = std::max(top, 0); v <= std::min(bottom, height_ - 1); ++v)
    for (int u = left; u <= right; ++u)
      if (at(u, v)) return true;
  return false;
}

void PixelMask::clear() noexcept {
  std::fill(words_.begin(), words_.end(), std::uint64_t{0});
}

void PixelMask::add_box(int left, int top, int right, int bottom) noexcept {
  left = std::max(left, 0);
  right = std::min(right, width_ - 1);
  if (left > right) return;
  for (int k = left / kWord; k <= right / kWord; ++k) {
    std::uint64_t bits = ~std::uint64_t{0};
    if (k == left / kWord) bits &= ~std::uint64_t{0} << (left % kWord);
    if (k == right / kWord) bits &= ~std::uint64_t{0} >> (kWord - 1 - right % kWord);
    for (int v = std::max(top, 0); v <= std::min(bottom, height_ - 1); ++v) word_of(k * kWord, v) |= bits;
  }
}

void PixelMask::add_polygon(std::span<const Eigen::Vector2d> corners) {
  std::vector<double> crossings;
  for (int v = 0; v < height_; ++v) {
    crossings.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d& a = corners[i];
      const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
      if ((a.y() <= v) == (b.y() <= v)) continue;
      crossings.push_back(a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double first = std::max(0.0, std::ceil(crossings[i]));
      const double last = std::min(width_ - 1.0, std::floor(crossings[i + 1]));
      for (int u = static_cast<int>(first); u <= last; ++u) set(u, v);
    }
  }
}

void PixelMask::add_outside(const Lens& lens, double angle) {
  const double least_cosine = std::cos(angle);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      Eigen::Vector3d ray;
      if (!lens.bearing(Eigen::Vector2d(u, v), ray) || ray.z() < least_cosine) set(u, v);
    }
  }
}

void PixelMask::add_bright_half(const ImageView& picture) {
  for (int v = 0; v < std::min(height_, picture.height); ++v) {
    for (int u = 0; u < std::min(width_, picture.width); ++u) {
      const int grey = picture.format == PixelFormat::kGrey8 ? picture.row<std::uint8_t>(v)[u]
                                                             : picture.row<std::uint16_t>(v)[u];
      if (2 * grey > picture.white_level) set(u, v);
    }
  }
}

void PixelMask::add(const PixelMask& other) noexcept {
  for (std::size_t i = 0; i < std::min(words_.size(), other.words_.size()); ++i) words_[i] |= other.words_[i];
}

void PixelMask::grow(int pixels) {
  const PixelMask before = *this;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      if (before.at(u, v)) add_box(u - pixels, v - pixels, u + pixels, v + pixels);
    }
  }
}

void PixelMask::halve(const PixelMask& whole) noexcept {
  clear();
  for (int v = 0; v < std::min(whole.height_, 2 * height_); ++v) {
    for (int k = 0; k < whole.row_words_; ++k) {
      std::uint64_t word = whole.word(v, k);
      while (word != 0) {
        const int u = (k * kWord + std::countr_zero(word)) / 2;
        if (u < width_) set(u, v / 2);
        word &= word - 1;
      }
    }
  }
}

}  // namespace omma
