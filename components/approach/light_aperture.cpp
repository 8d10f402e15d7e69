#include "components/approach/light_aperture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr std::size_t kRingPixels = 2048;

struct RingLevel {
  double level = 0;
  int pixels = 0;  // that it is the mean of
};

template <class Pixel>
RingLevel ring_level(const ImageView& image, const Aperture& aperture, double radius) noexcept {
  std::array<float, kRingPixels> levels;
  std::size_t count = 0;
  const double inner = radius + 1;
  const double outer = inner + Aperture::kRing;
  const int top = static_cast<int>(std::ceil(aperture.centre.y() - outer));
  const int left = static_cast<int>(std::ceil(aperture.centre.x() - outer));
  for (int v = top; v <= aperture.centre.y() + outer; ++v) {
    const Pixel* row = image.row<Pixel>(v);
    for (int u = left; u <= aperture.centre.x() + outer; ++u) {
      const double distance = root_sum_square(u - aperture.centre.x(), v - aperture.centre.y());
      if (distance > inner && distance <= outer && count < levels.size()) levels[count++] = row[u];
    }
  }
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(levels.begin(), middle, levels.begin() + static_cast<std::ptrdiff_t>(count));
  // Grey levels are whole numbers: the mean of those next to the median is finer than it.
  double sum = 0;
  int near = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(levels[i] - *middle) > 2.5 * aperture.noise + 1) continue;
    sum += levels[i];
    ++near;
  }
  return {sum / near, near};
}

template <class Pixel>
bool measure(const ImageView& image, const Aperture& aperture, Dot& out) noexcept {
  const double radius = std::min(aperture.radius, Aperture::kLargest);
  const double outer = radius + 1 + Aperture::kRing;
  const Eigen::Vector2d c = aperture.centre;
  if (!(c.x() - outer >= 0 && c.y() - outer >= 0 && c.x() + outer <= image.width - 1 &&
        c.y() + outer <= image.height - 1))
    return false;
  const auto [level, ring_pixels] = ring_level<Pixel>(image, aperture, radius);
  int pixels = 0;
  double flux = 0;
  double variance = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  // of the pixels' variances about the circle's centre
  out.flags = 0;
  for (int v = static_cast<int>(std::ceil(c.y() - radius)); v <= c.y() + radius; ++v) {
    const Pixel* row = image.row<Pixel>(v);
    for (int u = static_cast<int>(std::ceil(c.x() - radius)); u <= c.x() + radius; ++u) {
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - c;
      if (offset.squaredNorm() > radius * radius) continue;
      const double light = row[u] - level;
      const double of_light = aperture.gain > 0 ? std::max(light, 0.0) / aperture.gain : 0.0;
      const double of_pixel = aperture.noise * aperture.noise + of_light;
      ++pixels;
      flux += light;
      variance += of_pixel;
      first += light * offset;
      second += of_pixel * offset * offset.transpose();
      if (row[u] >= image.white_level) out.flags |= kDotSaturated;
    }
  }
  // The level is wrong by the same in every pixel.
  variance += aperture.noise * aperture.noise * pixels * pixels / ring_pixels;
  if (!(flux > 0)) return false;
  const Eigen::Vector2d centre = first / flux;
  out.pixel = c + centre;
  out.covariance = (second + variance * centre * centre.transpose()) / (flux * flux);
  out.flux = static_cast<float>(flux);
  out.snr = static_cast<float>(flux / std::sqrt(variance));
  out.background = static_cast<float>(level);
  return true;
}

}  // namespace

bool measure_aperture(const ImageView& image, const Aperture& aperture, Dot& out) noexcept {
  if (image.empty()) return false;
  return image.format == PixelFormat::kGrey8 ? measure<std::uint8_t>(image, aperture, out)
                                             : measure<std::uint16_t>(image, aperture, out);
}

}  // namespace omma
