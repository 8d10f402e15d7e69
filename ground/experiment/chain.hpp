// One run of the whole chain: frames rendered with their truth, or recorded by a rig, flown by the flight
// program as recorded frames, and what it found set beside the truth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ground/report/evaluation.hpp"
#include "sim/scenario.hpp"

namespace omma::ground {

/// What a run was judged by.
struct Reference {
  std::string name = "the truth";
  bool recorded = false;  ///< frames of a rig or of an earlier run, not rendered now
  /// The truth tells spots: the bound is Cramér and Rao's, pairings can be judged. Else the estimate's own
  /// deviation stands in the bound's place.
  bool knows_spots = true;

  const char* bound_name() const { return knows_spots ? "bound" : "own sigma"; }
  /// Sentences for the foot of a page: where frames, truth and bound come from.
  std::string note() const;
  /// A line on the pairings: right and wrong, or how many where the truth cannot tell.
  std::string pairs_text(const char* heading, const PairCheck& pairs) const;
};

struct ChainRun {
  FlownMission mission;
  std::vector<TruthFrame> truth;  ///< empty: not known yet
  FlightLog log;
  Evaluation evaluation;
  Reference reference;
  std::vector<LoggedTime> times;
  std::filesystem::path frames;
  std::filesystem::path log_file;
  double render_seconds = 0;
  double flight_seconds = 0;
};

/// Frames lie in `folder`/frames, the log in `folder`/flight.mcap, the flight program's words in
/// `folder`/flight.txt. The flight program is the `omma-fsw` beside this program.
/// @throws InputError where a file is wrong; std::runtime_error where the flight program failed
ChainRun run_chain(const sim::Scenario& scenario, const std::filesystem::path& mission,
                   const std::filesystem::path& folder, int threads);

/// The same with recorded frames, `frames`/<camera>/<camera>_<n>.png, which stay as they are. Judged by
/// `frames`/truth.jsonl; where there is none the run has neither truth nor evaluation yet.
ChainRun fly_recording(const std::filesystem::path& frames, const std::filesystem::path& mission,
                       const std::filesystem::path& folder);

/// Judges a run by a truth that knows no spots, over the frame sets that this truth has.
/// @throws InputError where fewer than three frame sets are left
void judge_by(ChainRun& run, std::vector<TruthFrame> truth, const std::string& name);

/// The files of the frames, not the truth: a ten-minute recording is a gigabyte.
void remove_frames(const std::filesystem::path& folder, const Rig& rig);

}  // namespace omma::ground
