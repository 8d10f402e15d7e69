// What the flight program said, read from its recording: the products of every frame set, what the dots of
// each image were taken for, the pictures, and the measured times from the file beside it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "components/telemetry/topics.hpp"
#include "ground/report/chunk_pictures.hpp"

namespace omma::ground {

struct LoggedCamera {
  std::string name;
  std::uint32_t dots_found = 0;
  std::uint32_t stars_paired = 0;
  std::uint32_t targets_paired = 0;
};

struct LoggedFrameSet {
  std::uint64_t frame = 0;
  std::int64_t time_ns = 0;
  bool sky_tracked = false;
  std::vector<LoggedCamera> cameras;
};

struct LoggedTime {
  std::string component;
  double mean_ms = 0;
  double max_ms = 0;
  double budget_ms = 0;  ///< 0: none
  std::uint64_t over_budget = 0;
};

struct FlightLog {
  std::string spacecraft;
  std::vector<LoggedFrameSet> frame_sets;
  std::vector<omma_Attitude> attitudes;
  std::vector<omma_RelativePose> poses;                              ///< all bodies
  std::map<std::uint64_t, std::vector<std::vector<omma_Dot>>> dots;  ///< by frame, then by camera
  ChunkPictures pictures;
};

/// @throws InputError where the file is missing, no recording, damaged or cut off, or holds no attitude: a
/// report of a part would be taken for one of the whole
FlightLog read_flight_log(const std::string& path);

/// The last report of durations in the file, in the order of the schedule. @throws InputError as above
std::vector<LoggedTime> read_times(const std::string& path);

}  // namespace omma::ground
