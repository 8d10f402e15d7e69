// What a star is called, for annotated pictures and reports: IAU proper names of the brighter stars (IAU
// Catalog of Star Names, 2018) and the Bayer or Flamsteed designation the Bright Star Catalogue prints.
#pragma once

#include <cstdint>
#include <string_view>

#include "fsw/kernel/fixed_string.hpp"

namespace omma {

/// "Sirius"; empty where the star has no proper name in the table.
std::string_view proper_name(std::uint16_t hr) noexcept;

/// "Alp CMa" (Bayer), else "33 Psc" (Flamsteed), else "HR 1234".
Name star_designation(std::uint16_t hr) noexcept;

/// The proper name where there is one, else the designation.
Name star_label(std::uint16_t hr) noexcept;

}  // namespace omma
