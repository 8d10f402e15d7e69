// Two recordings, topic by topic, sample by sample, byte by byte; where bytes differ, the first field that
// does.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omma::ground {

struct TopicComparison {
  std::string topic;  ///< last part of its name: the spacecraft may differ
  std::uint64_t samples_a = 0;
  std::uint64_t samples_b = 0;
  std::uint64_t different = 0;  ///< samples of the same place in both whose bytes differ
  /// Of the first difference, a sentence; empty where all samples of both are the same.
  std::string first_difference;
};

/// All topics of both, by name. Throws InputError where a file is no recording or is damaged: what is missing
/// from it cannot be compared.
std::vector<TopicComparison> compare_recordings(const std::string& path_a, const std::string& path_b);

}  // namespace omma::ground
