// The benches of omma-bench. Each declares its options, prints a table and returns the exit code: 1 where an
// answer was wrong.
#pragma once

namespace omma {

class Options;

int bench_acquire(Options& options);
int bench_approach(Options& options);
int bench_attitude(Options& options);
int bench_axes(Options& options);
int bench_blink(Options& options);
int bench_blocked(Options& options);
int bench_capture(Options& options);
int bench_extract(Options& options);
int bench_filter(Options& options);
int bench_identify(Options& options);
int bench_integrity(Options& options);
int bench_lens(Options& options);
int bench_jitter(Options& options);
int bench_photographs(Options& options);
int bench_pipelines(Options& options);
int bench_ports(Options& options);
int bench_pose(Options& options);
int bench_real_sky(Options& options);
int bench_render(Options& options);
int bench_rig_calibration(Options& options);
int bench_steps(Options& options);
int bench_target_identification(Options& options);
int bench_track(Options& options);

}  // namespace omma
