// One axis of a Gaussian spot integrated over square pixels: the share of the light that each pixel of a row
// receives, with its derivatives. Own exponential in plain float arithmetic: every machine gets the same
// bits. Sources: exp by Cody & Waite's reduction and a polynomial (Cephes); erf by Abramowitz & Stegun
// 1964, 7.1.26
// (|error| < 1.5e-7); formulas in docs/algorithms/extractor.md#spot.
#pragma once

#include <array>
#include <bit>
#include <cstddef>

#include "components/extractor/lanes.hpp"

namespace omma {

inline constexpr int kSpotSide = 32;  ///< most pixels on a side of a window, padding included

/// e^x of x <= 0, relative error below 2e-7; e^-80 below -80.
[[gnu::always_inline]] inline Floats exp_of_negative(Floats x) {
  x = x < -80.0F ? Floats{} - 80.0F : x;
  const Ints n = __builtin_convertvector(x * 1.44269504F - 0.5F, Ints);
  const Floats whole = __builtin_convertvector(n, Floats);
  const Floats r = (x - whole * 0.693359375F) + whole * 2.12194440e-4F;  // |r| <= ln 2 / 2
  Floats p = Floats{} + 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  p = p * r * r + r + 1.0F;
  return p * std::bit_cast<Floats>((n + 127) << 23);
}

/// The window's side rounded up to whole vectors.
constexpr int padded(int pixels) {
  return (pixels + 7) & ~7;
}

// Φ(z), φ(z) and z φ(z) at the edges of pixels.
struct PixelEdge {
  Floats below, density, moment;

  [[gnu::always_inline]] explicit PixelEdge(const Floats& z) {
    const Floats size = z < 0.0F ? -z : z;
    const Floats bell = exp_of_negative(-0.5F * z * z);
    const Floats t = 1.0F / (1.0F + 0.23164190F * size);  // 0.3275911 / √2
    Floats tail = Floats{} + 1.061405429F;
    tail = tail * t - 1.453152027F;
    tail = tail * t + 1.421413741F;
    tail = tail * t - 0.284496736F;
    tail = 0.5F * (tail * t + 0.254829592F) * t * bell;
    below = z < 0.0F ? tail : 1.0F - tail;
    density = 0.398942280F * bell;
    moment = 0.398942280F * z * bell;
  }
};

struct SpotProfile {
  std::array<float, kSpotSide> share;     ///< of the light in pixel i
  std::array<float, kSpotSide> by_place;  ///< ∂share/∂place [1/px]
  std::array<float, kSpotSide> by_sigma;  ///< ∂share/∂sigma [1/px]

  /// @param place   of the spot, pixel 0 of the row having its centre at 0 [px]
  /// @param sigma   standard deviation before integration over the pixel [px]
  /// @param pixels  odd; the padding behind them is set to 0
  [[gnu::always_inline]] void fill(float place, float sigma, int pixels) {
    const float per_sigma = 1.0F / sigma;
    const int all = padded(pixels);
    Floats edge = Floats{0, 1, 2, 3, 4, 5, 6, 7} - (0.5F + place);
    Ints column = Ints{0, 1, 2, 3, 4, 5, 6, 7};
    PixelEdge lower(edge * per_sigma);
    for (int k = 0; k < all; k += 8, column += 8) {
      edge += 8.0F;
      // The last pixel is padding: no upper edge is asked of it.
      const PixelEdge next = k + 8 < all ? PixelEdge(edge * per_sigma) : lower;
      const auto i = static_cast<std::size_t>(k);
      const Ints inside = column < pixels;
      put(&share[i], following(lower.below, next.below) - lower.below, inside);
      put(&by_place[i], (lower.density - following(lower.density, next.density)) * per_sigma, inside);
      put(&by_sigma[i], (lower.moment - following(lower.moment, next.moment)) * per_sigma, inside);
      lower = next;
    }
  }

  /// The same for pixels of which only the middle takes light; the shares still add up to 1 on average.
  /// @param aperture  side of that part [px], below 1
  [[gnu::always_inline]] void fill_with_gaps(float place, float sigma, int pixels, float aperture) {
    const float per_sigma = 1.0F / sigma;
    const float scale = 1.0F / aperture;
    Ints column = Ints{0, 1, 2, 3, 4, 5, 6, 7};
    Floats middle = Floats{0, 1, 2, 3, 4, 5, 6, 7} - place;
    for (int k = 0; k < padded(pixels); k += 8, column += 8, middle += 8.0F) {
      const auto i = static_cast<std::size_t>(k);
      const Ints inside = column < pixels;
      const PixelEdge lower((middle - 0.5F * aperture) * per_sigma);
      const PixelEdge upper((middle + 0.5F * aperture) * per_sigma);
      put(&share[i], (upper.below - lower.below) * scale, inside);
      put(&by_place[i], (lower.density - upper.density) * (per_sigma * scale), inside);
      put(&by_sigma[i], (lower.moment - upper.moment) * (per_sigma * scale), inside);
    }
  }

 private:
  // One lane further along a row of which two vectors are given.
  [[gnu::always_inline]] static Floats following(const Floats& here, const Floats& next) {
    return __builtin_shufflevector(here, next, 1, 2, 3, 4, 5, 6, 7, 8);
  }
  [[gnu::always_inline]] static void put(float* to, const Floats& x, const Ints& inside) {
    store(to, std::bit_cast<Floats>(std::bit_cast<Ints>(x) & inside));
  }
};

}  // namespace omma
