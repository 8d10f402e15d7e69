#include "tests/bench/fisheye_card.hpp"

#include <Eigen/LU>
#include <numbers>
#include <random>

#include "components/estimation/normal_equations.hpp"
#include "components/geometry/rig_dot.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kInch = 0.0254;
constexpr int kSide = 768;

Eigen::Quaterniond turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, axis.normalized()));
}

std::vector<RigCamera> cameras_of(const FisheyeCardOptions& options) {
  RigCamera camera;
  camera.lens = Lens::equidistant(kSide, kSide, kSide / std::numbers::pi,
                                  {0.5 * (kSide - 1), 0.5 * (kSide - 1)}, 93.5 * kDegree);
  if (options.baseline == 0) return {camera};
  constexpr double kHalfTetrahedral = 54.74;
  std::vector<RigCamera> cameras(2, camera);
  for (std::size_t k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1 : -1;
    cameras[k].rig_from_camera.rotation = turn(side * kHalfTetrahedral, Eigen::Vector3d::UnitY());
    cameras[k].rig_from_camera.translation = {0.5 * side * options.baseline, 0, 0};
  }
  return cameras;
}

}  // namespace

FisheyeCard make_fisheye_card(const FisheyeCardOptions& options, std::uint64_t seed) {
  std::mt19937_64 random(seed * 0x9e3779b97f4a7c15ULL + 11);
  std::normal_distribution<double> gauss;
  FisheyeCard card;
  const Eigen::Quaterniond facing = turn(180, Eigen::Vector3d::UnitX());
  card.truth.rotation = turn(options.off_axis_deg, Eigen::Vector3d::UnitY()) *
                        turn(options.tilt_deg, Eigen::Vector3d(1, 1, 0)) * facing;
  card.truth.translation =
      turn(options.off_axis_deg, Eigen::Vector3d::UnitY()) * Eigen::Vector3d(0, 0, card.range);

  std::vector<Sight> exact;
  const std::vector<RigCamera> cameras = cameras_of(options);
  for (const RigCamera& camera : cameras) {
    for (int i = 0; i < 25; ++i) {
      const Eigen::Vector3d target(kInch * (-5 + 2.5 * (i % 5)), kInch * (-4 + 2.0 * (i / 5)), 0);
      const Eigen::Vector3d seen = camera.rig_from_camera.inverse() * (card.truth * target);
      Dot dot;
      dot.covariance = options.noise_px * options.noise_px * Eigen::Matrix2d::Identity();
      if (!camera.lens.project(seen.normalized(), dot.pixel)) continue;
      RigDot ray;
      if (rig_dot(dot, 0, camera, 0, 0, ray)) exact.push_back({ray.origin, ray.ray, ray.whitener, target});
      const double du = gauss(random), dv = gauss(random);
      dot.pixel += options.noise_px * Eigen::Vector2d(du, dv);
      if (rig_dot(dot, 0, camera, 0, 0, ray))
        card.sights.push_back({ray.origin, ray.ray, ray.whitener, target});
    }
  }
  card.bound = normal_equations<kPoseUnknowns>(exact, {}, card.truth).information.inverse();
  return card;
}

}  // namespace omma
