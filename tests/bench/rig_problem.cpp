#include "tests/bench/rig_problem.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Camera {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // rig from camera
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

struct Observation {
  int camera;
  int target;
  Eigen::Vector3d bearing;  // camera frame
};

Eigen::Matrix3d exp_so3(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  return angle < 1e-12 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity() + skew(w))
                       : Eigen::Matrix3d(Eigen::AngleAxisd(angle, w / angle));
}

Eigen::Matrix3d looking_along(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d z = axis.normalized();
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(z);
  Eigen::Matrix3d rotation;
  rotation.col(0) = basis.col(0);
  rotation.col(1) = z.cross(basis.col(0));
  rotation.col(2) = z;
  return rotation;
}

std::vector<Camera> tetrahedral_rig(int n, double baseline, double off_axis) {
  std::vector<Camera> cameras(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * k / 3.0;
    Camera& camera = cameras[static_cast<std::size_t>(k)];
    camera.rotation = looking_along(
        {std::sin(off_axis) * std::cos(azimuth), std::sin(off_axis) * std::sin(azimuth), std::cos(off_axis)});
    const double r = baseline / std::sqrt(3.0);
    camera.centre = {r * std::cos(azimuth), r * std::sin(azimuth), 0.0};
  }
  return cameras;
}

Matrix6d cramer_rao_bound(const std::vector<Observation>& observations, const std::vector<Camera>& cameras,
                          const RigProblem& problem, double sigma) {
  Matrix6d information = Matrix6d::Zero();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (problem.is_outlier[i]) continue;
    const Observation& seen = observations[i];
    const Eigen::Vector3d turned =
        problem.truth.rotation * problem.targets[static_cast<std::size_t>(seen.target)];
    const Eigen::Vector3d d =
        turned + problem.truth.translation - cameras[static_cast<std::size_t>(seen.camera)].centre;
    const double r = d.norm();
    const Eigen::Matrix<double, 3, 2> basis = tangent_basis(d / r);
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>() = -basis.transpose() * skew(turned) / r;
    jacobian.rightCols<3>() = basis.transpose() / r;
    information += jacobian.transpose() * jacobian / (sigma * sigma);
  }
  return information.inverse();
}

}  // namespace

Sight isotropic_sight(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, double sigma,
                      const Eigen::Vector3d& point) {
  Sight sight;
  sight.origin = origin;
  sight.ray = ray;
  sight.whitener = tangent_basis(ray).transpose() / sigma;
  sight.point = point;
  return sight;
}

Vector6d pose_error(const Pose& estimate, const Pose& truth) {
  Vector6d error;
  error << rotation_log(truth.rotation * estimate.rotation.conjugate()),
      truth.translation - estimate.translation;
  return error;
}

// The order in which random numbers are drawn, and the form of each expression, are the problem's definition.
RigProblem make_rig_problem(const RigProblemOptions& options, std::uint64_t seed) {
  std::mt19937_64 random(seed * 0x9e3779b97f4a7c15ULL + 1);
  std::normal_distribution<double> gauss(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double sigma = options.sigma_deg * kDegree;
  const double pi = std::numbers::pi;

  RigProblem problem;
  std::vector<Camera> cameras(1);
  if (options.cameras > 1)
    cameras = tetrahedral_rig(options.cameras, options.baseline, options.off_axis_deg * kDegree);

  const Eigen::Vector3d tilt_axis(std::cos(pi * uniform(random)), std::sin(pi * uniform(random)), 0.0);
  const Eigen::Matrix3d rotation =
      exp_so3(tilt_axis.normalized() * std::abs(uniform(random)) * options.max_tilt_deg * kDegree) *
      Eigen::AngleAxisd(pi * uniform(random), Eigen::Vector3d::UnitZ()).toRotationMatrix() *
      Eigen::AngleAxisd(pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  problem.truth.rotation = Eigen::Quaterniond(rotation);
  problem.truth.translation = Eigen::Vector3d(0.05 * uniform(random), 0.05 * uniform(random), options.range);

  for (int i = 0; i < options.targets; ++i) {
    Eigen::Vector3d point(0.5 * options.card_width * uniform(random),
                          0.5 * options.card_height * uniform(random), options.depth * uniform(random));
    if (options.surround) {
      const Camera& camera = cameras[static_cast<std::size_t>(i % options.cameras)];
      const Eigen::Vector3d in_rig =
          camera.centre + camera.rotation * (point + Eigen::Vector3d(0, 0, options.range));
      point = rotation.transpose() * (in_rig - problem.truth.translation);
    }
    problem.targets.push_back(point);
  }

  std::vector<Observation> observations;
  for (int i = 0; i < options.targets; ++i) {
    for (int k = 0; k < options.cameras; ++k) {
      if (!options.every_camera_sees_all && k != i % options.cameras) continue;
      const Camera& camera = cameras[static_cast<std::size_t>(k)];
      const Eigen::Vector3d d =
          camera.rotation.transpose() * (rotation * problem.targets[static_cast<std::size_t>(i)] +
                                         problem.truth.translation - camera.centre);
      const Eigen::Vector3d f = d.normalized();
      const Eigen::Matrix<double, 3, 2> basis = tangent_basis(f);
      const Eigen::Vector3d noisy =
          (f + basis * Eigen::Vector2d(gauss(random), gauss(random)) * sigma).normalized();
      observations.push_back({k, i, noisy});
    }
  }

  problem.is_outlier.assign(observations.size(), 0);
  const auto outliers = std::lround(options.outlier_fraction * static_cast<double>(observations.size()));
  if (outliers > 1) {
    std::vector<std::size_t> order(observations.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t k = 0; k < static_cast<std::size_t>(outliers); ++k) {
      Observation& seen = observations[order[k]];
      int other = seen.target;
      while (other == seen.target) other = static_cast<int>(random() % problem.targets.size());
      seen.target = other;
      problem.is_outlier[order[k]] = 1;
    }
  }

  const Eigen::Vector3d turn =
      Eigen::Vector3d(gauss(random), gauss(random), gauss(random)) * options.prior_rotation_deg * kDegree;
  problem.prior.rotation = Eigen::Quaterniond(exp_so3(turn / std::sqrt(3.0)) * rotation);
  problem.prior.translation =
      problem.truth.translation +
      Eigen::Vector3d(gauss(random), gauss(random), gauss(random)) * options.prior_position / std::sqrt(3.0);

  problem.bound = cramer_rao_bound(observations, cameras, problem, sigma);
  for (const Observation& seen : observations) {
    const Camera& camera = cameras[static_cast<std::size_t>(seen.camera)];
    problem.sights.push_back(isotropic_sight(camera.centre, camera.rotation * seen.bearing, sigma,
                                             problem.targets[static_cast<std::size_t>(seen.target)]));
    problem.camera.push_back(static_cast<std::uint8_t>(seen.camera));
    problem.entry.push_back(static_cast<std::uint16_t>(seen.target));
  }
  for (const Camera& camera : cameras) problem.axes.emplace_back(camera.rotation.col(2));
  return problem;
}

}  // namespace omma
