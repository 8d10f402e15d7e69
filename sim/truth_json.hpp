// The truth and the scenario as JSON: what a report reads beside the frames. Fields in
// docs/algorithms/simulation.md#files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/scenario.hpp"
#include "sim/spot_truth.hpp"

namespace omma::sim {

/// Exposure midpoint of a frame, since the first one [ns].
std::int64_t time_ns_of(const Scenario& scenario, std::uint64_t frame);
/// The same as UTC, "2026-03-21T06:00:00.100000Z".
std::string utc_of(const Scenario& scenario, std::uint64_t frame);

/// One line (without its end) for one frame set; `spots` holds one list a camera.
std::string truth_line(const Scenario& scenario, std::uint64_t frame,
                       std::span<const std::vector<SpotTruth>> spots);

/// What the recording was made from, as one indented object. File names are those in the recording's folder.
/// @param lens_files    one a camera
/// @param target_files  one a card
std::string scenario_json(const Scenario& scenario, std::span<const std::string> lens_files,
                          std::span<const std::string> target_files);

}  // namespace omma::sim
