// A scenario rendered while it happens, as cameras that a flight program opens by the driver "simulated".
#pragma once

#include <filesystem>

#include "sim/scenario.hpp"

namespace omma::ground {

/// Renders the scenario's frames at its rate, each written into shared memory under its camera's name; ends
/// after the last or with Ctrl-C. Exposure and gain that a reader asks for hold from the next frame set.
/// @param log  file (CSV) for frame number and exposure midpoint; may be empty
/// @throws InputError: a log that cannot be written, or cameras of that name that another program simulates
void simulate_live(const sim::Scenario& scenario, const std::filesystem::path& log);

}  // namespace omma::ground
