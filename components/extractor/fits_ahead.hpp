// Fits of the spots that stand alone, made for a stretch of candidates at once, ahead of the one by one
// measurement: none of them has to wait for its neighbours' light to be known.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "components/extractor/candidate.hpp"
#include "components/extractor/lone_spots.hpp"
#include "components/extractor/spot_field.hpp"
#include "components/extractor/spot_fit.hpp"

namespace omma {

/// Light over the background at a spot's middle.
struct MiddleLight {
  bool known = false;
  float middle = 0;  ///< of the pixel nearest to its place [grey levels]
  float around = 0;  ///< of that pixel's four neighbours together [grey levels]
};

/// @param light  (row, column) → of a pixel of a window of so many columns and rows
template <class Light>
MiddleLight light_about(int column, int row, int side, Light&& light) {
  if (column < 1 || row < 1 || column > side - 2 || row > side - 2) return {};
  return {true, light(row, column),
          light(row - 1, column) + light(row + 1, column) + light(row, column - 1) + light(row, column + 1)};
}

struct FitAhead {
  enum State {
    kNone,   ///< it must be measured by itself
    kBegun,  ///< the same, from where `fit` is
    kDone,
  };
  State state = kNone;
  SpotFit fit;
  MiddleLight light;
};

class FitsAhead {
 public:
  static constexpr std::size_t kMost = 64;  ///< candidates to a stretch

  struct Source {
    const ImageView* image = nullptr;
    bool invert = false;
    ImageMasks masks;
  };

  /// Fits those of candidates first … first + kMost − 1 that stand alone.
  /// @param field  the candidates in the same order
  void fit(const Source& source, const SpotPrior& prior, float max_point_sigma, const SpotField& field,
           const std::vector<Candidate>& candidates, std::size_t first) noexcept;

  /// Of candidate first + i.
  const FitAhead& operator[](std::size_t i) const noexcept { return fits_[i]; }
  /// No other candidate is as near as this on both axes to a spot fitted ahead [px].
  float distance() const noexcept { return distance_; }

 private:
  void step_eight(const Source& source, int radius) noexcept;

  float distance_ = 0;
  std::array<FitAhead, kMost> fits_;
  LoneSpots spots_;
  std::array<std::size_t, kLanes> whose_{};
};

}  // namespace omma
