#include "ground/calibrate/refine_dots.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace omma::ground {
namespace {

constexpr std::size_t kFewestDots = 12;
constexpr float kBrightSnr = 20;
constexpr double kLeastWidth = 0.6;  // [px]
constexpr double kLargestWidth = 4;
constexpr int kIterations = 40;
constexpr double kConverged = 1e-4;  // [px]
constexpr double kFarthest = 1.0;    // a centre does not move farther [px]

double level(const ImageView& image, int u, int v) {
  return image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
}

double common_width(const DotList& list) {
  std::vector<double> widths;
  for (const Dot& dot : list.dots) {
    if (dot.snr < kBrightSnr || (dot.flags & (kDotSaturated | kDotAtEdge)) != 0) continue;
    widths.push_back(std::sqrt(double(dot.sigma_major) * dot.sigma_minor));
  }
  if (widths.size() < kFewestDots) return 0;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return std::clamp(*middle, kLeastWidth, kLargestWidth);
}

// The background of a ring, not the extractor's wide map: airglow and the Milky Way slope.
double ring_background(const ImageView& image, const Eigen::Vector2d& at, double width) {
  const int radius = static_cast<int>(std::ceil(6 * width)) + 4;
  std::vector<double> ring;
  for (int v = std::max(0, int(at.y()) - radius); v <= std::min(image.height - 1, int(at.y()) + radius);
       ++v) {
    for (int u = std::max(0, int(at.x()) - radius); u <= std::min(image.width - 1, int(at.x()) + radius);
         ++u) {
      const double r = std::hypot(u - at.x(), v - at.y());
      if (r > radius - 4 && r < radius) ring.push_back(level(image, u, v));
    }
  }
  if (ring.empty()) return 0;
  const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
  std::nth_element(ring.begin(), middle, ring.end());
  return *middle;
}

// One step of the least-squares fit of a Gaussian's place: twice the weighted moment.
bool step_of(const ImageView& image, double background, double width, const Eigen::Vector2d& at,
             Eigen::Vector2d& step) {
  const int radius = static_cast<int>(std::ceil(4 * width));
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double sum = 0;
  const int cu = static_cast<int>(std::lround(at.x()));
  const int cv = static_cast<int>(std::lround(at.y()));
  for (int v = std::max(0, cv - radius); v <= std::min(image.height - 1, cv + radius); ++v) {
    for (int u = std::max(0, cu - radius); u <= std::min(image.width - 1, cu + radius); ++u) {
      const Eigen::Vector2d away(u - at.x(), v - at.y());
      const double light =
          (level(image, u, v) - background) * std::exp(-0.5 * away.squaredNorm() / (width * width));
      moment += light * away;
      sum += light;
    }
  }
  if (!(sum > 0)) return false;
  step = 2 * moment / sum;
  return step.allFinite();
}

}  // namespace

double refine_dots(const ImageView& image, DotList& list) {
  const double width = common_width(list);
  if (width == 0) return 0;
  for (Dot& dot : list.dots) {
    if ((dot.flags & (kDotSaturated | kDotAtEdge)) != 0) continue;
    const double background = ring_background(image, dot.pixel, width);
    Eigen::Vector2d at = dot.pixel;
    Eigen::Vector2d step;
    bool settled = false;
    for (int k = 0; k < kIterations && !settled && step_of(image, background, width, at, step); ++k) {
      at += step.cwiseMax(-0.5).cwiseMin(0.5);
      settled = step.norm() < kConverged;
    }
    if (settled && (at - dot.pixel).norm() < kFarthest) dot.pixel = at;
  }
  return width;
}

}  // namespace omma::ground
