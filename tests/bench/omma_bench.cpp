// `omma-bench NAME [options]`: measures one box; each bench is a file of its own, bench_<name>.cpp.
#include <cstdio>
#include <cstring>

#include "tests/bench/benches.hpp"
#include "tests/bench/options.hpp"

namespace {

struct Bench {
  const char* name;
  int (*run)(omma::Options& options);
  const char* what;
};

// One line a bench.
constexpr Bench kBenches[] = {
    {"acquire", omma::bench_acquire,
     "cold start, dots to attitude and pose: time, solved, wrong, error over bound, NEES"},
    {"approach", omma::bench_approach,
     "approaches through all range modes, other directions, speeds, lights: NEES, hand-overs, wrong"},
    {"attitude", omma::bench_attitude, "attitude from paired stars: time, error over bound, NEES"},
    {"axes", omma::bench_axes,
     "axes of a swung platform and their shims: error of the whole fit against a circle, NEES"},
    {"blink", omma::bench_blink, "lights told apart by their blinking codes: right, wrong, open, time"},
    {"blocked", omma::bench_blocked, "lateness of rate groups while a telemetry sink blocks for a second"},
    {"capture", omma::bench_capture,
     "three simulated cameras to disk at rising rates: frame sets kept, lost, MB/s"},
    {"extract", omma::bench_extract,
     "dots of synthetic images: time over memcpy, error over bound, NEES, recall, false dots"},
    {"filter", omma::bench_filter,
     "attitude and rate over many frame sets: error, NEES, with and without gyro"},
    {"identify", omma::bench_identify, "stars lost in space: solved, wrong, time, hypotheses"},
    {"integrity", omma::bench_integrity,
     "protection levels, tests and calibration covariance against injected faults: exceeded, alerts, NEES"},
    {"lens", omma::bench_lens, "pixel to bearing and back, each lens model: time per call"},
    {"jitter", omma::bench_jitter, "lateness of steps against a bare clock_nanosleep loop in the same run"},
    {"photographs", omma::bench_photographs,
     "omma solve on photographs others took and solved: solved, wrong, error, stars, time"},
    {"pipelines", omma::bench_pipelines,
     "the extractor beside the classical pipelines on rendered frames: found, missed, false, time"},
    {"ports", omma::bench_ports, "moving a message within and between rate groups"},
    {"pose", omma::bench_pose,
     "pose from paired targets, warm and cold: time, error over bound, NEES, failures"},
    {"real_sky", omma::bench_real_sky,
     "the simulator beside a real photograph: stars found, brightness, width of the spots"},
    {"render", omma::bench_render, "the simulator: frame sets a second, one thread, no files"},
    {"rig_calibration", omma::bench_rig_calibration,
     "a rig calibrated on cards: error of one adjustment against one image a camera, NEES"},
    {"steps", omma::bench_steps, "what the scheduler adds to an empty step"},
    {"target_identification", omma::bench_target_identification,
     "targets from an unlabelled cloud of dots: solved, wrong, left open, time"},
    {"track", omma::bench_track,
     "tracking at 10 deg/s and at the limit; identities over ten minutes with card, planets and objects"},
};

}  // namespace

int main(int argc, char** argv) {
  for (const Bench& bench : kBenches)
    if (argc > 1 && std::strcmp(argv[1], bench.name) == 0) {
      omma::Options options(bench.name, bench.what, argc - 1, argv + 1);
      return omma::Options::run(bench.run, options);
    }
  if (argc > 1 && argv[1][0] != '-') std::fprintf(stderr, "omma-bench: no bench is called '%s'\n", argv[1]);
  std::fprintf(stderr, "usage: omma-bench NAME [options]; omma-bench NAME --help tells them\n");
  for (const Bench& bench : kBenches) std::fprintf(stderr, "  %-24s %s\n", bench.name, bench.what);
  return 2;
}
