#include "components/extractor/step_budget.hpp"

#include <algorithm>

namespace omma {
namespace {

// The matched extractor's, all cameras of a rig [ns].
constexpr std::int64_t kMatched = 10'000'000;

std::int64_t nanoseconds_per_pixel(ExtractorAlgorithm algorithm) {
  switch (algorithm) {
    case ExtractorAlgorithm::kMatched:
      return 0;
    case ExtractorAlgorithm::kMlas:
      return 100;
    case ExtractorAlgorithm::kSmallTarget:
      return 150;
    case ExtractorAlgorithm::kStars:
      return 500;
  }
  return 0;
}

std::int64_t search_budget(const ExtractorCamera& camera, const ExtractorParameters& search) {
  const std::int64_t images = search.polarity == DotPolarity::kBoth ? 2 : 1;
  return images * nanoseconds_per_pixel(search.algorithm) * camera.width * camera.height;
}

}  // namespace

// Whoever is free takes the next camera: no later than an even share and the longest camera.
std::chrono::nanoseconds extraction_budget(std::span<const ExtractorCamera> cameras, int threads) {
  std::int64_t sum = 0, longest = 0;
  for (const ExtractorCamera& camera : cameras) {
    std::int64_t own = search_budget(camera, camera.parameters);
    for (const ExtractorParameters& other : camera.also) own += search_budget(camera, other);
    sum += own;
    longest = std::max(longest, own);
  }
  const std::int64_t shared = threads > 1 ? std::min(sum, sum / threads + longest) : sum;
  return std::chrono::nanoseconds(kMatched + shared);
}

}  // namespace omma
