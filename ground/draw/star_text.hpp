// A star's name as people write it: "Sirius", "ζ Pup", "61 Vir", "HR 1234".
#pragma once

#include <cstdint>
#include <string>

namespace omma::ground {

/// The catalogue's label with Bayer's letter in Greek. @param hr  number in the Bright Star Catalogue
std::string star_text(std::uint16_t hr);

}  // namespace omma::ground
