// Image → dots of one camera: background and noise map, detection filter, connected components, measurement.
// One pass over the image; all scratch is made at construction. Self-contained: may run on any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "components/extractor/background_map.hpp"
#include "components/extractor/blob_finder.hpp"
#include "components/extractor/blob_peaks.hpp"
#include "components/extractor/detection_filter.hpp"
#include "components/extractor/dot.hpp"
#include "components/extractor/dot_measurement.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "hal/image.hpp"

namespace omma {

class DotExtractor {
 public:
  /// For images of exactly this size [px].
  DotExtractor(int width, int height);

  /// Fills the dots, their count dropped, background and noise of `list`; its frame, time and status are the
  /// caller's. An image of another size, or smaller than 3×3, gives no dots.
  void extract(const ImageView& image, const ExtractorParameters& parameters, DotList& list) noexcept;

 private:
  void search(const ImageView& image, const ExtractorParameters& parameters, bool invert) noexcept;
  void add_runs(const ImageView& image, bool invert, int v) noexcept;
  void add_pixels(const ImageView& image, bool invert, int first, int last, int v, Blob& blob) noexcept;
  void add_candidates(const ImageView& image, bool invert, const Blob& blob,
                      const ExtractorParameters& parameters) noexcept;
  void keep_best(DotList& list) noexcept;

  static constexpr std::size_t kCandidates = 4096;

  int width_;
  int height_;
  BackgroundMap background_;
  DetectionFilter filter_;
  BlobFinder blobs_;
  Peaks peaks_;
  std::vector<Candidate> candidates_;
  DotMeasurement measurement_;
  std::vector<Dot> found_;
  std::vector<std::uint16_t> order_;
  std::uint32_t overflow_ = 0;  // candidates beyond the scratch
};

}  // namespace omma
