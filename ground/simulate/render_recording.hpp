// Renders a scenario into the folder of a recording, frame sets shared out among threads.
#pragma once

#include <filesystem>

#include "sim/scenario.hpp"

namespace omma::ground {

/// The result does not depend on the number of threads.
/// @throws InputError where the folder cannot be made or written, or holds something else than a simulation
void render_recording(const sim::Scenario& scenario, const std::filesystem::path& top, int threads);

}  // namespace omma::ground
