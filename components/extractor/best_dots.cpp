#include "components/extractor/best_dots.hpp"

#include <algorithm>

namespace omma {

BestDots::BestDots(std::size_t most) {
  ranking_.reserve(most);
  scratch_.reserve(most);
}

void BestDots::hand_over(std::span<const Dot> found, std::uint32_t overflow, DotList& list) noexcept {
  const std::size_t kept = std::min(found.size(), limits::kDotsPerCamera);
  list.dropped = static_cast<std::uint32_t>(found.size() - kept) + overflow;
  ranking_.resize(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) ranking_[i].index = static_cast<std::uint32_t>(i);
  scratch_.resize(found.size());
  const auto rank_by = [&](float Dot::*value) {
    for (Ranked& ranked : ranking_) ranked.key = falling_key(found[ranked.index].*value);
    sort_by_key(ranking_, {scratch_.data(), ranking_.size()});
  };
  if (kept < found.size()) {
    rank_by(&Dot::snr);
    ranking_.resize(kept);
  }
  rank_by(&Dot::flux);
  list.dots.clear();
  for (const Ranked& ranked : ranking_) list.dots.push_back(found[ranked.index]);
}

}  // namespace omma
