// omma-bench capture: three simulated cameras of the dissertation's sizes, 1.54 million pixels a set,
// captured to disk as `omma capture` does it, at rising rates until something is lost.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "ground/capture/recorder.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/fed_camera.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

namespace fs = std::filesystem;
using ground::Recorder;
using Clock = std::chrono::steady_clock;

struct Run {
  std::uint64_t sets = 0;  ///< whole ones
  std::uint32_t lost = 0;
  double rate_hz = 0;  ///< of the slowest camera, by the stamps
  double megabytes_a_second = 0;
  double behind_s = 0;  ///< from the last frame until all is on the disk
};

Run capture(const fs::path& folder, double rate_hz, int seconds) {
  fs::remove_all(folder);
  std::list<FedCamera> cameras;
  cameras.emplace_back("hdr1", 768, 576, 12, rate_hz);
  cameras.emplace_back("cam0", 1024, 768, 8, rate_hz);
  cameras.emplace_back("cam2", 640, 480, 8, rate_hz);
  ground::CaptureStart start;
  ground::Recorders recorders;
  const auto frames = static_cast<std::uint64_t>(rate_hz * seconds);
  for (const FedCamera& camera : cameras)
    recorders.emplace_back(camera.camera(), ground::RecorderOptions{folder.string(), frames, false}, start);
  for (Recorder& recorder : recorders) recorder.start();
  for (const Recorder& recorder : recorders)
    while (!recorder.done()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Clock::time_point ended = Clock::now();
  ::sync();
  Run run{.sets = frames, .rate_hz = rate_hz * 2};
  run.behind_s = std::chrono::duration<double>(Clock::now() - ended).count();
  for (const Recorder& recorder : recorders) {
    if (!recorder.failure().empty())
      throw InputError("omma-bench capture", 0, "--folder", "a disk with room", recorder.failure());
    const CameraHealth health = recorder.health();
    run.sets = std::min(run.sets, recorder.taken());
    run.lost += health.gaps + health.damaged + health.overrun + health.losses;
    run.rate_hz = std::min(run.rate_hz, recorder.rate_hz());
    run.megabytes_a_second +=
        static_cast<double>(recorder.bytes()) * 1e-6 / (recorder.seconds() + run.behind_s);
  }
  fs::remove_all(folder);
  return run;
}

}  // namespace

int bench_capture(Options& options) {
  int seconds = 10;
  int only = 0;
  std::string disk = fs::temp_directory_path();
  options.add("--seconds", seconds, "of each rate");
  options.add("--rate", only, "that one alone [Hz]; 0: rising ones", 0);
  options.add("--folder", disk, "where to; its disk is what is measured");
  options.read();
  const fs::path folder = fs::path(disk) / ("omma-bench-capture-" + std::to_string(::getpid()));
  std::printf(
      "Three cameras, 1.54 million pixels a set (768 x 576 of 12 bits, 1024 x 768, 640 x 480), to %s\n",
      folder.parent_path().c_str());
  std::printf("     asked       kept      sets   lost    to disk   on the disk after\n");
  try {
    for (const int rate : {20, 40, 60, 80, 120}) {
      if (only > 0 && rate != 20) break;
      const Run run = capture(folder, only > 0 ? only : rate, seconds);
      std::printf("  %5d Hz   %6.2f Hz   %6llu   %4u   %5.1f MB/s   %6.2f s\n", only > 0 ? only : rate,
                  run.rate_hz, static_cast<unsigned long long>(run.sets), run.lost, run.megabytes_a_second,
                  run.behind_s);
      std::fflush(stdout);
      if (run.lost > 0) break;
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "omma-bench: %s\n", error.what());
    return 2;
  }
  return 0;
}

}  // namespace omma
