#include "tests/bench/flown_approach.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace omma {
namespace {

/// @return squared error of the bearing, in its covariance
double add(OfOneMode& mode, const ApproachEstimate& estimate, const Eigen::Vector3d& truth) {
  ++mode.frame_sets;
  const double range = truth.norm();
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(truth / range);
  const Eigen::Vector2d error = basis.transpose() * (estimate.direction - truth / range);
  const Eigen::Matrix2d covariance = basis.transpose() * estimate.covariance * basis;
  const double bearing = error.dot(covariance.inverse() * error);
  mode.bearing_nees += bearing;
  if (!estimate.range_valid) return bearing;
  const double range_error = estimate.range - range;
  mode.range_nees += range_error * range_error / (estimate.range_sigma * estimate.range_sigma);
  mode.worst_range = std::max(mode.worst_range, std::abs(range_error) / range);
  return bearing;
}

}  // namespace

FlownApproach fly_approach(const sim::Scenario& scenario, const Mission& mission) {
  std::vector<ApproachEstimate> results;
  results.reserve(static_cast<std::size_t>(scenario.frames));
  FlownApproach flown;
  flown.allocations = fly_scenario(scenario, mission, [&](const Topology& topology) {
    results.push_back(topology.approach.estimates->bodies[0]);
  });
  RangeMode before = RangeMode::kNone;
  for (std::size_t f = 0; f < results.size(); ++f) {
    const ApproachEstimate& estimate = results[f];
    flown.steps_back += estimate.mode < before ? 1 : 0;
    before = estimate.mode;
    if (estimate.mode == RangeMode::kNone) continue;
    const Eigen::Vector3d truth = sim::scene_at(scenario, scenario.time_of(f)).rig_from_body[0].translation;
    const double bearing = add(flown.modes[estimate.mode], estimate, truth);
    const double off = std::acos(std::min(1.0, estimate.direction.dot(truth.normalized())));
    const bool wrong = bearing > 100 && off > 0.5 * M_PI / 180;
    flown.wrong += wrong ? 1 : 0;
    if (wrong) flown.right_range = 0;
    if (!wrong && flown.right_range == 0) flown.right_range = truth.norm();
    if (flown.first_range == 0) flown.first_range = truth.norm();
    if (estimate.mode == RangeMode::kIntermediate && flown.intermediate_from == 0)
      flown.intermediate_from = truth.norm();
    if (estimate.mode == RangeMode::kClose && flown.close_from == 0) flown.close_from = truth.norm();
  }
  flown.last_magnitude_sigma = results.back().magnitude_sigma;
  return flown;
}

}  // namespace omma
