// What a sensor makes of a star's colour: its light through the sensor's spectral response, beside its light
// in V. A star is taken for a black body whose temperature follows from B − V (Ballesteros 2012, EPL 97,
// 34008, equation 14); V is Bessell's band (1990, PASP 102, 1181, table 2).
#pragma once

#include <cstdint>
#include <vector>

namespace omma::sim {

/// Share of the photons of a wavelength that are counted; straight lines between points, nothing outside.
struct ResponsePoint {
  double wavelength = 0;  ///< [nm], rising from point to point
  double efficiency = 0;  ///< any scale: it is the zero point's
};
using SpectralResponse = std::vector<ResponsePoint>;

/// B − V of a star by its HR number (0.6 where the Bright Star Catalogue tells none), or a number of
/// faint_stars.hpp.
double star_colour(std::uint16_t hr);

/// Temperature of a star [K].
double star_temperature(double colour);

/// What a sensor makes of each colour. With an empty response it makes nothing of them.
class ColourFactors {
 public:
  explicit ColourFactors(const SpectralResponse& response);
  /// Electrons over those of a star of the same V and B − V = 0; by B − V to its hundredth.
  double operator()(double colour) const;

 private:
  std::vector<float> factor_;
};

}  // namespace omma::sim
