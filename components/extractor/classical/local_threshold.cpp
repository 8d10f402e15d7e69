#include "components/extractor/classical/local_threshold.hpp"

#include <algorithm>
#include <cmath>

#include "components/extractor/index.hpp"

namespace omma {

LocalThreshold::LocalThreshold(int width) {
  for (auto* columns : {&sum_, &square_, &sum_before_, &square_before_}) columns->resize(index_of(width) + 1);
}

void LocalThreshold::apply(const GreyImage& image, int window, double deviations,
                           GreyImage& binary) noexcept {
  const int reach = window / 2;
  std::fill(sum_.begin(), sum_.end(), 0.0);
  std::fill(square_.begin(), square_.end(), 0.0);
  for (int v = 0; v < std::min(reach, image.height); ++v) add_row(image.row(v), 1);
  for (int v = 0; v < image.height; ++v) {
    if (v + reach < image.height) add_row(image.row(v + reach), 1);
    if (v - reach > 0) add_row(image.row(v - reach - 1), -1);
    const int rows = std::min(v + reach, image.height - 1) - std::max(v - reach, 0) + 1;
    judge_row(image.row(v), rows, window, deviations, binary.row(v));
  }
}

void LocalThreshold::add_row(const float* row, double sign) noexcept {
  for (std::size_t u = 0; u + 1 < sum_.size(); ++u) {
    const double x = row[u];
    sum_[u] += sign * x;
    square_[u] += sign * x * x;
  }
}

void LocalThreshold::judge_row(const float* row, int rows, int window, double deviations,
                               float* out) noexcept {
  const std::size_t width = sum_.size() - 1;
  const auto reach = index_of(window / 2);
  for (std::size_t u = 0; u < width; ++u) {
    sum_before_[u + 1] = sum_before_[u] + sum_[u];
    square_before_[u + 1] = square_before_[u] + square_[u];
  }
  for (std::size_t u = 0; u < width; ++u) {
    const std::size_t left = u < reach ? 0 : u - reach;
    const std::size_t right = std::min(width, u + reach + 1);
    const double n = static_cast<double>(right - left) * rows;
    const double mean = (sum_before_[right] - sum_before_[left]) / n;
    const double variance = std::max(0.0, (square_before_[right] - square_before_[left]) / n - mean * mean);
    // The small margin keeps rounding from lighting even areas.
    const double over = row[u] - mean - 1e-4 * std::abs(mean) - 1e-6;
    out[u] = over > deviations * std::sqrt(variance) ? 1 : 0;
  }
}

}  // namespace omma
