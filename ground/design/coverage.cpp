#include "ground/design/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ground/design/even_sphere.hpp"

namespace omma::ground {
namespace {

constexpr int kDirections = 80'000;
// Two blind directions nearer than this belong together: 1.6 times the lattice's spacing [rad].
const double kNeighbourCosine = std::cos(1.6 * std::sqrt(4 * std::numbers::pi / kDirections));

// Groups blind directions that touch. The lattice runs from pole to pole, so neighbours have near z.
std::vector<BlindSpot> blind_spots(const std::vector<Eigen::Vector3d>& blind) {
  std::vector<std::size_t> group(blind.size());
  for (std::size_t i = 0; i < blind.size(); ++i) group[i] = i;
  const auto root = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  const double reach = std::acos(kNeighbourCosine);
  for (std::size_t i = 0; i < blind.size(); ++i) {
    for (std::size_t k = i + 1; k < blind.size() && blind[i].z() - blind[k].z() < reach; ++k) {
      if (blind[i].dot(blind[k]) > kNeighbourCosine) group[root(k)] = root(i);
    }
  }
  std::vector<Eigen::Vector3d> sum(blind.size(), Eigen::Vector3d::Zero());
  std::vector<int> count(blind.size(), 0);
  for (std::size_t i = 0; i < blind.size(); ++i) {
    sum[root(i)] += blind[i];
    ++count[root(i)];
  }
  std::vector<BlindSpot> spots;
  for (std::size_t i = 0; i < blind.size(); ++i) {
    if (count[i] > 0) spots.push_back({sum[i].normalized(), double(count[i]) / kDirections});
  }
  std::sort(spots.begin(), spots.end(),
            [](const BlindSpot& a, const BlindSpot& b) { return a.share > b.share; });
  return spots;
}

bool sees_all(const PaperRig& paper, const std::vector<Eigen::Vector3d>& directions, double distance) {
  return std::all_of(directions.begin(), directions.end(), [&](const Eigen::Vector3d& direction) {
    return cameras_seeing(paper, direction, distance) > 0;
  });
}

}  // namespace

int cameras_seeing(const PaperRig& paper, const Eigen::Vector3d& direction, double distance) {
  int count = 0;
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c) {
    const Pose& pose = paper.rig.cameras[c].rig_from_camera;
    const Eigen::Vector3d ray =
        std::isinf(distance) ? direction : Eigen::Vector3d(distance * direction - pose.translation);
    Eigen::Vector2d pixel;
    if (paper.sees(c, pose.rotation.conjugate() * ray, pixel)) ++count;
  }
  return count;
}

Coverage coverage_of(const PaperRig& paper, double distance) {
  Coverage coverage;
  coverage.distance = distance;
  std::vector<Eigen::Vector3d> blind;
  for (const Eigen::Vector3d& direction : even_directions(kDirections)) {
    const int count = cameras_seeing(paper, direction, distance);
    coverage.share[static_cast<std::size_t>(count)] += 1.0 / kDirections;
    if (count == 0) blind.push_back(direction);
  }
  coverage.blind = blind_spots(blind);
  return coverage;
}

std::optional<double> whole_sky_beyond(const PaperRig& paper) {
  const std::vector<Eigen::Vector3d> directions = even_directions(kDirections);
  if (!sees_all(paper, directions, kInfinitelyFar)) return std::nullopt;
  double near = 0;
  for (const RigCamera& camera : paper.rig.cameras)
    near = std::max(near, camera.rig_from_camera.translation.norm());
  near = std::max(near, 1e-3);
  if (sees_all(paper, directions, near)) return near;
  double far = 2 * near;
  while (!sees_all(paper, directions, far)) {
    if (far > 1e6 * near) return std::nullopt;
    near = far;
    far *= 2;
  }
  while (far > 1.01 * near) {
    const double middle = std::sqrt(near * far);
    (sees_all(paper, directions, middle) ? far : near) = middle;
  }
  return far;
}

Eigen::Vector3d map_direction(double u, double v, int width, int height) {
  const double longitude = std::numbers::pi * (1 - 2 * (u + 0.5) / width);
  const double latitude = std::numbers::pi * (0.5 - (v + 0.5) / height);
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

Eigen::Vector2d map_place(const Eigen::Vector3d& direction, int width, int height) {
  const double longitude = std::atan2(direction.y(), direction.x());
  const double latitude = std::asin(std::clamp(direction.z(), -1.0, 1.0));
  return {0.5 * width * (1 - longitude / std::numbers::pi) - 0.5,
          height * (0.5 - latitude / std::numbers::pi) - 0.5};
}

CoverageMap coverage_map(const PaperRig& paper, double distance, int width) {
  CoverageMap map{width, width / 2, {}};
  map.cameras.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  for (int v = 0; v < map.height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int count = cameras_seeing(paper, map_direction(u, v, width, map.height), distance);
      map.cameras.push_back(static_cast<std::uint8_t>(count));
    }
  }
  return map;
}

}  // namespace omma::ground
