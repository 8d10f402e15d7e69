#include "tests/bench/flown_scenario.hpp"

#include <unistd.h>

#include <memory>
#include <string>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "ground/simulate/render_recording.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

class AfterEach final : public ScheduleObserver {
 public:
  AfterEach(const Topology& topology, const std::function<void(const Topology&)>& after)
      : topology_(topology), after_(after) {}
  void beat_finished(std::uint16_t group, const Tick&) noexcept override {
    if (group == 0) after_(topology_);
  }

 private:
  const Topology& topology_;
  const std::function<void(const Topology&)>& after_;
};

}  // namespace

std::filesystem::path config_file(const std::string& file) {
  return std::filesystem::path(OMMA_SOURCE_DIR) / "config" / file;
}

std::uint64_t fly_recording(const Mission& mission, int workers,
                            const std::function<void(const Topology&)>& after) {
  const auto topology = std::make_unique<Topology>(mission, RunOptions{.lockstep = true, .workers = workers});
  const std::uint64_t frame_sets = topology->frame_sets();
  LockstepClock clock;
  AfterEach observer(*topology, after);
  Scheduler scheduler(topology->table(), clock, observer);
  const memory_guard::Violations before = memory_guard::violations();
  scheduler.run(frame_sets);
  return memory_guard::violations().total() - before.total();
}

std::uint64_t fly_scenario(const sim::Scenario& scenario, Mission mission,
                           const std::function<void(const Topology&)>& after) {
  const std::filesystem::path frames =
      std::filesystem::temp_directory_path() / ("omma_" + scenario.name + "_" + std::to_string(getpid()));
  ground::render_recording(scenario, frames, 2);
  mission.recording = frames;
  const std::uint64_t allocations = fly_recording(mission, 1, after);
  std::filesystem::remove_all(frames);
  return allocations;
}

}  // namespace omma
