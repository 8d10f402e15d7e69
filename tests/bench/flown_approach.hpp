// A body's approach flown by the whole flight program, each mode's bearing and range judged against the truth
// the images were drawn from.
#pragma once

#include <map>

#include "tests/bench/flown_scenario.hpp"

namespace omma {

struct OfOneMode {
  int frame_sets = 0;
  double bearing_nees = 0;  ///< sum over the frame sets; 2 is due of each
  double range_nees = 0;    ///< the same; 1 is due of each
  double worst_range = 0;   ///< part of the range
};

struct FlownApproach {
  std::map<RangeMode, OfOneMode> modes;
  int steps_back = 0;      ///< frame sets with a farther mode than the one before
  int wrong = 0;           ///< frame sets whose bearing is 10 σ and half a degree off: of something else
  double right_range = 0;  ///< from here on nothing else was followed [m]; 0: never
  double first_range = 0, intermediate_from = 0, close_from = 0;  ///< [m]; 0: never
  double last_magnitude_sigma = 0;
  std::uint64_t allocations = 0;
};

/// @param scenario  its first card is the mission's first body
FlownApproach fly_approach(const sim::Scenario& scenario, const Mission& mission);

}  // namespace omma
