// A picture of a target card, scanned or drawn, seen straight from the front: its discs as a target database.
#pragma once

#include <string>

#include "components/catalogue/target.hpp"
#include "hal/image.hpp"

namespace omma::ground {

struct CardReading {
  TargetBody body;      ///< ids T01, T02, … row by row from the top left; origin at the middle of the discs
  double disc_mm = 0;   ///< median diameter
  int passed_over = 0;  ///< blobs that are no discs like the others: writing, bars
};

/// @param millimetres_per_pixel  of the picture
/// @throws InputError (naming `file`) where fewer than four discs are found or more than
/// limits::kTargetsPerBody
CardReading read_card(const ImageView& image, double millimetres_per_pixel, const std::string& file);

/// The database as a file: id x y z group type, tabs between [m].
std::string target_file_text(const TargetBody& body);

}  // namespace omma::ground
