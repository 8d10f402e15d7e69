#include "ground/experiment/chain.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "ground/page/page.hpp"
#include "ground/simulate/render_recording.hpp"

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

}  // namespace

ChainRun run_chain(const sim::Scenario& scenario, const std::filesystem::path& mission,
                   const std::filesystem::path& folder, int threads) {
  ChainRun run;
  run.mission = read_flown_mission(mission);
  const std::filesystem::path frames = folder / "frames";
  auto start = std::chrono::steady_clock::now();
  render_recording(scenario, frames, threads);
  run.render_seconds = seconds_since(start);

  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "omma-fsw";
  const std::string log = (folder / "flight.mcap").string();
  const std::string words = (folder / "flight.txt").string();
  start = std::chrono::steady_clock::now();
  std::vector<std::string> command = launcher();
  command.insert(command.end(),
                 {program.string(), mission.string(), "--no-dds", "--frames", frames.string(), "--log", log});
  const int code = spawn_flight(std::move(command), words);
  run.flight_seconds = seconds_since(start);
  if (code != 0) {
    throw std::runtime_error(program.string() + " ended with exit code " + std::to_string(code) + ", see " +
                             words);
  }
  run.truth = read_truth(frames / "truth.jsonl", static_cast<int>(run.mission.rig.cameras.size()));
  run.log = read_flight_log(log);
  run.evaluation = evaluate(run.mission, run.truth, run.log, log);
  const std::filesystem::path timing = folder / "flight.timing.mcap";
  if (std::filesystem::exists(timing)) run.times = read_times(timing.string());
  return run;
}

void remove_frames(const std::filesystem::path& folder, const Rig& rig) {
  for (const RigCamera& camera : rig.cameras)
    std::filesystem::remove_all(folder / "frames" / std::string(camera.name.view()));
}

}  // namespace omma::ground
