// SkyPull: how far the sky about a body draws its lights apart. A body that is darker than the sky, or
// brighter, leaves a step of the background beside lights near its rim; the place of a spot fitted on an even
// background is drawn towards the brighter side, outwards or inwards, and the body seems larger or smaller
// than it is. All lights alike: no number of them averages it out.
//
// A step b [levels] through the middle of a Gaussian spot of flux F and width s moves its least-squares place
// by 8π s³ b / (√(2π) F). Lights farther from the rim see less of it.
#pragma once

#include <span>

#include "components/extractor/dot_lists.hpp"
#include "components/tracker/pairings.hpp"
#include "config/limits.hpp"

namespace omma {

/// @param used         1 where the pairing is in the pose
/// @param black_level  of each camera, of no light [grey levels]; cameras with `gain` 0 are left out
/// @return σ of the body's size, relative: a half of what all of the sky's light hidden beside every light
/// does
double size_error_of_sky(std::span<const Pairing> pairs, std::span<const std::uint8_t> used,
                         const DotLists& dots, const std::array<double, limits::kCameras>& gain,
                         const std::array<double, limits::kCameras>& black_level) noexcept;

}  // namespace omma
