// Sensor: from the mean number of electrons in each pixel to the grey levels read out. Linear response:
// photon noise, full well, read noise, gain, black level, quantisation. Sources: Janesick, Photon Transfer
// (SPIE 2007); EMVA Standard 1288. Logarithmic response: log_response.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/log_response.hpp"
#include "sim/random.hpp"
#include "sim/star_colour.hpp"

namespace omma::sim {

/// A reflection of the Sun between the lens's surfaces: a disc on the line from the Sun's image through the
/// middle of the lens.
struct Ghost {
  double place = -0.5;  ///< distance from the middle over that of the Sun's image; negative: opposite
  double radius = 10;   ///< [px]
  double share = 0;     ///< of the Sun's light
};

/// One camera's sensor and exposure.
struct Sensor {
  int bits = 8;                  ///< of a grey level: 8 to 16
  double gain = 1;               ///< electrons per grey level
  double black_level = 0;        ///< grey level of no electrons
  double read_noise = 5;         ///< standard deviation [electrons]
  double dark_current = 0;       ///< [electrons/s] a pixel
  double full_well = 20000;      ///< [electrons]
  double exposure = 0.05;        ///< [s]
  std::vector<double> bracket;   ///< exposures in turn, one a frame [s]; empty: always `exposure`
  double zero_point = 1e5;       ///< electrons per second from a star of V = 0 on the optical axis
  double sky = 0;                ///< diffuse light on the optical axis [electrons/s] a pixel
  double psf_sigma = 0.7;        ///< of a point's picture, before integration over the pixel [px]
  double vignetting = 0;         ///< share of the light lost at the edge of the field
  double field = 3.14;           ///< full field of view; outside it no light falls [rad]
  double hot_pixels = 0;         ///< share of the pixels with an excess dark current
  double hot_pixel_current = 0;  ///< mean of that excess, exponentially distributed [electrons/s]
  double blooming = 0;           ///< share of the charge over the full well that runs along the column
  double glare = 0;              ///< share of a bright body's light scattered in the lens
  double glare_radius =
      10;                  ///< the halo's core, from where it falls with the third power of the distance [px]
  int blur_samples = 1;    ///< instants of the exposure that are drawn; 1: no motion blur
  double fill_factor = 1;  ///< share of a pixel's area that sees light, a square in its middle
  double veil = 0;         ///< share of the Sun's light on the lens that it scatters over the whole image
  double veil_width = 0.4;  ///< angle from the Sun within which most of that falls [rad]
  double veil_reach = 1.6;  ///< the Sun farther off axis than this does not reach the glass [rad]
  std::vector<Ghost> ghosts;
  SpectralResponse response;               ///< empty: stars of one V are alike whatever their colour
  std::optional<LogResponse> logarithmic;  ///< gain, black level, read noise and full well are unused with it

  std::uint16_t white_level() const {
    return static_cast<std::uint16_t>((1U << static_cast<unsigned>(bits)) - 1U);
  }
  /// Only with a logarithmic response.
  LogPixel log_pixel() const { return {*logarithmic, dark_current * exposure, bits}; }
  /// Electrons at which a pixel saturates: the well or the converter, whichever is first.
  double saturation() const;
  /// Electrons below which a pixel reads black whatever it holds.
  double blackout() const { return logarithmic ? log_pixel().electrons(0) : -1; }
  /// Variance of a pixel holding `mean` electrons, quantisation included [electrons²].
  double variance(double mean) const;
  /// Grey levels per electron about `mean`.
  double slope(double mean) const { return logarithmic ? log_pixel().slope(mean) : 1 / gain; }
};

/// Charge above the full well runs along its column, half each way, into the nearest pixels with room.
/// @param electrons  width × height, row by row; changed in place; nothing above the full well is left
void bloom(const Sensor& sensor, int width, int height, std::span<float> electrons);

/// Reads out pixels [first, first + mean.size()) of an image: photon noise, read noise, gain, quantisation.
/// @param mean      expected electrons (photons and dark current)
/// @param offsets   of the pixels, as many [grey levels]; empty: none
/// @param sequence  the frame's random numbers, addressed by pixel number
/// @param grey      as many grey levels; Pixel is std::uint8_t (bits = 8) or std::uint16_t
template <class Pixel>
void read_out(const Sensor& sensor, std::span<const float> mean, std::span<const float> offsets,
              const RandomSequence& sequence, std::uint64_t first, std::span<Pixel> grey);

}  // namespace omma::sim
