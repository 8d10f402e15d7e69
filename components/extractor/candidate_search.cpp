#include "components/extractor/candidate_search.hpp"

#include <algorithm>
#include <bit>

namespace omma {

CandidateSearch::CandidateSearch(int width, int height)
    : width_(width), height_(height), background_(width, height), filter_(width, height), blobs_(width) {}

std::uint32_t CandidateSearch::find(const ImageView& image, bool invert,
                                    const ExtractorParameters& parameters, const PixelMask* blind,
                                    const WindowTiles* windows, std::vector<Candidate>& candidates) noexcept {
  image_ = image;
  invert_ = invert;
  blind_ = blind;
  windows_ = windows;
  parameters_ = &parameters;
  candidates_ = &candidates;
  without_room_ = 0;
  background_.build(image, invert, blind);
  filter_.start(image, invert, background_, parameters.threshold, windows);
  blobs_.start();
  const auto finished = [this](const Blob& blob) { add_candidates(blob); };
  for (int v = 1; v < height_ - 1; ++v) {
    const bool any = filter_.row(v);
    if (!any && blobs_.idle()) continue;
    blobs_.begin_row();
    if (any) add_runs(v);
    blobs_.end_row(v, finished);
  }
  blobs_.finish(finished);
  return without_room_;
}

void CandidateSearch::add_candidates(const Blob& blob) noexcept {
  if (std::max(blob.width(), blob.height()) > parameters_->max_diameter) return;
  // What reaches out of the windows is not what was expected in them, and only a part of it is known.
  if (windows_ != nullptr && !windows_->hold(blob.left - 1, blob.top - 1, blob.right + 1, blob.bottom + 1))
    return;
  Candidate candidate;
  candidate.left = blob.left;
  candidate.right = blob.right;
  candidate.top = blob.top;
  candidate.bottom = blob.bottom;
  candidate.area = blob.area;
  candidate.saturated = blob.saturated;
  const float u = 0.5F * static_cast<float>(blob.left + blob.right);
  const float v = 0.5F * static_cast<float>(blob.top + blob.bottom);
  PixelNoise& noise = candidate.noise;
  noise = {background_.level(u, v), background_.noise(u, v), parameters_->gain, parameters_->relative_noise};
  if (noise.gain <= 0) {  // unknown: the background as if it were all shot noise
    noise.gain = std::max(1.0F, noise.background - parameters_->black_level) / (noise.sigma * noise.sigma);
  }
  const auto light = [&](std::int64_t sum, std::int64_t pixels) {
    return static_cast<double>(sum) - static_cast<double>(noise.background) * static_cast<double>(pixels);
  };
  const double over = light(blob.light, blob.area);
  if (!(over > 0)) return;
  candidate.u = static_cast<float>(blob.origin_u + light(blob.light_u, blob.sum_u) / over);
  candidate.v = static_cast<float>(blob.origin_v + light(blob.light_v, blob.sum_v) / over);
  candidate.top_u = candidate.u;
  candidate.top_v = candidate.v;
  candidate.peak = static_cast<float>(blob.peak) - noise.background;
  candidate.threshold = parameters_->threshold * kFilterDeviation / kFilterSum;
  candidate.height = 0.5F * candidate.peak;
  find_peaks(image_, invert_, candidate, peaks_);
  candidate.peaks = std::max(1, static_cast<int>(peaks_.size()));
  const auto add = [&] {
    if (candidates_->size() == candidates_->capacity()) drop_faint_half();
    candidates_->push_back(candidate);
  };
  if (peaks_.empty()) return add();
  candidate.area /= candidate.peaks;
  for (const Peak& peak : peaks_) {
    candidate.height = static_cast<float>(peak.height) / 16 - noise.background;
    candidate.top_u = static_cast<float>(peak.u);
    candidate.top_v = static_cast<float>(peak.v);
    candidate.lean_u = peak.lean_u;
    candidate.lean_v = peak.lean_v;
    if (peaks_.size() > 1) {
      candidate.u = candidate.top_u;
      candidate.v = candidate.top_v;
    }
    add();
  }
}

// What is bright must not be lost because it comes late.
void CandidateSearch::drop_faint_half() noexcept {
  const auto middle = candidates_->begin() + static_cast<std::ptrdiff_t>(candidates_->size() / 2);
  std::nth_element(candidates_->begin(), middle, candidates_->end(), brighter);
  without_room_ += static_cast<std::uint32_t>(candidates_->end() - middle);
  candidates_->erase(middle, candidates_->end());
}

// The runs of set bits of the row, each given to its blob.
void CandidateSearch::add_runs(int v) noexcept {
  int first = 0;  // of the run at hand
  int end = -1;   // one behind its last pixel; -1: there is none
  for (int block = 0; block < filter_.blocks(); ++block) {
    for (std::uint64_t found = filter_.found(block); found != 0; found &= found - 1) {
      const int k = 64 * block + std::countr_zero(found);
      std::uint64_t word = filter_.word(k);
      if (blind_ != nullptr) word &= ~blind_->word(v, k);
      for (int base = k * DetectionFilter::kWord; word != 0;) {
        const int start = std::countr_zero(word);
        const int ones = std::countr_one(word >> start);
        if (base + start != end) {  // else it goes on from the word before
          if (end >= 0) add_run(first, end - 1, v);
          first = base + start;
        }
        end = base + start + ones;
        word = start + ones == 64 ? 0 : word & (~std::uint64_t{0} << (start + ones));
      }
    }
  }
  if (end >= 0) add_run(first, end - 1, v);
}

void CandidateSearch::add_run(int first, int last, int v) noexcept {
  add_pixels(first, last, v, blobs_.add_run(first, last, v));
}

void CandidateSearch::add_pixels(int first, int last, int v, Blob& blob) noexcept {
  if (image_.format == PixelFormat::kGrey8) {
    blob.add_row(image_.row<std::uint8_t>(v), first, last, v, image_.white_level, invert_);
  } else {
    blob.add_row(image_.row<std::uint16_t>(v), first, last, v, image_.white_level, invert_);
  }
}

}  // namespace omma
