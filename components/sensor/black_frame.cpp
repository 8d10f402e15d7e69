#include "components/sensor/black_frame.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

float median_of(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

float BlackFrame::typical_mean() const {
  return median_of(mean);
}
float BlackFrame::typical_noise() const {
  return median_of(noise);
}

bool BlackFrameBuilder::add(const ImageView& dark) {
  if (frames_ == 0) {
    width_ = dark.width;
    height_ = dark.height;
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (auto* values : {&sum_, &squares_, &first_}) values->assign(pixels, 0);
  }
  if (dark.width != width_ || dark.height != height_) return false;
  std::size_t i = 0;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u, ++i) {
      const double grey =
          dark.format == PixelFormat::kGrey8 ? dark.row<std::uint8_t>(v)[u] : dark.row<std::uint16_t>(v)[u];
      if (frames_ == 0) first_[i] = grey;
      sum_[i] += grey - first_[i];
      squares_[i] += (grey - first_[i]) * (grey - first_[i]);
    }
  }
  ++frames_;
  return true;
}

BlackFrame BlackFrameBuilder::build(const HotPixelRule& rule, HotPixelCounts& counts) const {
  BlackFrame black;
  black.width = width_;
  black.height = height_;
  black.frames = frames_;
  black.hot = PixelMask(width_, height_);
  counts = {};
  if (frames_ == 0) return black;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    const double mean = sum_[i] / frames_;
    const double variance =
        frames_ > 1 ? std::max(0.0, (squares_[i] - frames_ * mean * mean) / (frames_ - 1)) : 0;
    black.mean.push_back(static_cast<float>(first_[i] + mean));
    black.noise.push_back(static_cast<float>(std::sqrt(variance)));
  }
  const float typical = black.typical_mean();
  const float typical_noise = black.typical_noise();
  std::vector<float> deviations;
  deviations.reserve(black.mean.size());
  for (const float mean : black.mean) deviations.push_back(std::fabs(mean - typical));
  const double spread = 1.4826 * static_cast<double>(median_of(deviations));
  const double too_bright = std::max(rule.least, rule.above * spread);
  const double too_noisy = std::max(rule.least, rule.noisier * static_cast<double>(typical_noise));
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const auto i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
      const bool bright = static_cast<double>(black.mean[i] - typical) > too_bright;
      const bool noisy = static_cast<double>(black.noise[i]) > too_noisy;
      counts.bright += bright ? 1 : 0;
      counts.noisy += noisy ? 1 : 0;
      if (!bright && !noisy) continue;
      ++counts.all;
      black.hot.add_box(u, v, u, v);
    }
  }
  return black;
}

}  // namespace omma
