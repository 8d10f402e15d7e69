#include "components/sensor/frame_correction.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// A black frame may age by so much; what goes further is no ageing [grey levels].
constexpr float kMostDrift = 64;
constexpr std::size_t kLevels = 65536;

}  // namespace

FrameCorrection::FrameCorrection(int width, int height, const SensorCalibration& calibration)
    : width_(width),
      height_(height),
      black_(calibration.black),
      response_(calibration.response),
      pedestal_(calibration.black.empty()
                    ? calibration.black_level
                    : std::round(static_cast<double>(calibration.black.typical_mean()))),
      step_(static_cast<float>(calibration.ageing_step)) {
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!black_.empty()) {
    offset_.reserve(pixels);
    for (const float mean : black_.mean)
      offset_.push_back(static_cast<std::int16_t>(
          std::clamp(std::lround(static_cast<double>(mean) - pedestal_), -32768L, 32767L)));
    if (step_ > 0) drift_.resize(pixels);
    list_hot_pixels();
  }
  if (!response_.empty()) even_.resize(kLevels);
  if (!black_.empty() || !response_.empty()) pixels_.resize(2 * pixels);
}

void FrameCorrection::list_hot_pixels() {
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      if (!black_.hot.at(u, v)) continue;
      HotPixel hot{u, v, {}, 0};
      for (const auto& [du, dv] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int x = u + du;
        const int y = v + dv;
        if (x < 0 || y < 0 || x >= width_ || y >= height_ || black_.hot.at(x, y)) continue;
        hot.beside[static_cast<std::size_t>(hot.count++)] = {x, y};
      }
      hot_.push_back(hot);
    }
  }
}

template <class Raw, class Out>
void FrameCorrection::correct_rows(const ImageView& raw) noexcept {
  const int white = raw.white_level;
  for (int v = 0; v < height_; ++v) {
    const Raw* x = raw.row<Raw>(v);
    auto* out = reinterpret_cast<Out*>(pixels_.data()) + at(0, v);
    if (black_.empty()) {
      for (int u = 0; u < width_; ++u) out[u] = even_[x[u]];
      continue;
    }
    const std::int16_t* offset = &offset_[at(0, v)];
    for (int u = 0; u < width_; ++u) {
      const int less = std::clamp(x[u] - offset[u], 0, white - 1);
      out[u] = static_cast<Out>(x[u] >= white ? white : less);
    }
    if (even_.empty()) continue;
    for (int u = 0; u < width_; ++u) out[u] = static_cast<Out>(even_[out[u]]);
  }
}

template <class Out>
void FrameCorrection::fill_in_hot() noexcept {
  auto* pixels = reinterpret_cast<Out*>(pixels_.data());
  for (const HotPixel& hot : hot_) {
    int sum = 0;
    for (int i = 0; i < hot.count; ++i) {
      const auto& [u, v] = hot.beside[static_cast<std::size_t>(i)];
      sum += pixels[at(u, v)];
    }
    pixels[at(hot.u, hot.v)] =
        static_cast<Out>(hot.count > 0 ? (sum + hot.count / 2) / hot.count : pedestal_);
  }
}

ImageView FrameCorrection::correct(const ImageView& raw) noexcept {
  corrected_ = raw;
  const bool even = response_.empty();
  if (raw.empty() || raw.width != width_ || raw.height != height_ || (black_.empty() && even)) return raw;
  if (!even && raw.white_level != white_) {
    response_.even_levels(raw.white_level, pedestal_, even_);
    white_ = raw.white_level;
  }
  const bool wide_in = raw.format == PixelFormat::kGrey16;
  const bool wide_out = wide_in || !even;
  if (wide_in) {
    correct_rows<std::uint16_t, std::uint16_t>(raw);
  } else if (wide_out) {
    correct_rows<std::uint8_t, std::uint16_t>(raw);
  } else {
    correct_rows<std::uint8_t, std::uint8_t>(raw);
  }
  if (wide_out) {
    fill_in_hot<std::uint16_t>();
  } else {
    fill_in_hot<std::uint8_t>();
  }
  corrected_.data = pixels_.data();
  corrected_.format = wide_out ? PixelFormat::kGrey16 : PixelFormat::kGrey8;
  corrected_.stride = static_cast<std::ptrdiff_t>(width_) * (wide_out ? 2 : 1);
  if (!even) corrected_.white_level = 65535;
  return corrected_;
}

// The sign of the difference, not its size: a star that crosses the pixel weighs no more than noise, and what
// is followed is the median.
void FrameCorrection::age_row(int v, const float* level) noexcept {
  if (!ages() || corrected_.empty()) return;
  const auto follow = [&]<class Pixel>(const Pixel* x) {
    for (int u = 0; u < width_; ++u) {
      const std::size_t i = at(u, v);
      const auto grey = static_cast<float>(x[u]);
      const float way = grey > level[u] ? step_ : grey < level[u] ? -step_ : 0;
      const float drift = std::clamp(drift_[i] + way, -kMostDrift, kMostDrift);
      black_.mean[i] += drift - drift_[i];
      drift_[i] = drift;
      const float offset = black_.mean[i] - static_cast<float>(pedestal_);
      offset_[i] = static_cast<std::int16_t>(offset + (offset < 0 ? -0.5F : 0.5F));
    }
  };
  if (corrected_.format == PixelFormat::kGrey8) {
    follow(corrected_.row<std::uint8_t>(v));
  } else {
    follow(corrected_.row<std::uint16_t>(v));
  }
}

}  // namespace omma
