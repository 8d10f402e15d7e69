// Random numbers addressed by a counter: the number of pixel i of frame n of camera c depends on (seed, c, n,
// i) alone, never on the order of the work or on the number of threads. Source: SplitMix64 (Steele, Lea,
// Flood: Fast splittable pseudorandom number generators, OOPSLA 2014), whose state is a counter; normal
// deviates by a table of the inverse distribution (docs/algorithms/simulation.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace omma::sim {

/// SplitMix64's output function.
constexpr std::uint64_t mix64(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

/// A sequence of 64-bit numbers, read in any order.
class RandomSequence {
 public:
  RandomSequence(std::uint64_t seed, std::uint64_t stream, std::uint64_t frame)
      : origin_(mix64(mix64(mix64(seed + kStep) + stream * kStep) + frame * kStep)) {}
  std::uint64_t operator[](std::uint64_t index) const { return mix64(origin_ + (index + 1) * kStep); }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15ULL;
  std::uint64_t origin_;
};

/// Uniform in (0, 1), from the upper 53 bits.
inline double uniform(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53;
}

/// Standard normal deviates from 32 random bits: the inverse distribution function, linear between the nodes
/// of a table and exact in the two end cells; mean 0 and variance 1 of what comes out, not only of the ideal.
class NormalTable {
 public:
  NormalTable();
  float operator()(std::uint32_t bits) const {
    const std::uint32_t cell = bits >> kFractionBits;
    if (cell == 0 || cell == kCells - 1) return tail(bits);
    const auto fraction = static_cast<float>(bits & kFractionMask) * kFractionScale;
    return node_[cell] + fraction * (node_[cell + 1] - node_[cell]);
  }

 private:
  static constexpr unsigned kFractionBits = 20;
  static constexpr std::uint32_t kCells = 1U << (32U - kFractionBits);
  static constexpr std::uint32_t kFractionMask = (1U << kFractionBits) - 1U;
  static constexpr float kFractionScale = 1.0F / static_cast<float>(1U << kFractionBits);
  float tail(std::uint32_t bits) const;
  std::vector<float> node_;
  float scale_ = 1;
};

/// Inverse of the standard normal distribution function, relative error below 1e-12.
/// Source: bisection-free Newton steps on std::erfc from a rational start (Abramowitz & Stegun 26.2.23).
double inverse_normal(double probability);

/// The one table of the program.
const NormalTable& normal_table();

}  // namespace omma::sim
