// Image → dots of one camera: candidates at one scale, or two where the point spread is wide, and their
// measurement. All scratch is made at construction. Self-contained: may run on any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "components/extractor/best_dots.hpp"
#include "components/extractor/candidate_search.hpp"
#include "components/extractor/dot.hpp"
#include "components/extractor/dot_measurement.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "components/extractor/halved_image.hpp"
#include "hal/image.hpp"

namespace omma {

class DotExtractor {
 public:
  /// For images of exactly this size [px].
  DotExtractor(int width, int height);

  /// Fills the dots, their count dropped, background and noise of `list`; its frame, time and status are the
  /// caller's. An image of another size, or smaller than 3×3, gives no dots.
  /// @param masks    of the image's size, or null
  /// @param windows  of the image's size: only dots that lie in them; null: everywhere
  void extract(const ImageView& image, const ExtractorParameters& parameters, const ImageMasks& masks,
               DotList& list, const WindowTiles* windows = nullptr) noexcept;
  void extract(const ImageView& image, const ExtractorParameters& parameters, DotList& list) noexcept {
    extract(image, parameters, {}, list);
  }

  int height() const { return height_; }  ///< [px]
  /// Of the last image.
  const BackgroundMap& background() const { return fine_.background(); }

 private:
  void search(const ImageView& image, const ExtractorParameters& parameters, bool invert) noexcept;
  void add_wide(const ImageView& image, const ExtractorParameters& parameters, bool invert,
                float width) noexcept;

  static constexpr std::size_t kCandidates = 4096;

  int width_;
  int height_;
  ImageMasks masks_;
  const WindowTiles* windows_ = nullptr;
  CandidateSearch fine_;
  HalvedImage halved_;
  CandidateSearch coarse_;
  PixelMask halved_mask_;
  std::vector<Candidate> candidates_, coarse_candidates_;
  DotMeasurement measurement_;
  std::vector<Dot> found_;
  BestDots best_;
  std::uint32_t overflow_ = 0;  // candidates beyond the scratch
};

}  // namespace omma
