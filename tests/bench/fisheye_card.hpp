// The dissertation's docking geometry with known truth: a card of 10 × 8 in with 5 × 5 targets, 49 in away,
// before one or two cameras with a 180° equidistant lens over 768 px, 0.1 px noise in the image. The bound of
// pose_crlb.py, number for number.
#pragma once

#include <cstdint>
#include <vector>

#include "components/estimation/sight.hpp"
#include "components/geometry/pose.hpp"

namespace omma {

struct FisheyeCardOptions {
  double off_axis_deg = 0;  ///< one camera: from its axis to the card
  double tilt_deg = 0;      ///< of the card away from facing the rig
  /// 0: one camera. Otherwise two on faces of a tetrahedron, this far apart [m], the card on their bisector.
  double baseline = 0;
  double noise_px = 0.1;
};

struct FisheyeCard {
  std::vector<Sight> sights;
  Pose truth;      ///< rig_from_body
  Matrix6d bound;  ///< Cramér–Rao bound of (δθ, δt), rig frame
  double range = 49 * 0.0254;
};

/// The geometry is fixed; the seed draws the noise.
FisheyeCard make_fisheye_card(const FisheyeCardOptions& options, std::uint64_t seed);

}  // namespace omma
