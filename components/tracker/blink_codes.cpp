#include "components/tracker/blink_codes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace omma {
namespace {

double log_sum(double a, double b) {
  const double larger = std::max(a, b);
  return larger + std::log1p(std::exp(std::min(a, b) - larger));
}

}  // namespace

BlinkCodes make_blink_codes(int count, int length, int distance) {
  if (length < kFewestCodeBits || length > 20)
    throw std::invalid_argument("a blinking code has 8 to 20 bits");
  BlinkCodes codes;
  codes.length = length;
  for (std::uint32_t word = 1; word < (1U << length) && static_cast<int>(codes.words.size()) < count;
       ++word) {
    if (!can_be_followed(word, length) || least_difference(word, word, length) < distance) continue;
    const bool fits = std::all_of(codes.words.begin(), codes.words.end(), [&](std::uint32_t other) {
      return least_difference(word, other, length) >= distance;
    });
    if (!fits) continue;
    // Any phase is as good as another; the same one would let many be dark in the same frame.
    codes.words.push_back(turned(word, static_cast<int>(codes.words.size()) % length, length));
  }
  return codes;
}

BlinkDecoder::BlinkDecoder(BlinkCodes codes, const BlinkDecoderOptions& options)
    : codes_(std::move(codes)), options_(options) {
  if (codes_.words.empty() || codes_.words.size() > kMostCodes || codes_.length < 1 ||
      codes_.length > kMostCodeBits)
    throw std::invalid_argument("a decoder of blinking codes takes 1 to 64 codes of 1 to 32 bits");
  for (const std::uint32_t word : codes_.words) {
    for (int phase = 0; phase < codes_.length; ++phase) {
      std::uint64_t pattern = 0;
      for (int back = 0; back < 64; ++back) {
        const int at = ((phase - back) % codes_.length + codes_.length) % codes_.length;
        pattern |= static_cast<std::uint64_t>((word >> at) & 1U) << back;
      }
      patterns_.push_back(pattern);
    }
  }
  log_missed_ = std::log(options_.missed);
  log_found_ = std::log1p(-options_.missed);
  log_false_ = std::log(options_.false_light);
  log_dark_ = std::log1p(-options_.false_light);
  log_code_prior_ = std::log(options_.lights_part / static_cast<double>(codes_.words.size()));
  log_other_prior_ = std::log1p(-options_.lights_part);
}

double BlinkDecoder::log_likelihood(const BlinkHistory& seen, std::uint64_t pattern) const noexcept {
  const std::uint64_t on = pattern & seen.known, off = ~pattern & seen.known;
  return std::popcount(on & seen.lit) * log_found_ + std::popcount(on & ~seen.lit) * log_missed_ +
         std::popcount(off & seen.lit) * log_false_ + std::popcount(off & ~seen.lit) * log_dark_;
}

// A steady light, or one found at random half of the time.
double BlinkDecoder::log_other(const BlinkHistory& seen) const noexcept {
  const double steady = log_likelihood(seen, ~std::uint64_t{0});
  const double flicker = -std::popcount(seen.known) * std::log(2.0);
  return log_sum(steady, flicker) - std::log(2.0);
}

// A track that went over to another light has the first one's past: the last cycle must speak for the code
// too.
bool BlinkDecoder::still_sent(const BlinkHistory& seen, std::size_t code, int phase) const noexcept {
  const std::uint64_t cycle = (std::uint64_t{1} << codes_.length) - 1;
  const BlinkHistory last{seen.lit & cycle, seen.known & cycle};
  const double sent = log_likelihood(last, pattern(code, phase));
  if (sent < log_other(last)) return false;
  for (std::size_t other = 0; other < codes_.words.size(); ++other)
    if (log_likelihood(last, pattern(other, phase)) > sent) return false;
  return true;
}

int BlinkDecoder::decode(std::span<const BlinkHistory> histories,
                         std::span<BlinkIdentity> out) const noexcept {
  std::fill(out.begin(), out.end(), BlinkIdentity{});
  if (histories.empty() || out.size() < histories.size()) return -1;
  const std::size_t count = codes_.words.size();
  // What all lights say of the phase.
  std::array<double, kMostCodeBits> log_phase{};
  for (const BlinkHistory& seen : histories) {
    const double other = log_other_prior_ + log_other(seen);
    for (int phase = 0; phase < codes_.length; ++phase) {
      double sum = other;
      for (std::size_t code = 0; code < count; ++code)
        sum = log_sum(sum, log_code_prior_ + log_likelihood(seen, pattern(code, phase)));
      log_phase[static_cast<std::size_t>(phase)] += sum;
    }
  }
  const auto last = log_phase.begin() + codes_.length;
  const auto best_phase = std::max_element(log_phase.begin(), last);
  double total = *best_phase;
  for (auto phase = log_phase.begin(); phase != last; ++phase)
    if (phase != best_phase) total = log_sum(total, *phase);

  // Then each light by itself, over the phases there may be.
  for (std::size_t light = 0; light < histories.size(); ++light) {
    const BlinkHistory& seen = histories[light];
    std::array<double, kMostCodes> probability{};
    const double other = log_other_prior_ + log_other(seen);
    for (int phase = 0; phase < codes_.length; ++phase) {
      const double weight = std::exp(log_phase[static_cast<std::size_t>(phase)] - total);
      if (weight < 1e-12) continue;
      std::array<double, kMostCodes> log_each{};
      double sum = other;
      for (std::size_t code = 0; code < count; ++code) {
        log_each[code] = log_code_prior_ + log_likelihood(seen, pattern(code, phase));
        sum = log_sum(sum, log_each[code]);
      }
      for (std::size_t code = 0; code < count; ++code)
        probability[code] += weight * std::exp(log_each[code] - sum);
    }
    const auto best = std::max_element(probability.begin(), probability.begin() + static_cast<long>(count));
    out[light].probability = *best;
    const auto code = static_cast<std::size_t>(best - probability.begin());
    if (*best > options_.least_odds * (1 - *best) &&
        still_sent(seen, code, static_cast<int>(best_phase - log_phase.begin())))
      out[light].code = static_cast<int>(code);
  }
  // One light a code: the likelier keeps it.
  for (std::size_t light = 0; light < histories.size(); ++light)
    for (std::size_t rival = 0; rival < histories.size(); ++rival)
      if (rival != light && out[light].code >= 0 && out[rival].code == out[light].code &&
          (out[rival].probability > out[light].probability ||
           (out[rival].probability == out[light].probability && rival < light)))
        out[light].code = -1;
  return static_cast<int>(best_phase - log_phase.begin());
}

}  // namespace omma
