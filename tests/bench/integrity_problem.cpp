#include "tests/bench/integrity_problem.hpp"

#include <cmath>
#include <numbers>

#include "sim/mistaken_calibration.hpp"
#include "tests/bench/attitude_problem.hpp"

namespace omma {
namespace {

void put_ray(Sight& sight, const Eigen::Vector3d& ray, double sigma) {
  sight = isotropic_sight(sight.origin, ray.normalized(), sigma, sight.point);
}

}  // namespace

IntegrityProblem star_integrity_problem(int stars, double sigma, std::mt19937_64& random) {
  const AttitudeProblem drawn = direction_problem({.directions = stars, .sigma = sigma}, random);
  IntegrityProblem problem;
  problem.axes.fill(Eigen::Vector3d::UnitZ());
  const double off_axis = std::acos(1.0 / 3);
  for (int c = 0; c < 3; ++c) {
    const double azimuth = 2 * std::numbers::pi * c / 3;
    problem.axes[static_cast<std::size_t>(c)] = {std::sin(off_axis) * std::cos(azimuth),
                                                 std::sin(off_axis) * std::sin(azimuth), std::cos(off_axis)};
  }
  problem.sights = drawn.sights;
  problem.sigma = sigma;
  problem.truth.rotation = drawn.truth;
  problem.prior.rotation = rotation_exp(0.001 * normal_vector(random)) * drawn.truth;
  for (const Sight& sight : problem.sights) {
    SightSource source;
    for (std::uint8_t c = 1; c < 3; ++c)
      if (problem.axes[c].dot(sight.ray) > problem.axes[source.camera].dot(sight.ray)) source.camera = c;
    source.entry = static_cast<std::uint16_t>(problem.sources.size());
    problem.sources.push_back(source);
  }
  return problem;
}

IntegrityProblem card_integrity_problem(const RigProblemOptions& options, std::uint64_t seed) {
  const RigProblem drawn = make_rig_problem(options, seed);
  IntegrityProblem problem;
  problem.axes.fill(Eigen::Vector3d::UnitZ());
  for (std::size_t c = 0; c < drawn.axes.size(); ++c) problem.axes[c] = drawn.axes[c];
  problem.sights = drawn.sights;
  problem.sigma = options.sigma_deg * std::numbers::pi / 180;
  problem.truth = drawn.truth;
  problem.prior = drawn.prior;
  for (std::size_t i = 0; i < drawn.sights.size(); ++i)
    problem.sources.push_back({drawn.camera[i], drawn.entry[i]});
  return problem;
}

void spoil_calibration(IntegrityProblem& problem, const CalibrationError& sigma, std::mt19937_64& random) {
  const MistakenCalibration mistakes = draw_mistakes(sigma, random);
  for (std::size_t i = 0; i < problem.sights.size(); ++i) {
    Sight& sight = problem.sights[i];
    const SightSource& source = problem.sources[i];
    const CameraMistake& camera = mistakes.cameras[source.camera];
    sight.origin -= camera.position;
    put_ray(sight, believed_ray(camera, problem.axes[source.camera], sight.ray), problem.sigma);
    const bool is_target = source.entry < mistakes.targets.size();
    if (sigma.survey > 0 && is_target) sight.point -= mistakes.targets[source.entry];
    sight.point /= mistakes.body_scale;
  }
}

void put_wrong_dot(IntegrityProblem& problem, double sigmas, std::mt19937_64& random) {
  Sight& sight = problem.sights[random() % problem.sights.size()];
  const Eigen::Vector3d along = (tangent_basis(sight.ray) * normal_vector(random).head<2>()).normalized();
  put_ray(sight, sight.ray + sigmas * problem.sigma * along, problem.sigma);
}

void turn_one_camera(IntegrityProblem& problem, double angle, std::mt19937_64& random) {
  const std::uint8_t camera = problem.sources[random() % problem.sources.size()].camera;
  const Eigen::Quaterniond turn = rotation_exp(angle * normal_vector(random).normalized());
  for (std::size_t i = 0; i < problem.sights.size(); ++i)
    if (problem.sources[i].camera == camera)
      put_ray(problem.sights[i], turn * problem.sights[i].ray, problem.sigma);
}

}  // namespace omma
