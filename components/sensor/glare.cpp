#include "components/sensor/glare.hpp"

#include <algorithm>
#include <cmath>

namespace omma {

Glare::Glare(int width, int height, const GlareParameters& parameters)
    : width_(width),
      height_(height),
      columns_((width + kBlock - 1) / kBlock),
      rows_((height + kBlock - 1) / kBlock),
      parameters_(parameters),
      bright_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  region_.resize(bright_.size());
  near_.resize(bright_.size());
  line_.resize(static_cast<std::size_t>(std::max(columns_, rows_)));
}

// A block is bright where more than half of every fourth pixel of every fourth row are.
template <class Pixel>
void Glare::find_bright(const ImageView& image) noexcept {
  const int level = static_cast<int>(parameters_.bright * image.white_level);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      int over = 0;
      int samples = 0;
      for (int v = row * kBlock + 1; v < std::min((row + 1) * kBlock, height_); v += 4) {
        const Pixel* x = image.row<Pixel>(v);
        for (int u = column * kBlock + 1; u < std::min((column + 1) * kBlock, width_); u += 4) {
          over += x[u] > level ? 1 : 0;
          ++samples;
        }
      }
      bright_[static_cast<std::size_t>(row * columns_ + column)] = 2 * over > samples ? 1 : 0;
    }
  }
}

// The blocks connected (8 neighbours) to one, into region_; each is visited once in all.
int Glare::region_from(int block) noexcept {
  int count = 0;
  const auto take = [&](int at) {
    bright_[static_cast<std::size_t>(at)] = 0;
    region_[static_cast<std::size_t>(count++)] = at;
  };
  take(block);
  for (int next = 0; next < count; ++next) {
    const int row = region_[static_cast<std::size_t>(next)] / columns_;
    const int column = region_[static_cast<std::size_t>(next)] % columns_;
    for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c) {
        if (bright_[static_cast<std::size_t>(r * columns_ + c)] != 0) take(r * columns_ + c);
      }
    }
  }
  return count;
}

// The halo of a bright region is as wide as a share of the region itself: the region's blocks are widened by
// the margin along rows, then along columns.
void Glare::mask_region(int size, PixelMask& mask) noexcept {
  const double diameter = 2 * std::sqrt(size / M_PI);
  const int margin = std::max(1, static_cast<int>(std::lround(parameters_.margin * diameter)));
  std::fill(near_.begin(), near_.end(), std::uint8_t{0});
  for (int i = 0; i < size; ++i) near_[static_cast<std::size_t>(region_[static_cast<std::size_t>(i)])] = 1;
  const auto widen = [&](int first, int step, int count) {
    int left = 0;  // blocks that a set one still reaches
    for (int k = 0; k < count; ++k) {
      const std::uint8_t set = near_[static_cast<std::size_t>(first + k * step)];
      line_[static_cast<std::size_t>(k)] = set != 0 || left > 0 ? 1 : 0;
      left = set != 0 ? margin : left - 1;
    }
    left = 0;
    for (int k = count; k-- > 0;) {
      std::uint8_t& block = near_[static_cast<std::size_t>(first + k * step)];
      const std::uint8_t set = block;
      block = line_[static_cast<std::size_t>(k)] != 0 || left > 0 ? 1 : 0;
      left = set != 0 ? margin : left - 1;
    }
  };
  for (int row = 0; row < rows_; ++row) widen(row * columns_, 1, columns_);
  for (int column = 0; column < columns_; ++column) widen(column, columns_, rows_);
  for (int block = 0; block < columns_ * rows_; ++block) {
    if (near_[static_cast<std::size_t>(block)] == 0) continue;
    const int u = block % columns_ * kBlock;
    const int v = block / columns_ * kBlock;
    mask.add_box(u, v, u + kBlock - 1, v + kBlock - 1);
  }
}

int Glare::add_to(const ImageView& image, PixelMask& mask) noexcept {
  if (image.empty() || image.width != width_ || image.height != height_) return 0;
  if (image.format == PixelFormat::kGrey8) {
    find_bright<std::uint8_t>(image);
  } else {
    find_bright<std::uint16_t>(image);
  }
  int regions = 0;
  for (int block = 0; block < columns_ * rows_; ++block) {
    if (bright_[static_cast<std::size_t>(block)] == 0) continue;
    const int size = region_from(block);
    if (size < parameters_.least_blocks) continue;
    mask_region(size, mask);
    ++regions;
  }
  return regions;
}

}  // namespace omma
