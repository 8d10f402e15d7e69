// One run of the whole chain: frames rendered with their truth, flown by the flight program as recorded
// frames, and what it found set beside the truth.
#pragma once

#include <filesystem>
#include <vector>

#include "ground/report/evaluation.hpp"
#include "sim/scenario.hpp"

namespace omma::ground {

struct ChainRun {
  FlownMission mission;
  std::vector<TruthFrame> truth;
  FlightLog log;
  Evaluation evaluation;
  std::vector<LoggedTime> times;
  double render_seconds = 0;
  double flight_seconds = 0;
};

/// Frames lie in `folder`/frames, the log in `folder`/flight.mcap, the flight program's words in
/// `folder`/flight.txt. The flight program is the `omma-fsw` beside this program.
/// @throws InputError where a file is wrong; std::runtime_error where the flight program failed
ChainRun run_chain(const sim::Scenario& scenario, const std::filesystem::path& mission,
                   const std::filesystem::path& folder, int threads);

/// The files of the frames, not the truth: a ten-minute recording is a gigabyte.
void remove_frames(const std::filesystem::path& folder, const Rig& rig);

}  // namespace omma::ground
