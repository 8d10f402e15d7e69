#include "ground/design/expected_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "components/catalogue/star_catalogue.hpp"
#include "ground/design/even_sphere.hpp"
#include "ground/design/prediction.hpp"
#include "ground/report/statistics.hpp"

namespace omma::ground {
namespace {

constexpr int kAttitudes = 500;

}  // namespace

Spread spread_of(std::vector<double> samples) {
  Spread spread;
  if (samples.empty()) return spread;
  spread.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / double(samples.size());
  spread.low = quantile(samples, 0.05);
  spread.median = quantile(samples, 0.5);
  spread.high = quantile(samples, 0.95);
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  spread.least = *least;
  spread.most = *most;
  return spread;
}

ExpectedSky expected_sky(const PaperRig& paper, double magnitude, double dot_sigma) {
  const StarCatalogue catalogue({}, {static_cast<float>(magnitude), 0});
  std::vector<std::vector<double>> per_camera(paper.rig.cameras.size());
  std::vector<double> together;
  std::vector<double> sigma;
  int unsolvable = 0;
  for (const Eigen::Quaterniond& attitude : even_attitudes(kAttitudes)) {
    const SeenSights seen = seen_stars(paper, catalogue.stars(), attitude, {.sigma_px = dot_sigma});
    std::vector<int> count(paper.rig.cameras.size(), 0);
    for (const SightSource& source : seen.sources) ++count[source.camera];
    for (std::size_t c = 0; c < count.size(); ++c) per_camera[c].push_back(count[c]);
    together.push_back(static_cast<double>(seen.sights.size()));
    const auto predicted = predict_attitude(paper, catalogue.stars(), attitude, dot_sigma, {});
    if (seen.sights.size() >= 3 && predicted) {
      sigma.push_back(std::sqrt(predicted->noise.topLeftCorner<3, 3>().trace() / 3));
    } else {
      ++unsolvable;
    }
  }
  ExpectedSky sky;
  for (std::vector<double>& counts : per_camera) sky.stars.push_back(spread_of(std::move(counts)));
  sky.all_stars = spread_of(std::move(together));
  sky.attitude_sigma = spread_of(std::move(sigma));
  sky.unsolvable = double(unsolvable) / kAttitudes;
  return sky;
}

std::vector<std::optional<ExpectedPose>> expected_pose(const PaperRig& paper, const TargetBody& body,
                                                       double range, double dot_sigma) {
  std::vector<std::optional<ExpectedPose>> all;
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c) {
    PaperRig alone;  // what this camera would know by itself
    alone.rig.cameras.push_back(paper.rig.cameras[c]);
    alone.half_field.push_back(paper.half_field[c]);
    const auto predicted = predict_pose(alone, body, facing_camera(paper, c, range), dot_sigma, {});
    if (!predicted) {
      all.emplace_back(std::nullopt);
      continue;
    }
    all.push_back(ExpectedPose{static_cast<int>(predicted->dots),
                               std::sqrt(predicted->noise.bottomRightCorner<3, 3>().trace()),
                               std::sqrt(predicted->noise.topLeftCorner<3, 3>().trace())});
  }
  return all;
}

Pose facing_camera(const PaperRig& paper, std::size_t camera, double range, double tilt, double off_axis) {
  // The body's x to the camera's right, y up, z back at the camera; then tilted about its own x, and carried
  // off the axis to the camera's right.
  const Eigen::Quaterniond facing(0, 1, 0, 0);
  const Eigen::Quaterniond tilted = facing * rotation_exp({tilt, 0, 0});
  const Eigen::Quaterniond aside = rotation_exp({0, off_axis, 0});
  return paper.rig.cameras[camera].rig_from_camera *
         Pose{aside * tilted, aside * Eigen::Vector3d(0, 0, range)};
}

}  // namespace omma::ground
