// Matching the exposure of cameras where they see the same sky, so that no seam shows.
// Source: gain compensation of M. Brown and D. G. Lowe, "Automatic Panoramic Image Stitching using Invariant
// Features", Int. J. of Computer Vision 74 (2007), section 6, equation 29.
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"

namespace omma {

/// How a camera's grey levels become light: gain · scale · (grey / white level − black).
struct CameraLevels {
  double black = 0;  ///< share of the white level
  double gain = 1;   ///< from match_exposure
  double scale = 1;  ///< what is known beforehand: electrons a share, exposure
  double noise = 0;  ///< of a pixel [share of the white level]
};

using RigLevels = std::array<CameraLevels, limits::kCameras>;

/// What was seen where two cameras overlap: for the pair (a, b), sums over the directions both see.
struct OverlapSums {
  struct Pair {
    std::uint32_t count = 0;
    double first = 0;   ///< of scale · (grey / white level − black) of the camera with the smaller index
    double second = 0;  ///< of the other one
  };
  std::array<std::array<Pair, limits::kCameras>, limits::kCameras> pairs{};  ///< [a][b] with a < b

  void add(int a, double value_a, int b, double value_b) noexcept {
    Pair& pair = pairs[a][b];
    ++pair.count;
    pair.first += value_a;
    pair.second += value_b;
  }
};

struct ExposureMatchSettings {
  /// How far two cameras may differ in the mean of an overlap [share of white]. The paper's 10/255 lets its
  /// prior win over all but bright scenes; a black level is known here, and a mean of many pixels is good to
  /// one level.
  double level_sigma = 1.0 / 255;
  double gain_sigma = 0.1;  ///< how far a gain is expected from 1
};

/// Gains that make the mean levels of all overlaps agree best, held near 1 where there is no light to tell.
/// @param cameras  of the rig; further gains are 1
std::array<double, limits::kCameras> match_exposure(const OverlapSums& sums, int cameras,
                                                    const ExposureMatchSettings& settings = {}) noexcept;

}  // namespace omma
