// The image at half its resolution, each pixel the sum of four: where the point spread is wide, the detection
// filter on it is the matched one.
#pragma once

#include <cstdint>
#include <vector>

#include "components/extractor/background_map.hpp"
#include "components/extractor/candidate.hpp"
#include "hal/image.hpp"

namespace omma {

class HalvedImage {
 public:
  /// For images of at most this size; nothing is allocated later.
  HalvedImage(int width, int height);

  /// @return the view of the halved image; its white level is the format's where the sums do not fit
  ImageView build(const ImageView& image) noexcept;

  /// Turns a candidate of the halved image into one of the whole image.
  static void enlarge(const BackgroundMap& background, Candidate& candidate) noexcept;

 private:
  std::vector<std::uint16_t> pixels_;
};

}  // namespace omma
