// The detection filter, row by row.
#include "components/extractor/detection_filter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "components/extractor/clones.hpp"
#include "components/extractor/index.hpp"

namespace omma {
namespace {

constexpr int kCell = BackgroundMap::kCell;
constexpr int kStrip = 16;  // pixels looked at together; the threshold is linear along them
constexpr int kStripsOfWord = DetectionFilter::kWord / kStrip;
constexpr float kFinest = 8;  // noise in the quick pass's units, if the image's range allows
constexpr float kFullRange = 250;
constexpr std::uint8_t kFull = 252;

// The cell whose centre is left of a strip, or at its left end.
constexpr int left_cell(int strip) {
  return (strip + 1) / 2 - 1;
}

// Averages of bytes that round up, as vector units have them.
inline std::uint8_t average(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) >> 1);
}

// Full, kFull at least, where it does not fit. Each returns the largest.
template <int kExponent>
[[gnu::always_inline]] inline std::uint8_t narrow(const std::uint8_t* x, int n, std::uint8_t flip,
                                                  std::uint8_t pedestal, std::uint8_t* out) {
  constexpr auto kMost = static_cast<std::uint8_t>(255 >> kExponent);
  std::uint8_t most = 0;
  for (int u = 0; u < n; ++u) {
    const auto turned = static_cast<std::uint8_t>(x[u] ^ flip);
    const auto over = static_cast<std::uint8_t>(std::max(turned, pedestal) - pedestal);
    auto y = std::min(over, kMost);
    for (int k = 0; k < kExponent; ++k) y = static_cast<std::uint8_t>(y + y);
    out[u] = y;
    most = std::max(most, y);
  }
  return most;
}
OMMA_CLONES std::uint8_t narrow_8(const std::uint8_t* x, int n, std::uint8_t flip, std::uint8_t pedestal,
                                  int exponent, std::uint8_t* out) {
  if (exponent == 0) return narrow<0>(x, n, flip, pedestal, out);
  if (exponent == 1) return narrow<1>(x, n, flip, pedestal, out);
  return narrow<2>(x, n, flip, pedestal, out);
}

OMMA_CLONES std::uint8_t narrow_16(const std::uint16_t* x, int n, std::uint16_t white, bool invert,
                                   std::uint16_t pedestal, int exponent, std::uint8_t* out) {
  std::uint8_t most = 0;
  for (int u = 0; u < n; ++u) {
    const std::uint16_t turned = invert ? static_cast<std::uint16_t>(white - std::min(x[u], white)) : x[u];
    const int over = std::max(turned, pedestal) - pedestal;
    const int scaled = exponent >= 0 ? over << exponent : (over + (1 << -exponent) - 1) >> -exponent;
    out[u] = static_cast<std::uint8_t>(std::min(scaled, 255));
    most = std::max(most, out[u]);
  }
  return most;
}

OMMA_CLONES void average_across(const std::uint8_t* x, int n, std::uint8_t* out) {
  for (int u = 1; u < n - 1; ++u) out[u] = average(average(x[u - 1], x[u + 1]), x[u]);
}

// Sets over[k] where some average of word k is over its limit. @param words  of a row, padded
OMMA_CLONES void average_down(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                              const std::uint8_t* limit, int words, std::uint8_t* out, std::uint8_t* over) {
  constexpr int kWord = DetectionFilter::kWord;
  for (int k = 0; k < words; ++k) {
    std::uint8_t most = 0;
    for (int u = k * kWord; u < (k + 1) * kWord; ++u) {
      const std::uint8_t y = average(average(above[u], below[u]), here[u]);
      out[u] = y;
      most = std::max(most, y);
    }
    over[k] = most > limit[k] ? 1 : 0;
  }
}

// Sets over[k] where some byte of word k is over its limit.
OMMA_CLONES void find_over(const std::uint8_t* x, const std::uint8_t* limit, int words, std::uint8_t* over) {
  for (int k = 0; k < words; ++k) {
    std::uint8_t most = 0;
    for (int i = 0; i < DetectionFilter::kWord; ++i) most = std::max(most, x[k * DetectionFilter::kWord + i]);
    over[k] = most > limit[k] ? 1 : 0;
  }
}

// Bytes of 0 or 1 as bits. @param n  to 64; eight bytes are read at a time
std::uint64_t bits_of_bytes(const std::uint8_t* x, int n) {
  std::uint64_t bits = 0;
  for (int k = 0; k < n; k += 8) {
    std::uint64_t eight;  // the product gathers them in its highest byte
    std::memcpy(&eight, x + k, sizeof eight);
    bits |= ((eight * 0x0102040810204080U) >> 56) << k;
  }
  return bits;
}

