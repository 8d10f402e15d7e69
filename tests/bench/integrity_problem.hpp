// Attitude and pose problems whose cameras, lenses and targets are not where they are believed to be, with
// wrong dots and displaced cameras on demand: what integrity (components/estimation/integrity.hpp) is held
// to.
#pragma once

#include <random>
#include <vector>

#include "components/estimation/integrity.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {

struct IntegrityProblem {
  std::vector<Sight> sights;
  std::vector<SightSource> sources;
  CameraAxes axes;
  double sigma = 0;  ///< of a bearing, each axis [rad]
  Pose truth;        ///< rig_from_body; stars: rig_from_j2000
  Pose prior;
};

/// Stars strewn over the whole sky, each in the nearest of three cameras on a tetrahedron's faces.
IntegrityProblem star_integrity_problem(int stars, double sigma, std::mt19937_64& random);

/// A card before a rig, as in rig_problem.hpp.
IntegrityProblem card_integrity_problem(const RigProblemOptions& options, std::uint64_t seed);

/// Draws the errors of every camera, lens and target and puts the sights where these make the rig believe
/// they are. The truth stays the truth.
void spoil_calibration(IntegrityProblem& problem, const CalibrationError& sigma, std::mt19937_64& random);

/// Moves one dot by `sigmas` of its own, in a random direction.
void put_wrong_dot(IntegrityProblem& problem, double sigmas, std::mt19937_64& random);

/// Turns all rays of one camera that took part by `angle` [rad] about a random axis.
void turn_one_camera(IntegrityProblem& problem, double angle, std::mt19937_64& random);

}  // namespace omma
