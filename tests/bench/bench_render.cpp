// omma-bench render: frame sets a second that the simulator draws and reads out, files not written: camera by
// camera on one thread, and whole sets on one and on two workers, by the clock on the wall and by processor
// time.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "ground/simulate/frame_set_renderer.hpp"
#include "sim/camera_renderer.hpp"
#include "sim/scenario_file.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

/// Drawing, truth and read-out of one camera's frame [µs of this thread].
double frame_microseconds(sim::CameraRenderer& renderer, bool deep, std::uint64_t frame,
                          std::vector<std::uint16_t>& grey, std::vector<sim::SpotTruth>& truth) {
  return microseconds([&] {
    renderer.draw(frame);
    renderer.truth(truth);
    if (deep) {
      renderer.read_out(std::span<std::uint16_t>(grey));
    } else {
      renderer.read_out({reinterpret_cast<std::uint8_t*>(grey.data()), grey.size()});
    }
  });
}

/// One camera's frames, on this thread. @return median time of a frame [µs]
double print_camera(const sim::Scenario& scenario, std::span<const SkyStar> stars, std::size_t c,
                    int frames) {
  const sim::CameraView view(scenario.rig.cameras[c], scenario.sensors[c], scenario.seed,
                             static_cast<int>(c));
  sim::CameraRenderer renderer(scenario, stars, view, static_cast<int>(c));
  std::vector<std::uint16_t> grey(static_cast<std::size_t>(view.width()) *
                                  static_cast<std::size_t>(view.height()));
  std::vector<sim::SpotTruth> truth;
  std::vector<double> times;
  for (int frame = 0; frame < frames; ++frame)
    times.push_back(frame_microseconds(renderer, scenario.sensors[c].bits > 8,
                                       static_cast<std::uint64_t>(frame), grey, truth));
  const double median = quantile(times, 0.5);
  std::printf("%-10s %4d x %-4d %8.2f ms median %8.2f ms 95 %%\n", scenario.rig.cameras[c].name.c_str(),
              view.width(), view.height(), 1e-3 * median, 1e-3 * quantile(times, 0.95));
  return median;
}

/// Workers take frame sets in turn, as `omma simulate` has them.
void print_workers(const sim::Scenario& scenario, std::span<const SkyStar> stars, int frames, int workers) {
  const std::vector<sim::CameraView> views = ground::views_of(scenario);
  std::atomic<int> next{0};
  std::array<double, 2> cpu{};  // of each worker, of two at most
  const auto work = [&](std::size_t worker) {
    cpu[worker] = microseconds([&] {
      ground::FrameSetRenderer renderer(scenario, stars, views);
      for (int frame = next++; frame < frames; frame = next++) {
        renderer.draw(static_cast<std::uint64_t>(frame));
        for (std::size_t c = 0; c < views.size(); ++c) renderer.image(c);
        renderer.truth();
      }
    });
  };
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> pool;
    for (int i = 1; i < workers; ++i) pool.emplace_back(work, static_cast<std::size_t>(i));
    work(0);
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double total = 0;
  for (const double one : cpu) total += 1e-6 * one;
  std::printf("%d worker%s  %6.1f sets/s by the wall (%.2f processors), %6.1f sets/s a processor\n", workers,
              workers == 1 ? " " : "s", frames / wall, total / wall, frames / total);
}

}  // namespace

int bench_render(Options& options) {
  std::string file = OMMA_SOURCE_DIR "/config/demo_scenario.toml";
  int frames = 40;
  options.add("--scenario", file, "what is drawn");
  options.add("--frames", frames, "frame sets");
  options.read();
  const sim::Scenario scenario = sim::read_scenario_file(file);
  const std::vector<SkyStar> stars = sim::sky_of(scenario);
  std::printf("%s: %zu cameras, %zu stars to V %.1f, %d frame sets, one thread\n", scenario.name.c_str(),
              scenario.rig.cameras.size(), stars.size(), scenario.faintest, frames);
  double set = 0;
  for (std::size_t c = 0; c < scenario.rig.cameras.size(); ++c)
    set += print_camera(scenario, stars, c, frames);
  std::printf("frame set %24.2f ms: %.1f sets/s a thread\n", 1e-3 * set, 1e6 / set);
  for (const int workers : {1, 2}) print_workers(scenario, stars, frames, workers);
  return 0;
}

}  // namespace omma
