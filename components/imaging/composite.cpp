#include "components/imaging/composite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace omma {
namespace {

/// The light of a companded pixel that was seen: the square of its level above black.
std::uint32_t light_of(std::uint8_t pixel) {
  const std::uint32_t level = pixel - 1U;
  return level * level;
}

}  // namespace

Composite::Composite(int width, int height, ImageComposite kind)
    : width_(width), height_(height), kind_(kind) {
  if (width <= 0 || height <= 0) throw std::invalid_argument("composite: the size must be positive");
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  light_.resize(pixels);
  count_.resize(pixels);
}

void Composite::clear() noexcept {
  std::fill(light_.begin(), light_.end(), 0U);
  std::fill(count_.begin(), count_.end(), std::uint16_t{0});
}

void Composite::add(int first_row, std::span<const std::uint8_t> pixels) noexcept {
  const std::size_t from =
      static_cast<std::size_t>(std::max(first_row, 0)) * static_cast<std::size_t>(width_);
  const std::size_t many = from < light_.size() ? std::min(pixels.size(), light_.size() - from) : 0;
  for (std::size_t i = 0; i < many; ++i) {
    if (pixels[i] == 0) continue;
    std::uint32_t& light = light_[from + i];
    std::uint16_t& count = count_[from + i];
    const std::uint32_t now = light_of(pixels[i]);
    if (kind_ == ImageComposite::kMean) {
      if (count == std::numeric_limits<std::uint16_t>::max()) continue;  // 65535 · 254² still fits
      light += now;
    } else if (count == 0) {
      light = now;
    } else {
      light = kind_ == ImageComposite::kDarkest ? std::min(light, now) : std::max(light, now);
    }
    if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
  }
}

std::uint8_t Composite::value(std::size_t index) const noexcept {
  if (count_[index] == 0) return 0;
  const double light = kind_ == ImageComposite::kMean
                           ? static_cast<double>(light_[index]) / static_cast<double>(count_[index])
                           : static_cast<double>(light_[index]);
  return static_cast<std::uint8_t>(1 + std::lround(std::sqrt(light)));
}

int Composite::rows(int first_row, int rows, std::span<std::uint8_t> out) const noexcept {
  const int fitting = static_cast<int>(out.size() / static_cast<std::size_t>(width_));
  const int made = std::clamp(std::min(rows, fitting), 0, std::max(height_ - first_row, 0));
  const std::size_t from = static_cast<std::size_t>(first_row) * static_cast<std::size_t>(width_);
  const std::size_t many = static_cast<std::size_t>(made) * static_cast<std::size_t>(width_);
  for (std::size_t i = 0; i < many; ++i) out[i] = value(from + i);
  return made;
}

}  // namespace omma