bool strip_over(const std::uint8_t* x, std::uint8_t limit) {
  using Strip = std::uint8_t __attribute__((vector_size(kStrip)));
  Strip values;
  std::memcpy(&values, x, sizeof values);
  const auto over = values > limit;
  std::array<std::uint64_t, 2> halves;
  std::memcpy(halves.data(), &over, sizeof halves);
  return (halves[0] | halves[1]) != 0;
}

// Bit i: the smoothed value of pixel i of a strip (made brighter by turning it about `turn`, where that is
// not 0) is over the straight line start + slope · i. The pointers are to the left neighbours of the first.
// Sum has room for the sums.
template <class Sum, class Pixel>
[[gnu::always_inline]] inline std::uint64_t strip_bits(const Pixel* above, const Pixel* here,
                                                       const Pixel* below, int turn, float start,
                                                       float slope) {
  std::array<Sum, kStrip + 2> down;
  for (std::size_t i = 0; i < down.size(); ++i) down[i] = static_cast<Sum>(above[i] + 2 * here[i] + below[i]);
  // A whole number is over the line where it is over the line's whole part.
  std::array<Sum, kStrip> limit;
  for (std::size_t i = 0; i < kStrip; ++i) {
    const float line = start + slope * static_cast<float>(static_cast<std::int32_t>(i));
    limit[i] = static_cast<Sum>(static_cast<std::int32_t>(line));
  }
  std::array<std::uint8_t, kStrip> over;
  for (std::size_t i = 0; i < kStrip; ++i) {
    const auto sum = static_cast<Sum>(down[i] + 2 * down[i + 1] + down[i + 2]);
    const auto value = turn > 0 ? static_cast<Sum>(turn - sum) : sum;
    over[i] = value > limit[i] ? 1 : 0;
  }
  return bits_of_bytes(over.data(), kStrip);
}
OMMA_CLONES std::uint64_t bits_of(const std::uint8_t* above, const std::uint8_t* here,
                                  const std::uint8_t* below, int turn, float start, float slope) {
  return strip_bits<std::int16_t>(above, here, below, turn, start, slope);
}
OMMA_CLONES std::uint64_t bits_of(const std::uint16_t* above, const std::uint16_t* here,
                                  const std::uint16_t* below, int turn, float start, float slope) {
  return strip_bits<std::int32_t>(above, here, below, turn, start, slope);
}

// Calls visit(first, last) with each run of set bits.
template <class Visit>
void for_runs(std::uint64_t bits, Visit&& visit) {
  while (bits != 0) {
    const int first = std::countr_zero(bits);
    const int end = first + std::countr_one(bits >> first);
    visit(first, end - 1);
    bits = end == 64 ? 0 : bits & (~std::uint64_t{0} << end);
  }
}

}  // namespace

DetectionFilter::DetectionFilter(int width, int height) : width_(width), height_(height) {
  const std::size_t count = static_cast<std::size_t>(width + kWord - 1) / kWord;
  row_length_ = (count + 1) * kWord;
  words_.resize(count);
  limit_.resize(count * kStripsOfWord);
  word_limit_.resize(count);
  over_.resize((count + 7) / 8 * 8);
  found_.resize((count + 63) / 64);
  narrow_.resize(row_length_);
  averaged_.resize(row_length_);
  for (auto& row : across_) row.resize(row_length_);
  for (auto& row : full_) row.resize(count);
  full_limit_.resize(count, kFull - 1);
  const std::size_t cells = static_cast<std::size_t>((width + kCell - 1) / kCell) *
                            static_cast<std::size_t>((height + kCell - 1) / kCell);
  threshold_.resize(cells);
}

float DetectionFilter::threshold_of(int row, int column) const noexcept {
  const auto r = static_cast<std::size_t>(std::clamp(row, 0, rows_ - 1));
  const auto c = static_cast<std::size_t>(std::clamp(column, 0, columns_ - 1));
  return threshold_[r * static_cast<std::size_t>(columns_) + c];
}

void DetectionFilter::start(const ImageView& image, bool invert, const BackgroundMap& background,
                            float threshold, const WindowTiles* windows) noexcept {
  image_ = &image;
  windows_ = windows;
  invert_ = invert;
  columns_ = background.columns();
  rows_ = background.rows();
  // Above all that can be: nothing is over it.
  const float most = kFilterSum * (static_cast<float>(image.white_level) + 1);
  std::size_t i = 0;
  for (int row = 0; row < rows_; ++row) {
    const float* level = background.level_row(row);
    const float* noise = background.noise_row(row);
    for (int column = 0; column < columns_; ++column)
      threshold_[i++] =
          std::min(kFilterSum * level[column] + threshold * kFilterDeviation * noise[column], most);
  }
  choose_scale(background);
  band_ = -2;
  averaged_row_.fill(-1);
}

