// What every solver promises, measured: the same bits from the same input, no allocation, no more iterations
// than the stated cap.
#pragma once

#include <cstdio>
#include <cstring>
#include <span>
#include <vector>

#include "components/estimation/solution.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"

namespace omma {

inline constexpr int kRepeats = 1000;

inline std::vector<double> numbers_of(const AttitudeSolution& s) {
  const Eigen::Vector4d q = s.rig_from_j2000.coeffs();
  std::vector<double> numbers(q.begin(), q.end());
  numbers.insert(numbers.end(), s.covariance.data(), s.covariance.data() + 9);
  numbers.insert(numbers.end(), {s.chi2, s.residual_rms, double(s.pairs), double(s.iterations)});
  return numbers;
}

inline std::vector<double> numbers_of(const PoseSolution& s) {
  std::vector<double> numbers;
  for (const Pose& pose : {s.rig_from_body, s.alternative}) {
    const Eigen::Vector4d q = pose.rotation.coeffs();
    numbers.insert(numbers.end(), q.begin(), q.end());
    numbers.insert(numbers.end(), pose.translation.begin(), pose.translation.end());
  }
  numbers.insert(numbers.end(), s.covariance.data(), s.covariance.data() + 36);
  numbers.insert(numbers.end(), {s.chi2, s.residual_rms, s.alternative_chi2, s.alternative_probability,
                                 double(s.pairs), double(s.iterations), double(s.ambiguous)});
  return numbers;
}

/// Solves each input a thousand times and prints one line.
/// @param solve  from an index of the inputs to a solution
/// @param cap    iterations it can make at most
template <class Solve>
void print_repeats(const char* name, std::size_t inputs, int cap, Solve&& solve) {
  std::size_t different = 0;
  int most_iterations = 0;
  const memory_guard::Violations before = memory_guard::violations();
  for (std::size_t input = 0; input < inputs; ++input) {
    std::vector<double> first;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
      auto solution = [&] {
        const RealTimeScope scope;
        return solve(input);
      }();
      most_iterations = std::max<int>(most_iterations, solution.iterations);
      const std::vector<double> numbers = numbers_of(solution);
      if (repeat == 0) first = numbers;
      different += std::memcmp(first.data(), numbers.data(), first.size() * sizeof(double)) != 0 ? 1 : 0;
    }
  }
  const std::uint64_t allocations = memory_guard::violations().total() - before.total();
  std::printf("%-34s %3zu inputs x %d: %zu differ in a bit; %llu allocations%s; iterations <= %d, cap %d\n",
              name, inputs, kRepeats, different, static_cast<unsigned long long>(allocations),
              memory_guard::installed() ? "" : " (not watched)", most_iterations, cap);
}

}  // namespace omma
