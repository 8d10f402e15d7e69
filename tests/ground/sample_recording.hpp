// Recordings made for the tests: a few samples of known values.
#pragma once

#include <cstddef>
#include <string>

#include "components/telemetry/cdr.hpp"
#include "components/telemetry/recording_writer.hpp"

namespace omma::test {

inline omma_Attitude attitude_sample(int i) {
  omma_Attitude sample{};
  sample.frame = static_cast<std::uint64_t>(i);
  sample.time_ns = 1'000'000'000LL + 100'000'000LL * i;
  sample.sample_number = static_cast<std::uint32_t>(i + 1);
  sample.valid = i % 5 != 4;
  sample.state = sample.valid ? omma_SOLVE_SOLVED : omma_SOLVE_TOO_FEW_PAIRS;
  sample.rig_from_j2000 = {0.0, 0.0, 0.6, 0.8};
  for (int k = 0; k < 3; ++k) sample.covariance_rad2[4 * k] = 1e-9 * (k + 1);
  sample.chi2 = 0.5 * i;
  sample.stars_used = static_cast<std::uint16_t>(20 + i);
  return sample;
}

inline omma_CameraDots dots_sample(int i, omma_Dot* dots, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    dots[k] = omma_Dot{};
    dots[k].u_px = 10.5F * static_cast<float>(k + 1);
    dots[k].v_px = 3.25F + static_cast<float>(i);
    dots[k].role = k % 2 == 0 ? omma_DOT_STAR : omma_DOT_UNPAIRED;
    dots[k].entry = static_cast<std::uint16_t>(1000 + k);
  }
  omma_CameraDots sample{};
  sample.frame = static_cast<std::uint64_t>(i);
  sample.time_ns = 1'000'000'000LL + 100'000'000LL * i;
  sample.sample_number = static_cast<std::uint32_t>(i + 1);
  sample.valid = true;
  sample.camera = 1;
  sample.dots = {count, count, dots, false};
  return sample;
}

/// Attitude and dots of `frames` frame sets.
inline void write_recording(const std::string& path, int frames, const mcap::WriterOptions& options = {}) {
  telemetry::RecordingWriter recording(path, "testsat", false, options);
  telemetry::CdrWriter cdr;
  omma_Dot dots[3];
  for (int i = 0; i < frames; ++i) {
    const omma_Attitude attitude = attitude_sample(i);
    recording.write(telemetry::TopicId::kAttitude, cdr.write(telemetry::TopicId::kAttitude, &attitude));
    const omma_CameraDots seen = dots_sample(i, dots, 3);
    recording.write(telemetry::TopicId::kDots, cdr.write(telemetry::TopicId::kDots, &seen));
  }
  recording.close();
}

}  // namespace omma::test