// The finest steps with which the thresholds of the whole image still fit into 8 bits.
void DetectionFilter::choose_scale(const BackgroundMap& background) noexcept {
  float lowest = background.level_row(0)[0];
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      lowest = std::min(lowest, background.level_row(row)[column]);
  const float noise = background.median_noise();
  pedestal_ = std::max(0, static_cast<int>(lowest - 4 * noise));
  const auto cells = static_cast<std::ptrdiff_t>(columns_) * rows_;
  const float highest = *std::max_element(threshold_.begin(), threshold_.begin() + cells) / kFilterSum;
  exponent_ = 2;
  const auto unit = [&] { return std::ldexp(1.0F, exponent_); };
  while (exponent_ > -8 && noise * unit() > kFinest) --exponent_;
  const int least = image_->format == PixelFormat::kGrey8 ? 0 : -8;
  while (exponent_ > least && (highest - static_cast<float>(pedestal_)) * unit() > kFullRange) --exponent_;
  exponent_ = std::max(exponent_, least);
}

// Where a row above, at or below v is asked for.
void DetectionFilter::average_row(int v) noexcept {
  const std::size_t slot = index_of(v % 3);
  averaged_row_[slot] = v;
  any_full_[slot] = false;
  std::fill(full_[slot].begin(), full_[slot].end(), std::uint8_t{0});
  if (windows_ == nullptr) return average_words(v, 0, words() - 1);
  for_runs(windows_->row(v - 1) | windows_->row(v) | windows_->row(v + 1),
           [&](int first, int last) { average_words(v, first, last); });
}

void DetectionFilter::average_words(int v, int first, int last) noexcept {
  const std::size_t slot = index_of(v % 3);
  const int begin = first * kWord;
  const int end = (last + 1) * kWord;
  const int left = std::max(0, begin - 1);
  const int count = std::min(width_, end + 1) - left;
  std::uint8_t* narrow = &narrow_[index_of(left)];
  std::uint8_t most = 0;
  if (image_->format == PixelFormat::kGrey8) {
    most = narrow_8(image_->row<std::uint8_t>(v) + left, count, invert_ ? 0xFF : 0,
                    static_cast<std::uint8_t>(pedestal_), exponent_, narrow);
  } else {
    most = narrow_16(image_->row<std::uint16_t>(v) + left, count, image_->white_level, invert_,
                     static_cast<std::uint16_t>(pedestal_), exponent_, narrow);
  }
  average_across(narrow, count, &across_[slot][index_of(left)]);
  if (most < kFull) return;
  any_full_[slot] = true;
  find_over(&narrow_[index_of(begin)], full_limit_.data(), last - first + 1, &full_[slot][index_of(first)]);
}

bool DetectionFilter::row(int v) noexcept {
  const std::uint64_t asked = windows_ != nullptr ? windows_->row(v) : ~std::uint64_t{0};
  if (asked == 0) {
    std::fill(found_.begin(), found_.end(), std::uint64_t{0});
    return false;
  }
  for (int r = v - 1; r <= v + 1; ++r)
    if (averaged_row_[index_of(r % 3)] != r) average_row(r);
  const bool full = any_full_[0] || any_full_[1] || any_full_[2];
  const int offset = v - kCell / 2;
  const int band = offset < 0 ? -1 : offset / kCell;
  const int count = words();
  const int strips = count * kStripsOfWord;
  const bool band_changed = band != band_;
  if (band_changed) {  // the lowest threshold that plays a part in a strip of this band
    band_ = band;
    const float unit = std::ldexp(1.0F, exponent_);
    for (int k = 0; k < strips; ++k) {
      const int column = left_cell(k);
      const float lowest = std::min({threshold_of(band, column), threshold_of(band, column + 1),
                                     threshold_of(band + 1, column), threshold_of(band + 1, column + 1)});
      const float scaled = (lowest / kFilterSum - static_cast<float>(pedestal_)) * unit;
      limit_[static_cast<std::size_t>(k)] =
          static_cast<std::uint8_t>(std::clamp(std::floor(scaled), 0.0F, kFullRange));
    }
  }
  for (int k = 0; band_changed && k < count; ++k) {
    const auto first = limit_.begin() + std::ptrdiff_t{k} * kStripsOfWord;
    word_limit_[static_cast<std::size_t>(k)] = *std::min_element(first, first + kStripsOfWord);
  }
  if (windows_ == nullptr) {
    average_down_words(v, 0, count - 1);
  } else {
    for_runs(asked, [&](int first, int last) { average_down_words(v, first, last); });
  }
  place_row(v);
  bool any = false;
  for (int first = 0; first < count; first += 64) {
    const int block = std::min(64, count - first);
    std::uint64_t wanted = bits_of_bytes(&over_[index_of(first)], block);
    if (full)
      for (int k = 0; k < block; ++k) wanted |= static_cast<std::uint64_t>(near_full(first + k)) << k;
    if (windows_ != nullptr) wanted &= asked;
    std::uint64_t& found = found_[index_of(first / 64)];
    found = 0;
    for (; wanted != 0; wanted &= wanted - 1) {
      const int k = std::countr_zero(wanted);
      const std::uint64_t word = exact_word(v, first + k, full && near_full(first + k));
      words_[index_of(first + k)] = word;
      found |= static_cast<std::uint64_t>(word != 0) << k;
    }
    any = any || found != 0;
  }
  return any;
}

