#include "components/extractor/dot_extractor.hpp"

#include <algorithm>

namespace omma {
namespace {

// Width of the point spread from which the image is searched at half its resolution too [px].
constexpr float kWide = 1.25F;

}  // namespace

DotExtractor::DotExtractor(int width, int height)
    : width_(width),
      height_(height),
      fine_(width, height),
      halved_(width, height),
      coarse_(std::max(3, width / 2), std::max(3, height / 2)),
      halved_mask_(std::max(3, width / 2), std::max(3, height / 2)),
      measurement_(width, height, kCandidates),
      best_(kCandidates) {
  candidates_.reserve(kCandidates);
  coarse_candidates_.reserve(kCandidates / 2);
  found_.reserve(kCandidates);
}

void DotExtractor::extract(const ImageView& image, const ExtractorParameters& parameters,
                           const ImageMasks& masks, DotList& list, const WindowTiles* windows) noexcept {
  masks_ = masks;
  windows_ = windows;
  list.dots.clear();
  list.dropped = 0;
  found_.clear();
  overflow_ = 0;
  if (image.empty() || image.width != width_ || image.height != height_ || width_ < 3 || height_ < 3) return;
  if (parameters.polarity != DotPolarity::kBright) search(image, parameters, true);
  if (parameters.polarity != DotPolarity::kDark) search(image, parameters, false);
  list.background = fine_.background().median_level();
  list.noise = fine_.background().median_noise();
  best_.hand_over(found_, overflow_, list);
}

void DotExtractor::search(const ImageView& image, const ExtractorParameters& parameters,
                          bool invert) noexcept {
  candidates_.clear();
  overflow_ += fine_.find(image, invert, parameters, masks_.blind, windows_, candidates_);
  const float width = measurement_.start(image, invert, parameters, masks_, candidates_);
  if (width > kWide && width_ >= 6 && height_ >= 6) {
    add_wide(image, parameters, invert, width);
    measurement_.start(image, invert, parameters, masks_, candidates_);
  }
  overflow_ += static_cast<std::uint32_t>(measurement_.measure(candidates_, found_));
}

// Candidates of the halved image take the place of what the fine scale made of the same spots: pieces, if
// anything.
void DotExtractor::add_wide(const ImageView& image, const ExtractorParameters& parameters, bool invert,
                            float width) noexcept {
  coarse_candidates_.clear();
  if (masks_.blind != nullptr) halved_mask_.halve(*masks_.blind);
  overflow_ += coarse_.find(halved_.build(image), invert, parameters,
                            masks_.blind != nullptr ? &halved_mask_ : nullptr, nullptr, coarse_candidates_);
  for (Candidate& candidate : coarse_candidates_) HalvedImage::enlarge(fine_.background(), candidate);
  if (windows_ != nullptr)
    std::erase_if(coarse_candidates_,
                  [this](const Candidate& c) { return !windows_->hold(c.left, c.top, c.right, c.bottom); });
  std::sort(coarse_candidates_.begin(), coarse_candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.v != b.v ? a.v < b.v : a.u < b.u; });
  const float near = 2 * width + 1;
  std::erase_if(candidates_, [&](const Candidate& fine) {
    auto coarse = std::lower_bound(coarse_candidates_.begin(), coarse_candidates_.end(), fine.v - near,
                                   [](const Candidate& c, float v) { return c.v < v; });
    for (; coarse != coarse_candidates_.end() && coarse->v < fine.v + near; ++coarse) {
      const float du = coarse->u - fine.u;
      const float dv = coarse->v - fine.v;
      if (du * du + dv * dv < near * near) return true;
    }
    return false;
  });
  for (const Candidate& candidate : coarse_candidates_) {
    if (candidates_.size() < kCandidates) {
      candidates_.push_back(candidate);
    } else {
      ++overflow_;
    }
  }
}

}  // namespace omma
