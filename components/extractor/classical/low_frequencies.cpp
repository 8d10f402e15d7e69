#include "components/extractor/classical/low_frequencies.hpp"

#include <algorithm>

namespace omma {
namespace {

// Of frequency `k` of a line of n pixels, as a part of the highest.
double part_of(std::size_t k, std::size_t n) {
  return static_cast<double>(std::min(k, n - k)) / (0.5 * static_cast<double>(n));
}

}  // namespace

LowFrequencies::LowFrequencies(int width, int height)
    : width_(static_cast<std::size_t>(width)),
      height_(static_cast<std::size_t>(height)),
      half_(width_ / 2 + 1),
      spectrum_(height_ * half_),
      in_(std::max(width_, height_)),
      out_(in_.size()) {
  for (const std::size_t length : {width_, height_}) {  // the library makes its tables now
    fft_.fwd(out_.data(), in_.data(), static_cast<Eigen::Index>(length));
    fft_.inv(out_.data(), in_.data(), static_cast<Eigen::Index>(length));
  }
}

// The image's low part is a product of a projection along the rows and one along the columns: it is made on
// its own and taken away.
void LowFrequencies::remove(GreyImage& image, double part) noexcept {
  std::size_t low = 0;  // frequencies of a row below the part
  while (low < half_ && part_of(low, width_) < part) ++low;
  // Two rows are transformed as one: Z = A + iB.
  for (std::size_t v = 0; v < height_; v += 2) {
    const std::size_t second = std::min(v + 1, height_ - 1);
    const float* a = image.row(static_cast<int>(v));
    const float* b = image.row(static_cast<int>(second));
    for (std::size_t u = 0; u < width_; ++u) in_[u] = {a[u], b[u]};
    fft_.fwd(out_.data(), in_.data(), static_cast<Eigen::Index>(width_));
    for (std::size_t k = 0; k < low; ++k) {
      const Complex z = out_[k];
      const Complex mirrored = std::conj(out_[k == 0 ? 0 : width_ - k]);
      const Complex difference = z - mirrored;
      spectrum_[v * half_ + k] = 0.5F * (z + mirrored);
      spectrum_[second * half_ + k] = {0.5F * difference.imag(), -0.5F * difference.real()};
    }
  }
  keep_low_columns(low, part);
  for (std::size_t v = 0; v < height_; v += 2) {
    const std::size_t second = std::min(v + 1, height_ - 1);
    std::fill_n(in_.begin(), width_, Complex{});
    for (std::size_t k = 0; k < low; ++k) {
      const Complex a = spectrum_[v * half_ + k];
      const Complex b = spectrum_[second * half_ + k];
      in_[k] = {a.real() - b.imag(), a.imag() + b.real()};
      if (k > 0 && 2 * k != width_) in_[width_ - k] = {a.real() + b.imag(), b.real() - a.imag()};
    }
    fft_.inv(out_.data(), in_.data(), static_cast<Eigen::Index>(width_));
    float* a = image.row(static_cast<int>(v));
    float* b = image.row(static_cast<int>(second));
    for (std::size_t u = 0; u < width_; ++u) a[u] -= out_[u].real();
    if (second == v) break;
    for (std::size_t u = 0; u < width_; ++u) b[u] -= out_[u].imag();
  }
}

void LowFrequencies::keep_low_columns(std::size_t low_columns, double part) noexcept {
  for (std::size_t k = 0; k < low_columns; ++k) {
    for (std::size_t v = 0; v < height_; ++v) in_[v] = spectrum_[v * half_ + k];
    fft_.fwd(out_.data(), in_.data(), static_cast<Eigen::Index>(height_));
    for (std::size_t v = 0; v < height_; ++v)
      if (part_of(v, height_) >= part) out_[v] = {};
    fft_.inv(in_.data(), out_.data(), static_cast<Eigen::Index>(height_));
    for (std::size_t v = 0; v < height_; ++v) spectrum_[v * half_ + k] = in_[v];
  }
}

}  // namespace omma
