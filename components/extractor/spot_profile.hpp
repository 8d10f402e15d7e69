// One axis of a Gaussian spot integrated over square pixels: the share of the light that each pixel of a row
// receives, with its derivatives. Own exponential in plain float arithmetic: every machine gets the same bits
// and the loops become vectors.
// Source: erf by Abramowitz & Stegun 1964, 7.1.26 (|error| < 1.5e-7); formulas in
// docs/algorithms/extractor.md#spot.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace omma {

inline constexpr int kSpotSide = 32;  ///< most pixels on a side of a window, padding included

/// e^x for x <= 0, relative error below 2e-7; 0 below -80.
inline float exp_of_negative(float x) {
  x = x < -80.0F ? -80.0F : x;
  const auto n = static_cast<std::int32_t>(x * 1.44269504F - 0.5F);
  const auto whole = static_cast<float>(n);
  const float r = (x - whole * 0.693359375F) + whole * 2.12194440e-4F;  // |r| <= ln 2 / 2
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  p = p * r * r + r + 1.0F;
  return p * std::bit_cast<float>((n + 127) << 23);
}

struct SpotProfile {
  alignas(32) std::array<float, kSpotSide> share;     ///< of the light in pixel i
  alignas(32) std::array<float, kSpotSide> by_place;  ///< ∂share/∂place [1/px]
  alignas(32) std::array<float, kSpotSide> by_sigma;  ///< ∂share/∂sigma [1/px]

  /// @param place   of the spot, pixel 0 of the row having its centre at 0 [px]
  /// @param sigma   standard deviation before integration over the pixel [px]
  /// @param pixels  how many are filled in, rounded up to a multiple of 8
  void fill(float place, float sigma, int pixels) {
    const float per_sigma = 1.0F / sigma;
    alignas(32) std::array<float, kSpotSide + 8> below;    // light below the pixel's lower edge
    alignas(32) std::array<float, kSpotSide + 8> density;  // φ(z)
    alignas(32) std::array<float, kSpotSide + 8> moment;   // z φ(z)
    const int padded = (pixels + 7) & ~7;
    for (int i = 0; i <= padded; ++i) {
      const float z = (static_cast<float>(i) - 0.5F - place) * per_sigma;
      const float bell = exp_of_negative(-0.5F * z * z);
      const float t = 1.0F / (1.0F + 0.23164190F * std::fabs(z));  // 0.3275911 / √2
      float tail = 1.061405429F;
      tail = tail * t - 1.453152027F;
      tail = tail * t + 1.421413741F;
      tail = tail * t - 0.284496736F;
      tail = 0.5F * (tail * t + 0.254829592F) * t * bell;
      below[static_cast<std::size_t>(i)] = z < 0 ? tail : 1.0F - tail;
      density[static_cast<std::size_t>(i)] = 0.398942280F * bell;
      moment[static_cast<std::size_t>(i)] = z * 0.398942280F * bell;
    }
    for (int k = 0; k < padded; ++k) {
      const auto i = static_cast<std::size_t>(k);
      share[i] = below[i + 1] - below[i];
      by_place[i] = (density[i] - density[i + 1]) * per_sigma;
      by_sigma[i] = (moment[i] - moment[i + 1]) * per_sigma;
    }
  }
};

}  // namespace omma
