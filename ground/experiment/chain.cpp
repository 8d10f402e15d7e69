#include "ground/experiment/chain.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "fsw/kernel/input_error.hpp"
#include "ground/page/page.hpp"
#include "ground/simulate/render_recording.hpp"
#include "hal/recorded/recorded_camera.hpp"

namespace omma::ground {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What OMMA_LAUNCHER puts before the flight program: an emulator, or `taskset -c 1`.
std::vector<std::string> launcher() {
  const char* words = std::getenv("OMMA_LAUNCHER");
  std::istringstream stream(words == nullptr ? "" : words);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Runs the flight program with its output in a file; its exit code.
int spawn_flight(std::vector<std::string> arguments, const std::string& output) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error(arguments[0] + ": cannot be started");
  int status = 0;
  if (waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Flies the frames of the run; its log is read.
void fly(ChainRun& run, const std::filesystem::path& mission, const std::filesystem::path& folder) {
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "omma-fsw";
  run.log_file = folder / "flight.mcap";
  const std::string words = (folder / "flight.txt").string();
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::string> command = launcher();
  command.insert(command.end(), {program.string(), mission.string(), "--no-dds", "--frames",
                                 run.frames.string(), "--log", run.log_file.string()});
  const int code = spawn_flight(std::move(command), words);
  run.flight_seconds = seconds_since(start);
  if (code != 0) {
    throw std::runtime_error(program.string() + " ended with exit code " + std::to_string(code) + ", see " +
                             words);
  }
  run.log = read_flight_log(run.log_file.string());
  const std::filesystem::path timing = folder / "flight.timing.mcap";
  if (std::filesystem::exists(timing)) run.times = read_times(timing.string());
}

void judge_by_truth_file(ChainRun& run) {
  run.truth = read_truth(run.frames / "truth.jsonl", static_cast<int>(run.mission.rig.cameras.size()));
  run.evaluation = evaluate(run.mission, run.truth, run.log, run.log_file.string());
}

template <class Samples>
void keep_frames_of(const std::set<std::uint64_t>& frames, Samples& samples) {
  std::erase_if(samples, [&](const auto& sample) { return !frames.contains(sample.frame); });
}

}  // namespace

std::string Reference::note() const {
  std::string text = recorded ? "Frames are recorded." : "Frames are rendered.";
  if (knows_spots)
    return text +
           " The bound counts the spots whose signal-to-noise ratio reaches the flight extractor's "
           "threshold.";
  return text + " No truth is known: errors are against " + escaped(name) +
         ", and the estimate's own standard deviation stands where the bound would.";
}

std::string Reference::pairs_text(const char* heading, const PairCheck& pairs) const {
  if (!knows_spots) return format("%s%zu, not judged\n", heading, pairs.unknown);
  return format("%s%zu right, %zu wrong, %zu too faint to judge\n", heading, pairs.right, pairs.wrong,
                pairs.unknown);
}

ChainRun run_chain(const sim::Scenario& scenario, const std::filesystem::path& mission,
                   const std::filesystem::path& folder, int threads) {
  ChainRun run;
  run.mission = read_flown_mission(mission);
  run.frames = folder / "frames";
  const auto start = std::chrono::steady_clock::now();
  render_recording(scenario, run.frames, threads);
  run.render_seconds = seconds_since(start);
  fly(run, mission, folder);
  judge_by_truth_file(run);
  return run;
}

ChainRun fly_recording(const std::filesystem::path& frames, const std::filesystem::path& mission,
                       const std::filesystem::path& folder) {
  ChainRun run;
  run.mission = read_flown_mission(mission);
  run.reference.recorded = true;
  run.frames = frames;
  for (const RigCamera& camera : run.mission.rig.cameras) {  // told before a minute of flight
    const std::string name(camera.name.view());
    find_frame_files(frames / name, name);
  }
  fly(run, mission, folder);
  if (std::filesystem::exists(frames / "truth.jsonl")) judge_by_truth_file(run);
  return run;
}

void judge_by(ChainRun& run, std::vector<TruthFrame> truth, const std::string& name) {
  if (truth.size() < 3)
    throw InputError(name, 0, "time", "at least three frame sets of the recording",
                     std::to_string(truth.size()));
  std::set<std::uint64_t> frames;
  for (const TruthFrame& frame : truth) frames.insert(frame.frame);
  FlightLog log = run.log;
  keep_frames_of(frames, log.attitudes);
  keep_frames_of(frames, log.poses);
  run.truth = std::move(truth);
  run.reference.name = name;
  run.reference.knows_spots = false;
  run.evaluation = evaluate(run.mission, run.truth, log, run.log_file.string(), BoundFrom::kEstimate);
}

void remove_frames(const std::filesystem::path& folder, const Rig& rig) {
  for (const RigCamera& camera : rig.cameras)
    std::filesystem::remove_all(folder / "frames" / std::string(camera.name.view()));
}

}  // namespace omma::ground
