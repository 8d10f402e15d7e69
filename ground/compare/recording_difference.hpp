// Two recordings, topic by topic, sample by sample, byte by byte; where bytes differ, the first field that
// does. With a tolerance, numbers may differ a little: a gate against regressions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omma::ground {

/// How far numbers may differ. Texts, flags and whole numbers are to be the same, unless named.
struct Tolerance {
  /// Of a number with a fraction: part of the largest magnitude its field has in the samples compared.
  double relative = 0;
  /// "attitude.chi2" or a beginning of it ("dots."), and the largest difference allowed, in the field's unit;
  /// the longest beginning counts. Whole numbers too.
  std::vector<std::pair<std::string, double>> fields;
};

struct TopicComparison {
  std::string topic;  ///< last part of its name: the spacecraft may differ
  std::uint64_t samples_a = 0;
  std::uint64_t samples_b = 0;
  std::uint64_t different = 0;  ///< samples of the same place in both whose bytes differ, or differ too much
  std::uint64_t tolerated = 0;  ///< samples that differ within the tolerance
  std::string largest;          ///< with a tolerance: the field that comes nearest to it or exceeds it most
  /// Of the first difference, a sentence; empty where all samples of both are the same.
  std::string first_difference;
};

/// All topics of both, by name. Throws InputError where a file is no recording or is damaged: what is missing
/// from it cannot be compared.
/// @param tolerance  null: every byte is to be the same
std::vector<TopicComparison> compare_recordings(const std::string& path_a, const std::string& path_b,
                                                const Tolerance* tolerance = nullptr);

}  // namespace omma::ground
