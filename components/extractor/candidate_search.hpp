// Image → candidates at one scale: background and noise map, detection filter, connected components, peaks.
#pragma once

#include <cstdint>
#include <vector>

#include "components/extractor/background_map.hpp"
#include "components/extractor/blob_finder.hpp"
#include "components/extractor/blob_peaks.hpp"
#include "components/extractor/candidate.hpp"
#include "components/extractor/detection_filter.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "hal/image.hpp"

namespace omma {

class CandidateSearch {
 public:
  /// For images of exactly this size, at least 3×3 [px].
  CandidateSearch(int width, int height);

  /// Adds the image's candidates; where their capacity does not suffice, the faint half gives way.
  /// @param invert  the dots are darker than the background
  /// @param blind   of the same size: no pixel in it is part of a dot; null: none
  /// @param windows of the same size: only dots that lie in them; null: everywhere
  /// @return how many gave way
  std::uint32_t find(const ImageView& image, bool invert, const ExtractorParameters& parameters,
                     const PixelMask* blind, const WindowTiles* windows,
                     std::vector<Candidate>& candidates) noexcept;

  const BackgroundMap& background() const { return background_; }  ///< of the last image

 private:
  void add_runs(int v) noexcept;
  void add_run(int first, int last, int v) noexcept;
  void add_pixels(int first, int last, int v, Blob& blob) noexcept;
  void add_candidates(const Blob& blob) noexcept;
  void drop_faint_half() noexcept;

  int width_, height_;
  BackgroundMap background_;
  DetectionFilter filter_;
  BlobFinder blobs_;
  Peaks peaks_;
  // While find runs:
  ImageView image_;
  bool invert_ = false;
  const PixelMask* blind_ = nullptr;
  const WindowTiles* windows_ = nullptr;
  const ExtractorParameters* parameters_ = nullptr;
  std::vector<Candidate>* candidates_ = nullptr;
  std::uint32_t without_room_ = 0;
};

}  // namespace omma
