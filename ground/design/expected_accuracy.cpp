#include "ground/design/expected_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "components/catalogue/star_catalogue.hpp"
#include "ground/design/even_sphere.hpp"
#include "ground/report/bound.hpp"
#include "ground/report/statistics.hpp"

namespace omma::ground {
namespace {

constexpr int kAttitudes = 500;

bool every_spot(const TruthSpot& /*spot*/) {
  return true;
}

std::vector<TruthSpot> star_spots(const PaperRig& paper, std::span<const SkyStar> stars,
                                  const Eigen::Quaterniond& rig_from_j2000, double dot_sigma) {
  std::vector<TruthSpot> spots;
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c) {
    const RigCamera& camera = paper.rig.cameras[c];
    const Eigen::Matrix3d camera_from_j2000 =
        (camera.rig_from_camera.rotation.conjugate() * rig_from_j2000).toRotationMatrix();
    const double least_cosine = std::cos(paper.reach(c));
    for (const SkyStar& star : stars) {
      const Eigen::Vector3d direction = camera_from_j2000 * star.direction;
      if (direction.z() < least_cosine) continue;
      TruthSpot spot;
      if (!paper.sees(c, direction, spot.pixel)) continue;
      spot.camera = static_cast<int>(c);
      spot.information = Eigen::Matrix2d::Identity() / (dot_sigma * dot_sigma);
      spots.push_back(spot);
    }
  }
  return spots;
}

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
    const std::vector<TruthSpot> spots = star_spots(paper, catalogue.stars(), attitude, dot_sigma);
    std::vector<int> count(paper.rig.cameras.size(), 0);
    for (const TruthSpot& spot : spots) ++count[static_cast<std::size_t>(spot.camera)];
    for (std::size_t c = 0; c < count.size(); ++c) per_camera[c].push_back(count[c]);
    together.push_back(static_cast<double>(spots.size()));
    Eigen::Matrix3d covariance;
    if (spots.size() >= 3 && bound_of(attitude_information(paper.rig, spots, every_spot), covariance)) {
      sigma.push_back(std::sqrt(covariance.trace() / 3));
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
  // The body's x to the camera's right, y up, z back at the camera.
  const Eigen::Quaterniond camera_from_body(0, 1, 0, 0);
  std::vector<std::optional<ExpectedPose>> all;
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c) {
    const RigCamera& camera = paper.rig.cameras[c];
    const Pose rig_from_body = camera.rig_from_camera * Pose{camera_from_body, Eigen::Vector3d(0, 0, range)};
    std::vector<TruthSpot> spots;
    for (const Target& target : body.targets) {
      TruthSpot spot;
      spot.kind = TruthSpot::Kind::kTarget;
      spot.camera = static_cast<int>(c);
      spot.body = body.name.view();
      spot.id = target.id.view();
      spot.information = Eigen::Matrix2d::Identity() / (dot_sigma * dot_sigma);
      const Eigen::Vector3d in_camera = camera.rig_from_camera.inverse() * (rig_from_body * target.position);
      if (paper.sees(c, in_camera, spot.pixel)) spots.push_back(spot);
    }
    Matrix6d covariance;
    if (spots.size() < 3 ||
        !bound_of(pose_information(paper.rig, spots, body, rig_from_body, every_spot), covariance)) {
      all.emplace_back(std::nullopt);
      continue;
    }
    all.push_back(ExpectedPose{static_cast<int>(spots.size()),
                               std::sqrt(covariance.bottomRightCorner<3, 3>().trace()),
                               std::sqrt(covariance.topLeftCorner<3, 3>().trace())});
  }
  return all;
}

}  // namespace omma::ground
