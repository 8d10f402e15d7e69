// Values of GPIO lines as the kernel itself dates them: its trace event gpio_value.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace omma::hil {

inline const std::string kTracing = "/sys/kernel/tracing";

inline bool write_to(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  return static_cast<bool>(file);
}

struct LineChange {
  double time_us = 0;
  bool high = false;
};

/// Begins a new trace of line changes, dated by CLOCK_MONOTONIC.
inline bool begin_trace() {
  return write_to(kTracing + "/trace_clock", "mono") && write_to(kTracing + "/buffer_size_kb", "4096") &&
         write_to(kTracing + "/trace", "") && write_to(kTracing + "/events/gpio/gpio_value/enable", "1");
}

/// Ends the trace: the changes that were set by a program, in order.
inline std::vector<LineChange> end_trace() {
  write_to(kTracing + "/events/gpio/gpio_value/enable", "0");
  std::vector<LineChange> changes;
  std::ifstream file(kTracing + "/trace");
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(": gpio_value: ");
    const std::size_t set = line.find(" set ");
    if (line.starts_with("#") || at == std::string::npos || set == std::string::npos) continue;
    const std::size_t start = line.rfind(' ', at) + 1;
    changes.push_back({1e6 * std::stod(line.substr(start, at - start)), line[set + 5] == '1'});
  }
  return changes;
}

/// How measured durations compare with what they should be [us].
struct Spread {
  std::size_t count = 0;
  double mean = 0;
  double least = 0;
  double most = 0;
  double worst_error = 0;
};

inline Spread spread_of(const std::vector<double>& values, double expected) {
  Spread spread{.count = values.size()};
  if (values.empty()) return spread;
  spread.least = *std::min_element(values.begin(), values.end());
  spread.most = *std::max_element(values.begin(), values.end());
  for (const double value : values) {
    spread.mean += value / static_cast<double>(values.size());
    spread.worst_error = std::max(spread.worst_error, std::abs(value - expected));
  }
  return spread;
}

inline void print(const char* what, const Spread& spread, double expected) {
  std::printf(
      "%s: %zu, expected %.0f us, mean %.2f us (error %+.2f us), %.0f to %.0f us, worst error %.0f us\n",
      what, spread.count, expected, spread.mean, spread.mean - expected, spread.least, spread.most,
      spread.worst_error);
}

}  // namespace omma::hil
