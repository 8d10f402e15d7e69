#include "components/approach/sky_pull.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {

double size_error_of_sky(std::span<const Pairing> pairs, std::span<const std::uint8_t> used,
                         const DotLists& dots, const std::array<double, limits::kCameras>& gain,
                         const std::array<double, limits::kCameras>& black_level) noexcept {
  constexpr double kOfAll = 0.55;
  const auto counts = [&](std::size_t i, std::size_t camera) {
    return pairs[i].camera == camera && i < used.size() && used[i] != 0;
  };
  double pulled = 0;  // Σ p d, d from the middle of the lights
  double size = 0;    // Σ d²
  for (std::size_t c = 0; c < dots.cameras.size(); ++c) {
    if (!(gain[c] > 0)) continue;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    int count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (counts(i, c)) middle += (dots.cameras[c].dots[pairs[i].dot].pixel - middle) / ++count;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!counts(i, c)) continue;
      const Dot& dot = dots.cameras[c].dots[pairs[i].dot];
      const double step = std::max(double(dot.background) - black_level[c], 0.0);
      const double width = 0.5 * (double(dot.sigma_major) + double(dot.sigma_minor));
      const double pull = 8 * std::numbers::pi * width * width * width * step /
                          (std::sqrt(2 * std::numbers::pi) * std::max(double(dot.flux), 1.0));
      const double distance = (dot.pixel - middle).norm();
      pulled += std::min(pull, width) * distance;
      size += distance * distance;
    }
  }
  return size > 0 ? kOfAll * pulled / size : 0.0;
}

}  // namespace omma
