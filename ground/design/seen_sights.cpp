#include "ground/design/seen_sights.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "components/geometry/rig_dot.hpp"

namespace omma::ground {
namespace {

/// @param ray    true direction from the true camera, rig frame
/// @param point  where the point is believed to be
void add(const PaperRig& paper, std::size_t c, const Eigen::Vector3d& ray, const Eigen::Vector3d& point,
         std::uint16_t entry, const DotErrors& errors, SeenSights& seen) {
  const RigCamera& camera = paper.rig.cameras[c];
  const Eigen::Quaterniond& rotation = camera.rig_from_camera.rotation;
  const Eigen::Vector3d read =
      errors.mistakes == nullptr
          ? ray
          : believed_ray(errors.mistakes->cameras[c], rotation * Eigen::Vector3d::UnitZ(), ray);
  Dot dot;
  if (!paper.sees(c, rotation.conjugate() * read, dot.pixel)) return;
  dot.covariance = errors.sigma_px * errors.sigma_px * Eigen::Matrix2d::Identity();
  if (errors.random != nullptr) dot.pixel += errors.sigma_px * normal_vector(*errors.random).head<2>();
  RigDot rig_dot_seen;
  const auto index = static_cast<std::uint16_t>(seen.sights.size());
  if (!rig_dot(dot, index, camera, static_cast<std::uint8_t>(c), 0, rig_dot_seen)) return;
  seen.sights.push_back({rig_dot_seen.origin, rig_dot_seen.ray, rig_dot_seen.whitener, point});
  seen.sources.push_back({static_cast<std::uint8_t>(c), entry});
}

}  // namespace

SeenSights seen_stars(const PaperRig& paper, std::span<const SkyStar> stars,
                      const Eigen::Quaterniond& rig_from_j2000, const DotErrors& errors) {
  SeenSights seen;
  const CameraAxes axes = camera_axes(paper.rig);
  std::array<double, limits::kCameras> least_cosine{};
  constexpr double kMargin = 0.1;  // [rad], for calibrations that are wrong
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c)
    least_cosine[c] = std::cos(std::min(std::numbers::pi, paper.reach(c) + kMargin));
  for (const SkyStar& star : stars) {
    const Eigen::Vector3d ray = rig_from_j2000 * star.direction;
    for (std::size_t c = 0; c < paper.rig.cameras.size() && seen.sights.size() < errors.most; ++c)
      if (ray.dot(axes[c]) >= least_cosine[c]) add(paper, c, ray, star.direction, 0, errors, seen);
  }
  return seen;
}

SeenSights seen_targets(const PaperRig& paper, const TargetBody& body, const Pose& rig_from_body,
                        const DotErrors& errors) {
  SeenSights seen;
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c) {
    Eigen::Vector3d centre = paper.rig.cameras[c].rig_from_camera.translation;
    if (errors.mistakes != nullptr) centre += errors.mistakes->cameras[c].position;
    for (std::size_t i = 0; i < body.targets.size(); ++i) {
      Eigen::Vector3d truly = body.targets[i].position;
      if (errors.mistakes != nullptr)
        truly = errors.mistakes->body_scale * truly + errors.mistakes->targets[i];
      add(paper, c, (rig_from_body * truly - centre).normalized(), body.targets[i].position,
          static_cast<std::uint16_t>(i), errors, seen);
    }
  }
  return seen;
}

}  // namespace omma::ground
