// Black frame: what each pixel of a sensor shows without light, with its noise, and which pixels are hot.
// Built from frames taken with the lens covered. Formulas in docs/algorithms/sensor.md#black-frame.
#pragma once

#include <cstdint>
#include <vector>

#include "components/sensor/pixel_mask.hpp"
#include "hal/image.hpp"

namespace omma {

struct BlackFrame {
  int width = 0, height = 0;  ///< [px]; 0: none
  int frames = 0;             ///< it was made of
  std::vector<float> mean;    ///< rows packed [grey levels]
  std::vector<float> noise;   ///< standard deviation of one frame's pixel [grey levels]
  PixelMask hot;              ///< pixels that are not to be trusted

  bool empty() const { return mean.empty(); }
  float typical_mean() const;   ///< median over the pixels [grey levels]
  float typical_noise() const;  ///< median over the pixels [grey levels]
};

struct HotPixelRule {
  double above = 8;    ///< mean above the typical one, in robust standard deviations of the means
  double noisier = 4;  ///< noise above so many times the typical one
  double least = 3;    ///< and by so many grey levels, either
};

/// Which pixels were called hot, and why; one pixel may be counted in both.
struct HotPixelCounts {
  int bright = 0, noisy = 0, all = 0;
};

/// Adds up dark frames of one size; ground only.
class BlackFrameBuilder {
 public:
  /// The first frame sets the size. @return false where this one has another size: it is not added
  bool add(const ImageView& dark);
  int frames() const { return frames_; }
  /// Mean and noise (0 of a single frame) of the frames added, and the hot pixels by the rule.
  BlackFrame build(const HotPixelRule& rule, HotPixelCounts& counts) const;

 private:
  int width_ = 0, height_ = 0, frames_ = 0;
  std::vector<double> sum_, squares_;  // squares about the first frame, so that nothing cancels
  std::vector<double> first_;
};

}  // namespace omma
