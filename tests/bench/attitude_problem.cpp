#include "tests/bench/attitude_problem.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "components/geometry/pose.hpp"
#include "tests/random_direction.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Eigen::Quaterniond random_turn(Turn turn, std::mt19937_64& random) {
  const Eigen::Vector3d axis = random_direction(random);
  std::uniform_real_distribution<double> angle(0, std::numbers::pi);
  const Eigen::Index which = static_cast<Eigen::Index>(random() % 3);
  switch (turn) {
    case Turn::kHalfAboutAnAxis: {
      Eigen::Quaterniond q(0, 0, 0, 0);
      q.coeffs()(which) = 1;
      return q;
    }
    case Turn::kHalf:
      return Eigen::Quaterniond(0, axis.x(), axis.y(), axis.z());
    case Turn::kNone:
      return Eigen::Quaterniond::Identity();
    case Turn::kRandom:
      break;
  }
  return rotation_exp(axis * angle(random));
}

/// Σ Jᵀ J with J = whitener · [−u]× at the true directions.
Eigen::Matrix3d bound_of(const std::vector<Sight>& sights, const Eigen::Quaterniond& truth) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const Sight& sight : sights) {
    const Eigen::Matrix<double, 2, 3> jacobian = sight.whitener * skew(truth * sight.point);
    information += jacobian.transpose() * jacobian;
  }
  return information.inverse();
}

}  // namespace

AttitudeProblem direction_problem(const DirectionProblemOptions& options, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> turn(0, std::numbers::pi);
  AttitudeProblem problem;
  problem.truth = random_turn(options.turn, random);
  const Eigen::Vector3d axis = random_direction(random);
  while (static_cast<int>(problem.sights.size()) < options.directions) {
    Eigen::Vector3d direction = random_direction(random);
    if (options.on_one_line) direction = problem.sights.size() % 2 == 0 ? axis : Eigen::Vector3d(-axis);
    if (!options.on_one_line && direction.dot(axis) < std::cos(options.cone_deg * kDegree)) continue;
    const bool coarse = static_cast<int>(problem.sights.size()) >= options.directions - options.coarse;
    const double sigma = coarse ? options.coarse_sigma : options.sigma;
    const Eigen::Vector2d sigmas(sigma, sigma * options.elongation);
    const Eigen::Matrix<double, 3, 2> basis =
        tangent_basis(direction) * Eigen::Rotation2Dd(turn(random)).toRotationMatrix();
    const double a = gauss(random), b = gauss(random);
    Sight sight;
    sight.ray = (direction + basis * Eigen::Vector2d(sigmas.x() * a, sigmas.y() * b)).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - sight.ray * sight.ray.transpose();
    sight.whitener = sigmas.cwiseInverse().asDiagonal() * basis.transpose() * across;
    sight.point = problem.truth.conjugate() * direction;
    problem.sights.push_back(sight);
    problem.sigma.push_back(std::sqrt(0.5 * sigmas.squaredNorm()));
  }
  problem.bound = bound_of(problem.sights, problem.truth);
  return problem;
}

AttitudeProblem star_problem(const Rig& rig, std::span<const SkyStar> stars, const SkyProblemOptions& options,
                             double least_off_axis_deg, std::mt19937_64& random) {
  const SkyProblem sky = random_sky(rig, stars, options, random);
  AttitudeProblem problem;
  problem.truth = sky.truth;
  for (std::size_t d = 0; d < sky.dots.size(); ++d) {
    const RigDot& dot = sky.dots[d];
    const Eigen::Vector3d axis = rig.cameras[dot.camera].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
    if (dot.ray.dot(axis) > std::cos(least_off_axis_deg * kDegree)) continue;
    for (const SkyStar& star : stars) {
      if (star.hr != sky.hr[d]) continue;
      problem.sights.push_back({dot.origin, dot.ray, dot.whitener, star.direction});
      problem.sigma.push_back(dot.sigma);
      break;
    }
  }
  problem.bound = bound_of(problem.sights, problem.truth);
  return problem;
}

}  // namespace omma
