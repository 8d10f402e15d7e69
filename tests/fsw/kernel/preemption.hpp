// A machine with fixed-priority preemption, simulated one unit of time after the other: what the
// response-time analysis promises is held against what then happens.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace omma::testing {

/// A rate group to the machine: jobs that its threads take one after the other; done when all are.
struct SimulatedGroup {
  int period = 1;
  int offset = 0;
  int priority = 1;
  int core = -1;  ///< of the group's own thread; −1: any
  int threads = 1;
  std::vector<int> jobs;
};

/// List scheduling on `threads` undisturbed processors.
inline int makespan(const SimulatedGroup& group) {
  std::vector<int> ends(static_cast<std::size_t>(group.threads), 0);
  for (const int job : group.jobs) *std::min_element(ends.begin(), ends.end()) += job;
  return *std::max_element(ends.begin(), ends.end());
}

/// Longest time from release to done of each group; twice its period where a beat did not finish.
inline std::vector<int> longest_responses(const std::vector<SimulatedGroup>& groups, int processors,
                                          int duration, std::mt19937_64& random) {
  struct Thread {
    std::size_t group;
    int core;
    int left = 0;  // of the job it holds
  };
  struct Beat {
    int released = -1;
    std::size_t next_job = 0;
    bool open = false;
  };
  std::vector<Thread> threads;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int i = 0; i < groups[g].threads; ++i) threads.push_back({g, i == 0 ? groups[g].core : -1});
  // By priority; of equals those tied to a core first, then in the table's order.
  std::stable_sort(threads.begin(), threads.end(), [&](const Thread& a, const Thread& b) {
    const int pa = groups[a.group].priority, pb = groups[b.group].priority;
    return pa != pb ? pa > pb : (a.core >= 0) > (b.core >= 0);
  });
  std::vector<Beat> beats(groups.size());
  std::vector<int> longest(groups.size(), 0);
  for (int now = 0; now < duration; ++now) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (now < groups[g].offset || (now - groups[g].offset) % groups[g].period != 0) continue;
      if (beats[g].open) longest[g] = 2 * groups[g].period;  // overrun: the rest of the run says nothing
      beats[g] = {now, 0, true};
    }
    std::vector<bool> busy(static_cast<std::size_t>(processors), false);
    for (Thread& thread : threads) {
      Beat& beat = beats[thread.group];
      const std::vector<int>& jobs = groups[thread.group].jobs;
      if (!beat.open || (thread.left == 0 && beat.next_job == jobs.size())) continue;
      std::vector<std::size_t> free;
      for (std::size_t core = 0; core < busy.size(); ++core)
        if (!busy[core] && (thread.core < 0 || thread.core == static_cast<int>(core))) free.push_back(core);
      if (free.empty()) continue;
      busy[free[random() % free.size()]] = true;
      if (thread.left == 0) thread.left = jobs[beat.next_job++];
      --thread.left;
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto works = [&](const Thread& thread) { return thread.group == g && thread.left > 0; };
      if (!beats[g].open || beats[g].next_job < groups[g].jobs.size() ||
          std::any_of(threads.begin(), threads.end(), works))
        continue;
      beats[g].open = false;
      longest[g] = std::max(longest[g], now + 1 - beats[g].released);
    }
  }
  return longest;
}

}  // namespace omma::testing
