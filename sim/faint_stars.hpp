// Stars to V 7 that the Bright Star Catalogue leaves out (it is complete to V 6.5): the simulator draws them,
// the flight program does not know them. The table is made by ground/catalogue/generate_faint_stars.py.
#pragma once

#include <cstdint>
#include <span>

#include "components/catalogue/star.hpp"

namespace omma::sim {

/// Numbers of these stars begin here, where a star of the Bright Star Catalogue has its HR number.
inline constexpr std::uint16_t kFirstFaintStar = 10001;

/// Brightest first; `hr` counts from kFirstFaintStar.
std::span<const CatalogueStar> faint_stars();

/// B − V of such a star.
double faint_star_colour(std::uint16_t number);

}  // namespace omma::sim
