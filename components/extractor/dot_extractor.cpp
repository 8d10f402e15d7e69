#include "components/extractor/dot_extractor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace omma {

DotExtractor::DotExtractor(int width, int height)
    : width_(width),
      height_(height),
      background_(width, height),
      filter_(width, height),
      blobs_(width),
      measurement_(width, height, kCandidates) {
  candidates_.reserve(kCandidates);
  found_.reserve(kCandidates);
  order_.reserve(kCandidates);
}

void DotExtractor::extract(const ImageView& image, const ExtractorParameters& parameters,
                           DotList& list) noexcept {
  list.dots.clear();
  list.dropped = 0;
  found_.clear();
  overflow_ = 0;
  if (image.empty() || image.width != width_ || image.height != height_ || width_ < 3 || height_ < 3) return;
  if (parameters.polarity != DotPolarity::kBright) search(image, parameters, true);
  if (parameters.polarity != DotPolarity::kDark) search(image, parameters, false);
  list.background = background_.median_level();
  list.noise = background_.median_noise();
  keep_best(list);
}

void DotExtractor::search(const ImageView& image, const ExtractorParameters& parameters,
                          bool invert) noexcept {
  background_.build(image, invert);
  filter_.start(image, invert, background_, parameters.threshold);
  blobs_.start();
  candidates_.clear();
  const auto finished = [&](const Blob& blob) { add_candidates(image, invert, blob, parameters); };

  for (int v = 1; v < height_ - 1; ++v) {
    const bool any = filter_.row(v);
    if (!any && blobs_.idle()) continue;
    blobs_.begin_row();
    if (any) add_runs(image, invert, v);
    blobs_.end_row(v, finished);
  }
  blobs_.finish(finished);
  measurement_.measure(image, invert, parameters, candidates_, found_);
}

void DotExtractor::add_candidates(const ImageView& image, bool invert, const Blob& blob,
                                  const ExtractorParameters& parameters) noexcept {
  if (std::max(blob.width(), blob.height()) > parameters.max_diameter) return;
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
  noise = {background_.level(u, v), background_.noise(u, v), parameters.gain};
  if (noise.gain <= 0) {  // unknown: the background as if it were all shot noise
    noise.gain = std::max(1.0F, noise.background - parameters.black_level) / (noise.sigma * noise.sigma);
  }
  const auto light = [&](std::int64_t sum, std::int64_t pixels) {
    return static_cast<double>(sum) - static_cast<double>(noise.background) * static_cast<double>(pixels);
  };
  const double over = light(blob.light, blob.area);
  if (!(over > 0)) return;
  candidate.light = static_cast<float>(over);
  candidate.u = static_cast<float>(blob.origin_u + light(blob.light_u, blob.sum_u) / over);
  candidate.v = static_cast<float>(blob.origin_v + light(blob.light_v, blob.sum_v) / over);
  candidate.peak = static_cast<float>(blob.peak) - noise.background;
  candidate.height = 0.5F * candidate.peak;
  find_peaks(image, invert, candidate, peaks_);
  candidate.peaks = std::max(1, static_cast<int>(peaks_.size()));
  const auto add = [&] {
    if (candidates_.size() < kCandidates) {
      candidates_.push_back(candidate);
    } else {
      ++overflow_;
    }
  };
  if (peaks_.empty()) return add();
  candidate.area /= candidate.peaks;
  for (const Peak& peak : peaks_) {
    candidate.height = static_cast<float>(peak.height) / 16 - noise.background;
    if (peaks_.size() > 1) {
      candidate.u = static_cast<float>(peak.u);
      candidate.v = static_cast<float>(peak.v);
    }
    add();
  }
}

// The runs of set bits of the row, each given to its blob.
void DotExtractor::add_runs(const ImageView& image, bool invert, int v) noexcept {
  int first = -1;  // of a run that reaches into the next word
  for (int k = 0; k < filter_.words(); ++k) {
    std::uint64_t word = filter_.word(k);
    const int base = k * DetectionFilter::kWord;
    if (first >= 0) {
      const int ones = std::countr_one(word);
      if (ones == 64) continue;
      add_pixels(image, invert, first, base + ones - 1, v, blobs_.add_run(first, base + ones - 1, v));
      first = -1;
      word &= ~((1ULL << ones) - 1);
    }
    while (word != 0) {
      const int start = std::countr_zero(word);
      const int ones = std::countr_one(word >> start);
      if (start + ones == 64) {
        first = base + start;
        break;
      }
      const int end = base + start + ones - 1;
      add_pixels(image, invert, base + start, end, v, blobs_.add_run(base + start, end, v));
      word &= ~(((1ULL << ones) - 1) << start);
    }
  }
  if (first >= 0) add_pixels(image, invert, first, width_ - 1, v, blobs_.add_run(first, width_ - 1, v));
}

void DotExtractor::add_pixels(const ImageView& image, bool invert, int first, int last, int v,
                              Blob& blob) noexcept {
  for (int u = first; u <= last; ++u) {
    const int raw =
        image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
    const int value = invert ? image.white_level - raw : raw;
    blob.add(value, u, v);
    if (value >= image.white_level) ++blob.saturated;
  }
}

// The best by signal-to-noise ratio, handed over brightest first; ties in reading order, so that the result
// is the same on every machine.
void DotExtractor::keep_best(DotList& list) noexcept {
  const auto reading_order = [](const Dot& a, const Dot& b) {
    return a.pixel.y() != b.pixel.y() ? a.pixel.y() < b.pixel.y() : a.pixel.x() < b.pixel.x();
  };
  const auto surer = [&](const Dot& a, const Dot& b) {
    return a.snr != b.snr ? a.snr > b.snr : reading_order(a, b);
  };
  const auto brighter = [&](const Dot& a, const Dot& b) {
    return a.flux != b.flux ? a.flux > b.flux : reading_order(a, b);
  };
  const std::size_t kept = std::min(found_.size(), limits::kDotsPerCamera);
  list.dropped = static_cast<std::uint32_t>(found_.size() - kept) + overflow_;
  order_.resize(found_.size());
  std::iota(order_.begin(), order_.end(), std::uint16_t{0});
  const auto by = [&](const auto& rule) {
    return [this, &rule](std::uint16_t a, std::uint16_t b) { return rule(found_[a], found_[b]); };
  };
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(kept);
  if (kept < found_.size()) std::nth_element(order_.begin(), end, order_.end(), by(surer));
  std::sort(order_.begin(), end, by(brighter));
  for (std::size_t i = 0; i < kept; ++i) list.dots.push_back(found_[order_[i]]);
}

}  // namespace omma
