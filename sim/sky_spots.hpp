// The sky in one camera: stars, Sun, Moon and planets as points of light, and lamps on the ground.
#pragma once

#include <span>
#include <vector>

#include "components/catalogue/star.hpp"
#include "sim/camera_view.hpp"
#include "sim/card_view.hpp"
#include "sim/disc_quadrature.hpp"
#include "sim/earth_view.hpp"
#include "sim/scenario.hpp"
#include "sim/spot.hpp"

namespace omma::sim {

/// One camera's turn at one instant.
struct CameraTurn {
  Eigen::Matrix3d camera_from_j2000 = Eigen::Matrix3d::Identity();
  Eigen::Vector3d up = Eigen::Vector3d::Zero();     ///< zenith, camera frame, on the ground
  Eigen::Vector3d north = Eigen::Vector3d::Zero();  ///< likewise, where the site is told
};

/// The sky about one camera at the exposure midpoint, and its turns at the instants that are drawn.
struct SkyView {
  CameraTurn midpoint;
  std::vector<CameraTurn> drawn;                              ///< of equal weight
  const Ground* ground = nullptr;                             ///< nullptr: none
  const EarthView* earth = nullptr;                           ///< nullptr: none, or not from orbit
  Eigen::Vector3d velocity_over_c = Eigen::Vector3d::Zero();  ///< of the observer about the Earth, J2000 axes

  /// Where a direction of J2000 (unit) is seen, camera frame.
  Eigen::Vector3d seen(const CameraTurn& turn, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d ray = turn.camera_from_j2000 * direction;
    return ground != nullptr ? ground->apparent(ray, turn.up) : ray;
  }
  /// Share of the light that comes from a direction of the camera's frame, at the midpoint.
  double transmission(const Eigen::Vector3d& direction) const {
    double share = ground != nullptr ? ground->transmission(midpoint.up.dot(direction)) : 1.0;
    if (earth != nullptr) share *= earth->transmission(direction);
    return share;
  }
};

/// Appends the stars that neither a card nor the ground or the Earth hides and that are not behind the Moon.
/// @param factors  of the stars' light, as many as stars: what the sensor makes of their colours; empty: one
void add_stars(const CameraView& camera, const SkyView& view, std::span<const SkyStar> stars,
               std::span<const float> factors, const std::optional<Disc>& moon,
               std::span<const CardView> cards, SpotList& list);

/// Appends the disc of a body of the solar system, unless a card, the ground or the Earth hides its centre. A
/// disc with a side to the Sun is a sphere that it lights (Lambert's law), its magnitude that of the lit
/// part.
/// @param spot    its kind; the rest is filled in
/// @param factor  of its light: what the sensor makes of its colour
void add_disc(const CameraView& camera, const SkyView& view, Spot spot, const Disc& disc, double factor,
              std::span<const CardView> cards, const DiscQuadrature& quadrature, SpotList& list);

/// Appends the ground's lamps: points of light that are no spots.
void add_lamps(const CameraView& camera, const SkyView& view, std::span<const CardView> cards,
               SpotList& list);

/// Adds the light that the lens scatters about a bright spot: share `glare` of its flux, falling as
/// r₀ / (2π (r² + r₀²)^{3/2}), which integrates to one over the plane; outside the field nothing is added.
void add_glare(const CameraView& camera, const Spot& spot, const SpotList& list,
               std::vector<float>& electrons);

}  // namespace omma::sim
