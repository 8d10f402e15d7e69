#include "components/extractor/dot_extractor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace omma {

DotExtractor::DotExtractor(int width, int height)
    : width_(width),
      height_(height),
      background_(width, height),
      blobs_(width),
      measurement_(width, height, kCandidates) {
  const auto words = static_cast<std::size_t>((width + 63) / 64);
  row_length_ = (words + 1) * 64;
  for (auto& row : smoothed_) row.resize(row_length_);
  const auto cell_rows = static_cast<std::size_t>((height + BackgroundMap::kCell - 1) / BackgroundMap::kCell);
  threshold_.resize(cell_rows * row_length_);
  bits_.resize(words);
  candidates_.reserve(kCandidates);
  found_.reserve(kCandidates);
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

// 16-bit pixels are brought to 12 bits about the background, fine enough to keep its noise.
PixelScale DotExtractor::pixel_scale(const ImageView& image, bool invert) const noexcept {
  PixelScale scale;
  scale.invert = invert;
  scale.white_level = image.white_level;
  if (image.white_level <= 4095) return scale;
  float lowest = background_.level_row(0)[0];
  for (int row = 0; row < background_.rows(); ++row) {
    for (int column = 0; column < background_.columns(); ++column) {
      lowest = std::min(lowest, background_.level_row(row)[column]);
    }
  }
  scale.pedestal = std::max(0, static_cast<int>(lowest - 8 * background_.median_noise()));
  while (scale.shift < 4 && background_.median_noise() > static_cast<float>(4 << scale.shift)) ++scale.shift;
  return scale;
}

// Threshold of every pixel along the middle row of each row of cells; between them it is interpolated.
void DotExtractor::prepare_thresholds(const PixelScale& scale, float threshold) noexcept {
  const float unit = 1.0F / static_cast<float>(1 << scale.shift);
  const auto pedestal = static_cast<float>(scale.pedestal);
  for (int row = 0; row < background_.rows(); ++row) {
    std::int16_t* out = &threshold_[static_cast<std::size_t>(row) * row_length_];
    const float* level = background_.level_row(row);
    const float* noise = background_.noise_row(row);
    const auto at_cell = [&](int column) {
      const int c = std::clamp(column, 0, background_.columns() - 1);
      return unit * (kFilterSum * (level[c] - pedestal) + threshold * kFilterNoise * noise[c]);
    };
    for (int u = 0; u < width_; ++u) {
      const float x = (static_cast<float>(u) + 0.5F) / BackgroundMap::kCell - 0.5F;
      const int column = static_cast<int>(std::floor(x));
      const float fraction = x - static_cast<float>(column);
      const float value = at_cell(column) + fraction * (at_cell(column + 1) - at_cell(column));
      out[u] = static_cast<std::int16_t>(std::clamp(value, 0.0F, static_cast<float>(kFilterTop)));
    }
    for (std::size_t u = static_cast<std::size_t>(width_); u < row_length_; ++u) out[u] = kFilterTop;
  }
}

void DotExtractor::search(const ImageView& image, const ExtractorParameters& parameters,
                          bool invert) noexcept {
  background_.build(image, invert);
  const PixelScale scale = pixel_scale(image, invert);
  prepare_thresholds(scale, parameters.threshold);
  blobs_.start();
  candidates_.clear();
  const auto finished = [&](const Blob& blob) { add_candidates(image, invert, blob, parameters); };

  smooth_row(image, 0, scale, smoothed_[0].data());
  smooth_row(image, 1, scale, smoothed_[1].data());
  const int last_cell_row = background_.rows() - 1;
  for (int v = 1; v < height_ - 1; ++v) {
    smooth_row(image, v + 1, scale, smoothed_[(v + 1) % 3].data());
    const int offset = v - BackgroundMap::kCell / 2;
    const int band = offset < 0 ? -1 : offset / BackgroundMap::kCell;
    const int phase = offset - band * BackgroundMap::kCell;
    const auto threshold_of = [&](int row) {
      return &threshold_[static_cast<std::size_t>(std::clamp(row, 0, last_cell_row)) * row_length_];
    };
    blobs_.begin_row();
    if (threshold_row(smoothed_[(v - 1) % 3].data(), smoothed_[v % 3].data(), smoothed_[(v + 1) % 3].data(),
                      threshold_of(band), threshold_of(band + 1), phase, width_, bits_.data())) {
      add_runs(image, scale, v);
    }
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
  candidate.area = static_cast<int>(blob.shape.n);
  candidate.saturated = static_cast<int>(blob.saturated.n);
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
  const double over = light(blob.light.n, blob.shape.n);
  if (!(over > 0)) return;
  candidate.light = static_cast<float>(over);
  candidate.u = static_cast<float>(blob.origin_u + light(blob.light.u, blob.shape.u) / over);
  candidate.v = static_cast<float>(blob.origin_v + light(blob.light.v, blob.shape.v) / over);
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
void DotExtractor::add_runs(const ImageView& image, const PixelScale& scale, int v) noexcept {
  int first = -1;  // of a run that reaches into the next word
  for (std::size_t k = 0; k < bits_.size(); ++k) {
    std::uint64_t word = bits_[k];
    const int base = static_cast<int>(k) * 64;
    if (first >= 0) {
      const int ones = std::countr_one(word);
      if (ones == 64) continue;
      add_pixels(image, scale.invert, first, base + ones - 1, v, blobs_.add_run(first, base + ones - 1, v));
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
      add_pixels(image, scale.invert, base + start, end, v, blobs_.add_run(base + start, end, v));
      word &= ~(((1ULL << ones) - 1) << start);
    }
  }
  if (first >= 0) add_pixels(image, scale.invert, first, width_ - 1, v, blobs_.add_run(first, width_ - 1, v));
}

void DotExtractor::add_pixels(const ImageView& image, bool invert, int first, int last, int v,
                              Blob& blob) noexcept {
  for (int u = first; u <= last; ++u) {
    const int raw =
        image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
    const int value = invert ? image.white_level - raw : raw;
    blob.shape.add(1, u - blob.origin_u, v - blob.origin_v);
    blob.light.add(value, u - blob.origin_u, v - blob.origin_v);
    if (value >= image.white_level) blob.saturated.add(1, u - blob.origin_u, v - blob.origin_v);
    if (value > blob.peak) {
      blob.peak = value;
      blob.peak_u = u;
      blob.peak_v = v;
    }
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
  std::partial_sort(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(kept), found_.end(), surer);
  std::sort(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(kept), brighter);
  for (std::size_t i = 0; i < kept; ++i) list.dots.push_back(found_[i]);
}

}  // namespace omma
