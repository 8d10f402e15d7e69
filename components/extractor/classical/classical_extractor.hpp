// Image → dots of one camera by a classical pipeline, with what the chain behind it needs of a dot:
// covariance, light, signal-to-noise ratio. Stands where DotExtractor stands; all scratch is made at
// construction.
#pragma once

#include <vector>

#include "components/extractor/background_map.hpp"
#include "components/extractor/best_dots.hpp"
#include "components/extractor/classical/pipelines.hpp"
#include "components/extractor/dot.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "hal/image.hpp"

namespace omma {

class ClassicalExtractor {
 public:
  /// For images of exactly this size [px]. @param parameters  whose classical part stays
  ClassicalExtractor(int width, int height, const ExtractorParameters& parameters);

  /// As DotExtractor's; the whole image is searched, and a dot that touches what is masked is none.
  /// @param blind  of the image's size, or null
  void extract(const ImageView& image, const ExtractorParameters& parameters, const PixelMask* blind,
               DotList& list) noexcept;

  const BackgroundMap& background() const { return background_; }  ///< of the last image

 private:
  void search(const ImageView& image, bool invert, const ExtractorParameters& parameters,
              const PixelMask* blind) noexcept;

  int width_, height_;
  ExtractorAlgorithm algorithm_;
  BackgroundMap background_;
  ClassicalPipelines pipelines_;
  std::vector<Dot> found_;
  BestDots best_;
  std::uint32_t overflow_ = 0;
};

}  // namespace omma
