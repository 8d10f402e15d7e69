// Unlabelled clouds of dots with known truth: a body of targets seen by one or two fisheye cameras (180° over
// 768 px, 0.1 px noise: the dissertation's lens) among clutter, with part of the targets hidden.
#pragma once

#include <cstdint>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig_dot.hpp"

namespace omma {

struct CardProblemOptions {
  int targets = 12;
  int cameras = 1;               ///< 2: the second 0.2 m beside the first, turned by 40°
  bool solid = false;            ///< targets in a box as deep as the card is wide, not on a card
  bool faces = false;            ///< a box of six faces, `targets` LEDs on each, hidden from behind
  double hidden = 0;             ///< part of the targets not seen
  double clutter = 0;            ///< part of the dots seen that are no targets
  bool clutter_on_card = false;  ///< false: over the whole image; true: in the card's own surroundings
  double range = 49 * 0.0254;    ///< [m]
  double largest_tilt_deg = 40;
  double largest_off_axis_deg = 70;
  double noise_px = 0.1;
  bool body_present = true;  ///< false: clutter only, as many dots as there would have been
};

struct CardProblem {
  TargetBody body;
  std::vector<RigDot> dots;
  std::vector<int> target_of_dot;  ///< −1: clutter
  Pose truth;                      ///< rig_from_body
};

CardProblem make_card_problem(const CardProblemOptions& options, std::uint64_t seed);

}  // namespace omma
