// What benches share: a stop-watch and order statistics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <vector>

#include "fsw/kernel/memory_guard.hpp"

namespace omma {

/// This thread's processor time [µs]: what others do on a busy machine is not measured (their use of the
/// caches is).
inline double thread_microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Processor time of one call [µs], some 0.3 µs for reading the clock included.
template <class Call>
double microseconds(Call&& call) {
  const double start = thread_microseconds();
  call();
  return thread_microseconds() - start;
}

/// What the real-time stretches (RealTimeScope) of this run did to memory, by the memory guard.
inline void print_memory_touched() {
  const memory_guard::Violations found = memory_guard::violations();
  if (memory_guard::installed())
    std::printf("Allocations in steps: %llu, releases: %llu, mappings: %llu\n",
                static_cast<unsigned long long>(found.allocations),
                static_cast<unsigned long long>(found.releases),
                static_cast<unsigned long long>(found.mappings));
}

/// The value below which the fraction `q` of the samples lies.
inline double quantile(std::vector<double> samples, double q) {
  if (samples.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(q * static_cast<double>(samples.size() - 1) + 0.5);
  std::nth_element(samples.begin(), samples.begin() + k, samples.end());
  return samples[static_cast<std::size_t>(k)];
}

}  // namespace omma
