// Blinking codes: lights that say which they are by a cyclic pattern of on and off, one bit a frame. Codes
// differ in several bits whatever the phase, and no light is dark twice in a row, so that it can be followed.
// docs/algorithms/blink_codes.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "components/catalogue/blink_word.hpp"

namespace omma {

/// Cyclic words of `length` bits.
struct BlinkCodes {
  int length = 0;
  std::vector<std::uint32_t> words;  ///< bit n: lit in frame n of the cycle
};

/// As many codes as asked for, or as there are: any two, and any code and its own turned by a phase, differ
/// in at least `distance` bits; no two dark bits follow each other; each is dark at least twice. The first
/// found in ascending order, each turned by one phase more so that not many are dark at once: the same every
/// time. Start-up only.
/// @param length  8 to 20
BlinkCodes make_blink_codes(int count, int length, int distance);

/// What was seen of one light: bit n belongs to the frame n frames before the newest.
struct BlinkHistory {
  std::uint64_t lit = 0;
  std::uint64_t known = 0;  ///< frames that were lost are not
};

struct BlinkDecoderOptions {
  double missed = 0.03;       ///< probability that a lit light is not found
  double false_light = 0.02;  ///< probability that a dot is found where the light is dark
  double lights_part = 0.2;   ///< of all tracks that are coded lights, before anything is known
  double least_odds = 1e4;    ///< for an identity to be told
};

struct BlinkIdentity {
  int code = -1;           ///< index in the codes; −1: none, or not known yet
  double probability = 0;  ///< of the likeliest code
};

/// Which code each light sends. All lights of a body blink in step, at a phase unknown: what all of them say
/// about it counts for each. A light that is steady, or flickers at random, is none.
class BlinkDecoder {
 public:
  explicit BlinkDecoder(BlinkCodes codes, const BlinkDecoderOptions& options = {});

  /// @param histories  of the lights of one body, and of others
  /// @param out        as long; `code` −1 where the odds are too low, or another light has the same code with
  ///                   better ones
  /// @return phase: the frame of the cycle that the newest frame is; −1 without lights
  int decode(std::span<const BlinkHistory> histories, std::span<BlinkIdentity> out) const noexcept;

  const BlinkCodes& codes() const { return codes_; }
  static constexpr std::size_t kMostCodes = 64;

 private:
  /// ln of the probability of what was seen if `pattern` was sent.
  double log_likelihood(const BlinkHistory& seen, std::uint64_t pattern) const noexcept;
  double log_other(const BlinkHistory& seen) const noexcept;
  bool still_sent(const BlinkHistory& seen, std::size_t code, int phase) const noexcept;
  /// Pattern of 64 frames whose newest is frame `phase` of the cycle.
  std::uint64_t pattern(std::size_t code, int phase) const noexcept {
    return patterns_[code * static_cast<std::size_t>(codes_.length) + static_cast<std::size_t>(phase)];
  }

  BlinkCodes codes_;
  BlinkDecoderOptions options_;
  std::vector<std::uint64_t> patterns_;
  double log_missed_, log_found_, log_false_, log_dark_, log_code_prior_, log_other_prior_;
};

}  // namespace omma
