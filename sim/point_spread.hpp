// Point spread: the picture that a point source leaves, a Gaussian integrated over square pixels, with its
// derivatives by the position of the source. Formula in docs/algorithms/simulation.md#point-spread.
#pragma once

#include <cstddef>
#include <vector>

namespace omma::sim {

/// A point of light on the sensor; extended sources are many of these.
struct PointSource {
  float u = 0;     ///< [px], pixel centres at integers
  float v = 0;     ///< [px]
  float flux = 0;  ///< electrons of the whole spot
};

/// Part of an image: pixels [u0, u0 + width) × [v0, v0 + height), rows one after another.
struct Patch {
  int u0 = 0;
  int v0 = 0;
  int width = 0;
  int height = 0;
  std::vector<float> value;  ///< electrons
  std::vector<float> by_u;   ///< ∂value/∂u of a shift of all sources together [electrons/px]
  std::vector<float> by_v;
};

class PointSpread {
 public:
  /// @param sigma  standard deviation of the spot before integration over the pixel [px], 0.2 to 5
  /// @param side   of the square in the middle of a pixel that sees light [px], 0.1 to 1
  explicit PointSpread(double sigma, double side = 1);

  double sigma() const { return sigma_; }
  /// The spot reaches this many pixels from the pixel that holds its centre; beyond lie 6e-7 of its light.
  int radius() const { return radius_; }

  /// Adds the source's electrons to the image; what falls outside is lost.
  void add(const PointSource& source, int width, int height, float* image) const;
  /// Adds the source's electrons and their derivatives to the patch.
  void add(const PointSource& source, Patch& patch) const;

 private:
  struct Profile {  // one axis: share of the light of each pixel, from the first one, and its derivative
    int first;
    const float* share_below;
    const float* share_above;
    const float* slope_below;
    const float* slope_above;
    float fraction;
  };
  Profile profile(float position) const;

  double sigma_;
  int radius_;
  int side_;
  std::vector<float> share_;  // [sub-pixel node][pixel]
  std::vector<float> slope_;
};

}  // namespace omma::sim
