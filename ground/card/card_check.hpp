// Is a card good? Motions that carry its pattern onto itself, so that it cannot be told from itself turned;
// and how often the flight program's identification knows it, as a camera would see it from all sides.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/geometry/lens.hpp"

namespace omma::ground {

/// A turn (and shift) of the card that puts many of its targets onto others.
struct Likeness {
  double angle = 0;         ///< of the turn [rad]
  std::size_t matched = 0;  ///< targets put onto a target within the tolerance
};

/// The turn other than none that puts most targets onto targets; turns of a flat card in its plane and over
/// its face (seen from behind, which a camera does not) are told apart: only the former count.
/// @param tolerance  [m]
Likeness nearest_likeness(const TargetBody& body, double tolerance);

struct CheckOptions {
  double dot_sigma = 0.1;     ///< of a dot, each axis [px]
  double hidden = 0.1;        ///< share of the targets hidden, chosen anew each time
  int trials = 200;           ///< at each range
  double largest_tilt = 1.0;  ///< of the card from facing the camera [rad]
};

struct RangeCheck {
  double range = 0;  ///< [m]
  int trials = 0;    ///< with at least four targets in the image
  int right = 0;
  int wrong = 0;              ///< a labelling given that is false in more than a tenth of its pairs
  int ambiguous = 0;          ///< refused because two labellings fit
  int mirrored = 0;           ///< right labels, but the flat card's two poses both fit
  double position_sigma = 0;  ///< median, as the solver tells it [m]
  double rotation_sigma = 0;  ///< [rad]
};

/// Trials without random state: the same card gives the same figures.
RangeCheck check_at(const TargetBody& body, const Lens& lens, double range, const CheckOptions& options);

}  // namespace omma::ground
