// Which of the dots found are handed over: the best by signal-to-noise ratio where a list does not hold them
// all, brightest first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/extractor/dot.hpp"
#include "components/extractor/falling_order.hpp"

namespace omma {

class BestDots {
 public:
  /// Of at most so many, below 65 536; nothing is allocated later.
  explicit BestDots(std::size_t most);

  /// Ties in the order in which they are given.
  /// @param overflow  what was dropped before
  /// @param list      its dots and the count of those dropped are set
  void hand_over(std::span<const Dot> found, std::uint32_t overflow, DotList& list) noexcept;

 private:
  std::vector<Ranked> ranking_, scratch_;
};

}  // namespace omma
