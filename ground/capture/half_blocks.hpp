// A grey image as text for a terminal: two pixels a character, upper and lower half of a block.
#pragma once

#include <string>

#include "hal/image.hpp"

namespace omma::ground {

/// The image shrunk to fit (the brightest pixel of each cell, so that stars stay), stretched between its 1 %
/// and 99.9 % levels.
/// @param columns, rows  of the terminal; the picture keeps its proportions
std::string half_blocks(const ImageView& image, int columns, int rows);

}  // namespace omma::ground
