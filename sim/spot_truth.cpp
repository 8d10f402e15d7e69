#include "sim/spot_truth.hpp"

#include <algorithm>
#include <cmath>

namespace omma::sim {
namespace {

// Pixels that any of the spot's points reach, inside the image.
void fit_patch(const CameraView& camera, std::span<const PointSource> points, Patch& patch) {
  float left = points.front().u;
  float right = left;
  float top = points.front().v;
  float bottom = top;
  for (const PointSource& point : points) {
    left = std::min(left, point.u);
    right = std::max(right, point.u);
    top = std::min(top, point.v);
    bottom = std::max(bottom, point.v);
  }
  const int radius = camera.point_spread().radius() + 1;
  patch.u0 = std::max(0, static_cast<int>(std::floor(left)) - radius);
  patch.v0 = std::max(0, static_cast<int>(std::floor(top)) - radius);
  patch.width = std::min(camera.width(), static_cast<int>(std::floor(right)) + radius + 2) - patch.u0;
  patch.height = std::min(camera.height(), static_cast<int>(std::floor(bottom)) + radius + 2) - patch.v0;
  const std::size_t pixels = static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height);
  patch.value.assign(pixels, 0.0F);
  patch.by_u.assign(pixels, 0.0F);
  patch.by_v.assign(pixels, 0.0F);
}

}  // namespace

SpotTruth truth_of(const CameraView& camera, const Spot& spot, const SpotList& list,
                   std::span<const float> mean, Patch& patch) {
  SpotTruth truth;
  truth.spot = spot;
  const auto points = list.points_of(spot);
  fit_patch(camera, points, patch);
  for (const PointSource& point : points) {
    camera.point_spread().add(point, patch);
    truth.flux += point.flux;
  }
  const double full = camera.sensor().saturation();
  const double empty = camera.sensor().blackout();
  double slope_sum = 0;
  double light_sum = 0;
  const float peak = *std::max_element(patch.value.begin(), patch.value.end());
  double snr_squared = 0;
  for (int j = 0; j < patch.height; ++j) {
    for (int i = 0; i < patch.width; ++i) {
      const auto at = static_cast<std::size_t>(j * patch.width + i);
      const double level =
          mean[static_cast<std::size_t>(patch.v0 + j) * static_cast<std::size_t>(camera.width()) +
               static_cast<std::size_t>(patch.u0 + i)];
      if (level >= full) {  // says nothing about the light it holds
        truth.saturated = truth.saturated || patch.value[at] > 0.1F * peak;
        continue;
      }
      if (level <= empty) continue;
      slope_sum += patch.value[at] * camera.sensor().slope(level);
      light_sum += patch.value[at];
      const double weight = 1.0 / camera.sensor().variance(level);
      const double by_u = patch.by_u[at];
      const double by_v = patch.by_v[at];
      snr_squared += weight * patch.value[at] * patch.value[at];
      truth.information(0, 0) += weight * by_u * by_u;
      truth.information(0, 1) += weight * by_u * by_v;
      truth.information(1, 1) += weight * by_v * by_v;
    }
  }
  truth.flux *= light_sum != 0 ? slope_sum / light_sum : camera.sensor().slope(full);
  truth.information(1, 0) = truth.information(0, 1);
  truth.snr = std::sqrt(snr_squared);
  return truth;
}

}  // namespace omma::sim
