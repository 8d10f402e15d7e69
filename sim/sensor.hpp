// Sensor: from the mean number of electrons in each pixel to the grey levels read out. Linear response:
// photon noise, full well, read noise, gain, black level, quantisation. Sources: Janesick, Photon Transfer
// (SPIE 2007); EMVA Standard 1288.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sim/random.hpp"

namespace omma::sim {

/// One camera's sensor and exposure.
struct Sensor {
  int bits = 8;                  ///< of a grey level: 8 to 16
  double gain = 1;               ///< electrons per grey level
  double black_level = 0;        ///< grey level of no electrons
  double read_noise = 5;         ///< standard deviation [electrons]
  double dark_current = 0;       ///< [electrons/s] a pixel
  double full_well = 20000;      ///< [electrons]
  double exposure = 0.05;        ///< [s]
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
      10;                ///< the halo's core, from where it falls with the third power of the distance [px]
  int blur_samples = 1;  ///< instants of the exposure that are drawn; 1: no motion blur

  std::uint16_t white_level() const {
    return static_cast<std::uint16_t>((1U << static_cast<unsigned>(bits)) - 1U);
  }
  /// Electrons at which a pixel saturates: the well or the converter, whichever is first.
  double saturation() const;
  /// Variance of a pixel holding `mean` electrons, quantisation included [electrons²].
  double variance(double mean) const { return mean + read_noise * read_noise + gain * gain / 12.0; }
};

/// Charge above the full well runs along its column, half each way, into the nearest pixels with room.
/// @param electrons  width × height, row by row; changed in place; nothing above the full well is left
void bloom(const Sensor& sensor, int width, int height, std::span<float> electrons);

/// Reads out pixels [first, first + mean.size()) of an image: photon noise, read noise, gain, quantisation.
/// @param mean      expected electrons (photons and dark current)
/// @param sequence  the frame's random numbers, addressed by pixel number
/// @param grey      as many grey levels; Pixel is std::uint8_t (bits = 8) or std::uint16_t
template <class Pixel>
void read_out(const Sensor& sensor, std::span<const float> mean, const RandomSequence& sequence,
              std::uint64_t first, std::span<Pixel> grey);

}  // namespace omma::sim
