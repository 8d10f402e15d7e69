// What the flight program prints when it ends: how long each component took per step, and the whole chain per
// frame set.
#pragma once

#include <string>

#include "fsw/kernel/scheduler.hpp"

namespace omma {

/// A table, one line a component: steps, mean, 99th percentile and longest wall time; a sum for each rate
/// group; what the memory guard counted.
std::string run_summary(const Scheduler& scheduler);

}  // namespace omma
