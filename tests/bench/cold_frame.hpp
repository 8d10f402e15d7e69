// One frame set of a rig at a random attitude with the docking card somewhere in its first camera's field:
// dot lists as the extractor gives them, with the truth. Stars, targets and false dots are not told apart.
#pragma once

#include <cstdint>
#include <span>

#include "components/catalogue/star.hpp"
#include "components/catalogue/target.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "tests/bench/sky_problem.hpp"

namespace omma {

struct ColdFrameOptions {
  bool card = true;
  float magnitude_limit = 4.25F;
  double noise_px = 0.1;
  double false_fraction = 0;         ///< of all dots, as bright as stars are
  bool bright_false = false;         ///< every magnitude as likely: most of them outshine most stars
  double range = 49 * 0.0254;        ///< of the card [m]
  double largest_off_axis_deg = 35;  ///< of the card, from the first camera's axis
  double largest_tilt_deg = 40;
};

struct ColdFrame {
  Eigen::Quaterniond rig_from_j2000;
  Pose rig_from_body;
};

ColdFrame make_cold_frame(const Rig& rig, std::span<const SkyStar> stars, const TargetBody& body,
                          const ColdFrameOptions& options, std::uint64_t seed, DotLists& lists);

}  // namespace omma
