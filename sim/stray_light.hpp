// Light of the Sun that the lens scatters or reflects on its way: a veil over the whole image, brightest
// towards the Sun and there too when the Sun only strikes the glass from outside the field, and ghosts.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/camera_view.hpp"

namespace omma::sim {

/// Adds `veil` of the light that falls on the lens, flux · cos θ, spread over the image's pixels as
/// 1 / (1 + α²/w²)^{3/2} of the angle α from the Sun (the shape of the halo of a bright body, with an angle
/// for its core). Nothing where the Sun is farther off axis than `veil_reach`.
/// @param sun   direction in the camera's frame, unit
/// @param flux  electrons of one exposure that the Sun would leave on the optical axis
void add_veil(const CameraView& camera, const Eigen::Vector3d& sun, double flux,
              std::vector<float>& electrons);

/// Adds the ghosts of a Sun in the field: even discs on the line from its image through the middle.
/// @param image  of the Sun [px]
void add_ghosts(const CameraView& camera, const Eigen::Vector2d& image, double flux,
                std::vector<float>& electrons);

}  // namespace omma::sim
