// Skies of dots with known truth, for tests and benches: the real catalogue seen by a rig at a random
// attitude, with noise in pixels, false dots, brightness that is only roughly right.
#pragma once

#include <random>
#include <vector>

#include "components/catalogue/star_catalogue.hpp"
#include "components/geometry/rig.hpp"
#include "components/geometry/rig_dot.hpp"
#include "components/tracker/star_identification.hpp"

namespace omma {

struct SkyProblemOptions {
  float magnitude_limit = 4.25F;
  double noise_px = 0.1;     ///< standard deviation, each axis; the dots say so too
  double lens_error_px = 0;  ///< largest radial error of the calibration, at the edge; not told to the dots
  double magnitude_scatter = 0.3;  ///< of the measured brightness
  double false_fraction = 0;       ///< of all dots
  int false_on_sphere = 0;         ///< false dots over the whole sphere; those a camera sees are there
  int false_dots = 0;              ///< in each camera, as bright as random stars
  int bright_false = 0;            ///< false dots in each camera, brighter than any star (planets, lamps)
  int stars_per_camera = 0;        ///< brightest only; 0: all
  double missing_fraction = 0;     ///< stars that were not found
};

struct SkyProblem {
  Eigen::Quaterniond truth;  ///< rig_from_j2000
  std::vector<RigDot> dots;
  std::vector<std::uint16_t> hr;  ///< of each dot; 0: false
};

/// 1024×768 cameras, equidistant, `horizontal_deg` across, looking at the faces of a tetrahedron.
Rig equidistant_rig(int cameras, double horizontal_deg);
/// One distortion-free pinhole camera of 1024×768.
Rig pinhole_rig(double horizontal_deg);

/// @param stars  what there is to see, brightest first
SkyProblem random_sky(const Rig& rig, std::span<const SkyStar> stars, const SkyProblemOptions& options,
                      std::mt19937_64& random);

enum class SkyVerdict { kRight, kWrong, kUnsolved };
/// Wrong: an attitude more than a tenth of a degree from the truth (5 pixels of a narrow field are less), or
/// more than one match in ten with another star than the true one.
SkyVerdict judge(const SkyProblem& problem, const Identification& answer);

}  // namespace omma
