// A scenario rendered into a folder and flown by the whole flight program, faster than time: what tests and
// benches of the chain share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "fsw/app/mission.hpp"
#include "fsw/app/topology.hpp"
#include "sim/scenario.hpp"

namespace omma {

/// A file of the repository's config folder.
std::filesystem::path config_file(const std::string& file);

/// The flight program over the mission's recording, as fast as it can.
/// @param after  called after each frame set; must not allocate
/// @return allocations and the like in the steps (fsw/kernel/memory_guard.hpp)
std::uint64_t fly_recording(const Mission& mission, int workers,
                            const std::function<void(const Topology&)>& after);

/// The scenario rendered, flown by one worker, and its frames removed.
/// @param after  called after each frame set; must not allocate
/// @return allocations and the like in the steps (fsw/kernel/memory_guard.hpp)
std::uint64_t fly_scenario(const sim::Scenario& scenario, Mission mission,
                           const std::function<void(const Topology&)>& after);

}  // namespace omma
