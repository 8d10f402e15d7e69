// The sky in one camera: stars, Moon and Sun as points of light.
#pragma once

#include <span>
#include <vector>

#include "components/catalogue/star.hpp"
#include "sim/camera_view.hpp"
#include "sim/card_view.hpp"
#include "sim/disc_quadrature.hpp"
#include "sim/scenario.hpp"
#include "sim/spot.hpp"

namespace omma::sim {

/// One camera's turn to the sky at the exposure midpoint and at the instants that are drawn.
struct SkyView {
  Eigen::Matrix3d camera_from_j2000;   ///< at the midpoint
  std::vector<Eigen::Matrix3d> drawn;  ///< camera_from_j2000 at each drawn instant, of equal weight
  std::optional<Ground> ground;        ///< its `up` in the camera's frame

  /// Share of the light that comes from a direction of the camera's frame.
  double transmission(const Eigen::Vector3d& direction) const {
    return ground ? ground->transmission(ground->up.dot(direction)) : 1.0;
  }
};

/// Appends the stars that neither a card nor the ground hides and that are not behind the Moon.
void add_stars(const CameraView& camera, const SkyView& view, std::span<const SkyStar> stars,
               const std::optional<Disc>& moon, std::span<const CardView> cards, SpotList& list);

/// Appends the disc of Moon or Sun, unless a card or the ground hides its centre.
/// @param lit_by  direction of the Sun, J2000 axes: the disc is a sphere that it lights (Lambert's law), its
///                magnitude that of the lit part; nullptr: an even disc
void add_disc(const CameraView& camera, const SkyView& view, SpotKind kind, const Disc& disc,
              const Eigen::Vector3d* lit_by, std::span<const CardView> cards,
              const DiscQuadrature& quadrature, SpotList& list);

/// Adds the light that the lens scatters about a bright spot: share `glare` of its flux, falling as
/// r₀ / (2π (r² + r₀²)^{3/2}), which integrates to one over the plane; outside the field nothing is added.
void add_glare(const CameraView& camera, const Spot& spot, const SpotList& list,
               std::vector<float>& electrons);

}  // namespace omma::sim
