// The monitor's table as lines of text, the same for the terminal and for scripts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ground/monitor/newest_samples.hpp"

namespace omma::ground {

enum class LineStyle : std::uint8_t {
  kPlain,
  kHeading,
  kGood,
  kWarning,
  kBad,
  kStale,  ///< nothing new has come for kStaleAfter: never shown as good
};

struct TableLine {
  std::string text;
  LineStyle style = LineStyle::kPlain;
};

inline constexpr double kStaleAfter = 3.0;  // [s]

/// What is known of the link.
struct LinkState {
  std::string spacecraft;  ///< empty: none heard yet
  int domain = 0;
  std::uint64_t lost = 0;  ///< samples, all topics
};

std::vector<TableLine> monitor_table(const NewestSamples& samples, const LinkState& link,
                                     SteadyClock::time_point now);

}  // namespace omma::ground
