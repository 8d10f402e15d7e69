#include "ground/report/flight_log.hpp"

#include <cstdio>

#include "config/limits.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/recording.hpp"

namespace omma::ground {
namespace {

void refuse_damage(const Recording& recording, const std::string& path) {
  if (!recording.damage().empty()) throw InputError(path, 0, "file", "a whole recording", recording.damage());
  if (recording.undecodable() > 0)
    throw InputError(path, 0, "file", "samples of their topics' types",
                     std::to_string(recording.undecodable()) + " that are not");
}

LoggedFrameSet logged(const omma_FrameSet& sample) {
  LoggedFrameSet set{sample.frame, sample.time_ns, sample.sky_state != omma_TRACK_LOST, {}};
  for (std::uint32_t c = 0; c < sample.cameras._length; ++c) {
    const omma_CameraStatus& camera = sample.cameras._buffer[c];
    set.cameras.push_back({camera.name, camera.dots_found, camera.stars_paired, camera.targets_paired});
  }
  return set;
}

}  // namespace

FlightLog read_flight_log(const std::string& path) {
  Recording recording(path);
  FlightLog log;
  log.attitudes = recording.all<omma_Attitude>();
  log.poses = recording.all<omma_RelativePose>();
  recording.for_each<omma_FrameSet>(
      [&](const omma_FrameSet& sample) { log.frame_sets.push_back(logged(sample)); });
  recording.for_each<omma_CameraDots>([&](const omma_CameraDots& sample) {
    if (!sample.valid || sample.camera >= limits::kCameras) return;
    std::vector<std::vector<omma_Dot>>& cameras = log.dots[sample.frame];
    if (cameras.size() <= sample.camera) cameras.resize(std::size_t{sample.camera} + 1);
    cameras[sample.camera].assign(sample.dots._buffer, sample.dots._buffer + sample.dots._length);
  });
  recording.for_each<omma_ImageChunk>([&](const omma_ImageChunk& chunk) { log.pictures.take(chunk); });
  log.spacecraft = recording.spacecraft();
  refuse_damage(recording, path);
  if (log.attitudes.empty())
    throw InputError(path, 0, "attitude", "a recording of the flight program", "no sample of it");
  return log;
}

std::vector<LoggedTime> read_times(const std::string& path) {
  Recording recording(path);
  std::vector<LoggedTime> times;
  recording.for_each<omma_Timing>([&](const omma_Timing& sample) {
    times.clear();
    for (std::uint32_t i = 0; i < sample.steps._length; ++i) {
      const omma_StepTiming& c = sample.steps._buffer[i];
      constexpr double kMs = 1e-6;
      times.push_back({c.name, kMs * static_cast<double>(c.mean_ns), kMs * static_cast<double>(c.max_ns),
                       kMs * static_cast<double>(c.budget_ns), c.over_budget});
    }
  });
  refuse_damage(recording, path);
  if (times.empty()) throw InputError(path, 0, "timing", "reports of durations", "none");
  return times;
}

}  // namespace omma::ground
