// The benches of omma-bench. Each prints a table and returns 0, or 2 for an option it does not know.
#pragma once

namespace omma {

int bench_acquire(int argc, char** argv);
int bench_approach(int argc, char** argv);
int bench_attitude(int argc, char** argv);
int bench_axes(int argc, char** argv);
int bench_blink(int argc, char** argv);
int bench_blocked(int argc, char** argv);
int bench_capture(int argc, char** argv);
int bench_extract(int argc, char** argv);
int bench_extract_frames(const char* folder, int argc, char** argv);  // omma-bench extract --frames
int bench_filter(int argc, char** argv);
int bench_identify(int argc, char** argv);
int bench_integrity(int argc, char** argv);
int bench_lens(int argc, char** argv);
int bench_jitter(int argc, char** argv);
int bench_photographs(int argc, char** argv);
int bench_pipelines(int argc, char** argv);
int bench_ports(int argc, char** argv);
int bench_pose(int argc, char** argv);
int bench_real_sky(int argc, char** argv);
int bench_render(int argc, char** argv);
int bench_rig_calibration(int argc, char** argv);
int bench_steps(int argc, char** argv);
int bench_target_identification(int argc, char** argv);
int bench_track(int argc, char** argv);

}  // namespace omma
