// Attitude problems with known truth, in the form every method takes: directions seen and known, each with
// its full covariance (the sight's whitener) and, for methods that weigh by one number, its mean σ.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "components/catalogue/star_catalogue.hpp"
#include "components/estimation/sight.hpp"
#include "components/geometry/rig.hpp"
#include "tests/bench/sky_problem.hpp"

namespace omma {

struct AttitudeProblem {
  std::vector<Sight> sights;
  std::vector<double> sigma;  ///< of each bearing, mean of both axes [rad]
  Eigen::Quaterniond truth;   ///< rig_from_j2000
  Eigen::Matrix3d bound;      ///< Cramér–Rao bound of δθ, rig frame [rad²]
};

enum class Turn { kRandom, kHalfAboutAnAxis, kHalf, kNone };

struct DirectionProblemOptions {
  int directions = 30;
  double cone_deg = 180;  ///< largest angle from a common axis
  double sigma = 2e-4;    ///< of each bearing and axis [rad]
  int coarse = 0;         ///< so many of the directions are only known to
  double coarse_sigma = 0.02;
  double elongation = 1;  ///< σ of one axis of every bearing, across it at random, over that of the other
  Turn turn = Turn::kRandom;
  bool on_one_line = false;  ///< all along one direction or its opposite
};

AttitudeProblem direction_problem(const DirectionProblemOptions& options, std::mt19937_64& random);

/// Real stars through real lenses. Stars nearer to their camera's axis than `least_off_axis_deg` are left
/// out.
AttitudeProblem star_problem(const Rig& rig, std::span<const SkyStar> stars, const SkyProblemOptions& options,
                             double least_off_axis_deg, std::mt19937_64& random);

}  // namespace omma
