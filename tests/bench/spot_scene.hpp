// Synthetic images of Gaussian spots with known places and with the Fisher information of each: what tests
// and the bench of the extractor measure against. Source: Kay, Fundamentals of Statistical Signal Processing:
// Estimation Theory (1993), ch. 3.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "components/extractor/dot.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {

/// A spot as it is made: a Gaussian integrated over square pixels.
struct MadeSpot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma = 1;  ///< before integration over the pixel [px]
  double snr = 10;   ///< flux over its smallest possible deviation; 0: `flux` is given
  double flux = 0;   ///< [grey levels], set by render where snr is given
  Eigen::Vector2d trail = Eigen::Vector2d::Zero();        ///< from its beginning to its end [px]
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< of the centre [px⁻²], set by render
};

struct SpotScene {
  int width = 1024;
  int height = 768;
  int white_level = 255;  ///< above 255 the image has 16 bits
  double background = 20;
  double slope = 0;  ///< of the background along u [grey levels per pixel]
  double noise = 2;  ///< standard deviation of a pixel of the background [grey levels]
  double gain = 0;   ///< electrons per grey level; 0: the spots bring no noise of their own
  double fill_factor =
      1;  ///< part of a pixel's area that takes light, a square in its middle; light beside it is lost
  bool dark = false;  ///< the image is turned: dark spots on light ground
  std::vector<MadeSpot> spots;
};

/// Spots on a grid of this spacing, each at a random phase of the pixel.
std::vector<MadeSpot> grid_of_spots(const SpotScene& scene, double spacing, double sigma, double snr,
                                    std::mt19937_64& random);
/// So many spots at random places, none nearer than `spacing` to another.
std::vector<MadeSpot> scattered_spots(const SpotScene& scene, int count, double spacing, double sigma,
                                      double snr, std::mt19937_64& random);

/// Renders the scene with noise; fills in flux and information of its spots.
Image render(SpotScene& scene, std::mt19937_64& random);

/// What an extraction made of scenes: sums over all of them.
struct SpotScore {
  int spots = 0, found = 0, false_dots = 0;
  double squared_error = 0;  ///< of both coordinates [px²]
  double squared_bound = 0;
  double nees = 0;  ///< eᵀ C⁻¹ e, summed
  static constexpr int kPhases = 8;
  double phase_error[kPhases] = {};  ///< sum of the errors of both axes by the pixel phase of that axis
  int phase_count[kPhases] = {};

  void add(const SpotScene& scene, std::span<const Dot> dots);
  double rms() const { return found == 0 ? 0 : std::sqrt(squared_error / (2 * found)); }
  double ratio() const { return squared_bound == 0 ? 0 : std::sqrt(squared_error / squared_bound); }
  double mean_nees() const { return found == 0 ? 0 : nees / found; }
  double largest_phase_bias() const;  ///< [px]
};

}  // namespace omma
