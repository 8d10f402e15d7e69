// Grey scale: how the grey levels of a picture stand for light, there and back. In flight the levels are made
// of light, on the ground light of the levels.
#pragma once

#include <cstdint>

#include "components/imaging/image_chunk.hpp"

namespace omma {

struct GreyScale {
  ImageScale scale = ImageScale::kSquareRoot;
  int bits = 8;     ///< of a level, 2 to 16
  double most = 1;  ///< light of the largest level
  /// kSquareRoot: light below 0 that is still shown; kAsinh: where it turns from linear to logarithmic, and
  /// the same. Source of the latter: R. H. Lupton, J. E. Gunn, A. S. Szalay, "A Modified Magnitude System
  /// that Produces Well-Behaved Magnitudes, Colors, and Errors Even for Low Signal-to-Noise Ratio
  /// Measurements", Astronomical J. 118 (1999).
  double soft = 0;

  int largest() const noexcept { return (1 << bits) - 1; }
  /// 0 for NaN (not seen), else 1 … largest; kLinear: 0 … largest.
  std::uint16_t level(double light) const noexcept;
  /// NaN for level 0, except of kLinear.
  double light(int level) const noexcept;
};

}  // namespace omma
