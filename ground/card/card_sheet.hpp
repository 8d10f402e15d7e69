// A sheet with a target card to print at its true size: SVG, PDF or PNG, by the file's ending.
#pragma once

#include <string>

#include "components/catalogue/target.hpp"

namespace omma::ground {

struct CardSheet {
  double disc_mm = 12;       ///< diameter of the discs
  double margin_mm = 12;     ///< plate beyond the outermost discs
  double page_width_mm = 0;  ///< 0: the plate with room for the notes below it
  double page_height_mm = 0;
  double dots_per_inch = 300;  ///< of a PNG
  bool labels = false;         ///< each target's name beside it, small and grey
};

/// The plate is drawn from the front: x to the right, y up, seen from +z. Dark discs on white, or, where most
/// targets are of type 1, white discs on black. Targets off the plate's plane are ringed and say by how much
/// they are to be raised. Below the plate: a bar of 50 mm to check the print with, and the name.
/// @throws InputError where the ending is none of .svg, .pdf, .png, the card does not fit the page, discs
/// touch, or
///         the file cannot be written
void write_card_sheet(const std::string& path, const TargetBody& body, const std::string& name,
                      const CardSheet& sheet);

}  // namespace omma::ground