void DetectionFilter::average_down_words(int v, int first, int last) noexcept {
  const std::size_t begin = index_of(first, 0, kWord);
  const auto across = [&](int row) { return &across_[index_of(row % 3)][begin]; };
  average_down(across(v - 1), across(v), across(v + 1), &word_limit_[index_of(first)], last - first + 1,
               &averaged_[begin], &over_[index_of(first)]);
}

// Pixels over the threshold in a word of which some strip may hold one. @param all  all its strips may
std::uint64_t DetectionFilter::exact_word(int v, int k, bool all) const noexcept {
  const int first = k * kStripsOfWord;
  unsigned strips = all ? (1U << kStripsOfWord) - 1 : 0U;
  for (int i = 0; i < kStripsOfWord; ++i)
    strips |= static_cast<unsigned>(
                  strip_over(&averaged_[index_of(first + i, 0, kStrip)], limit_[index_of(first + i)]))
              << i;
  std::uint64_t word = 0;
  for (; strips != 0; strips &= strips - 1) {
    const int i = std::countr_zero(strips);
    word |= exact(v, first + i) << (i * kStrip);
  }
  return word;
}

// A pixel that does not fit is brighter than its average shows: words it may reach are computed exactly.
bool DetectionFilter::near_full(int k) const noexcept {
  for (const auto& row : full_)
    for (int i = std::max(0, k - 1); i <= std::min(words() - 1, k + 1); ++i)
      if (row[index_of(i)] != 0) return true;
  return false;
}

// Row v between the rows of cells.
void DetectionFilter::place_row(int v) noexcept {
  const float y = (static_cast<float>(v) + 0.5F) / kCell - 0.5F;
  const int row = static_cast<int>(std::floor(y));
  down_ = y - static_cast<float>(row);
  above_ = &threshold_[index_of(std::clamp(row, 0, rows_ - 1), 0, columns_)];
  below_ = &threshold_[index_of(std::clamp(row + 1, 0, rows_ - 1), 0, columns_)];
}

// The threshold is bilinear between the cells' centres, which lie between two strips.
std::uint64_t DetectionFilter::exact(int v, int strip) const noexcept {
  static_assert(kCell == 2 * kStrip);
  const auto middle_of = [this](int column) {  // of the row, at a cell's centre
    const auto c = index_of(std::clamp(column, 0, columns_ - 1));
    return above_[c] + down_ * (below_[c] - above_[c]);
  };
  const float left = middle_of(left_cell(strip));
  const float slope = (middle_of(left_cell(strip) + 1) - left) / kCell;
  const float start = left + slope * (strip % 2 == 0 ? kStrip + 0.5F : 0.5F);
  const int turn = invert_ ? kFilterSum * image_->white_level : 0;
  const int first = strip * kStrip;
  if (first >= width_ - 1) return 0;
  const auto bits = [&]<class Pixel>(Pixel /*type*/) -> std::uint64_t {
    const Pixel* rows[3] = {image_->row<Pixel>(v - 1), image_->row<Pixel>(v), image_->row<Pixel>(v + 1)};
    if (first > 0 && first + kStrip < width_)
      return bits_of(rows[0] + first - 1, rows[1] + first - 1, rows[2] + first - 1, turn, start, slope);
    // At the border of the image: the first column has no left neighbour, the last no right one.
    std::array<std::array<Pixel, kStrip + 2>, 3> copy{};
    const int begin = std::max(first - 1, 0);
    const int end = std::min(first + kStrip + 1, width_);
    for (std::size_t r = 0; r < 3; ++r)
      std::copy(rows[r] + begin, rows[r] + end, copy[r].begin() + (begin - (first - 1)));
    const std::uint64_t all = bits_of(copy[0].data(), copy[1].data(), copy[2].data(), turn, start, slope);
    const std::uint64_t not_first = first == 0 ? ~std::uint64_t{1} : ~std::uint64_t{0};
    const int inside = width_ - 1 - first;
    return all & not_first &
           (inside >= kStrip ? ~std::uint64_t{0}
            : inside <= 0    ? 0
                             : (std::uint64_t{1} << inside) - 1);
  };
  return image_->format == PixelFormat::kGrey8 ? bits(std::uint8_t{}) : bits(std::uint16_t{});
}

}  // namespace omma
