// Spots that stand alone, eight side by side: the fit of spot_fit on small windows without masked or full
// pixels, one spot to a lane of a vector, and one step of it at a time. Formulas in
// docs/algorithms/extractor.md#spot.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "components/extractor/candidate.hpp"
#include "components/extractor/lanes.hpp"
#include "components/extractor/spot_fit.hpp"
#include "hal/image.hpp"

namespace omma {

class LoneSpots {
 public:
  static constexpr int kMostRadius = 5;  ///< of a window [px]

  /// Begins with no spots, in windows of 2 radius + 1 pixels a side.
  void start(int radius) noexcept;
  /// Whether the window about a place lies inside the image with what is read beside it.
  static bool fits(const ImageView& image, double u, double v, int radius) noexcept;

  /// Adds a spot whose window fits; there must be room.
  /// @param fit  flux, u, v, sigma to start from
  void add(const SpotFit& fit, const PixelNoise& noise, const SpotPrior& prior) noexcept;
  std::size_t size() const noexcept { return count_; }
  bool full() const noexcept { return count_ == kLanes; }

  /// Loads the pixels.
  void load(const ImageView& image, bool invert) noexcept;
  /// One step of all spots that are not settled.
  void step() noexcept;
  /// Whether spot i can be fitted here: its window has no full pixel, its place stays in it.
  bool is_fit(std::size_t i) const noexcept { return unfit_[i] == 0; }
  /// What the fit of spot i is now. `usable` where it is at its end; else a start for another fit.
  void get(std::size_t i, SpotFit& fit) const noexcept;
  /// Of spot i.
  int left(std::size_t i) const noexcept { return left_[i]; }
  int top(std::size_t i) const noexcept { return top_[i]; }
  /// Light of a pixel of the window of spot i [grey levels].
  float light(std::size_t i, int y, int x) const noexcept {
    return light_[static_cast<std::size_t>(y * side_ + x) * kLanes + i];
  }

 private:
  static constexpr std::size_t kMostSide = 2 * kMostRadius + 1;
  template <class T>
  using Lane = std::array<T, kLanes>;

  friend struct LoneStep;

  int side_ = 0;
  std::size_t count_ = 0;
  Lane<int> left_{}, top_{};
  Lane<float> level_{};  // of the background [grey levels]
  // Where the fits stand; the place in the window.
  Lane<float> flux_{}, sigma_{}, background_{}, u_{}, v_{};
  Lane<std::int32_t> settled_{}, unfit_{};  // −1: yes
  // A pixel's variance by the spot's light in it, and the priors.
  Lane<float> dark_{}, per_light_{}, per_square_{};
  Lane<float> usual_sigma_{}, sigma_information_{}, background_information_{};
  // Of the last step.
  Lane<float> variance_u_{}, variance_v_{}, covariance_uv_{}, flux_information_{}, chi2_{};
  Lane<float> stretch_{}, skew_{}, shape_information_{};
  alignas(sizeof(Floats)) std::array<float, kMostSide * kMostSide * kLanes> light_;
};

}  // namespace omma
