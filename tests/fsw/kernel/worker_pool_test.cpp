// The pool does each job once, whoever does it, and gives the same result for any number of workers.
#include "fsw/kernel/worker_pool.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <set>

namespace omma {
namespace {

std::array<double, 6> work_with(int workers, int batches) {
  WorkerPool pool(workers);
  std::array<double, 6> sums{};
  for (int batch = 0; batch < batches; ++batch) {
    pool.run(6, [&](int job) {
      for (int i = 1; i < 200; ++i) sums[static_cast<std::size_t>(job)] += 1.0 / (i + job + batch);
    });
  }
  return sums;
}

TEST(WorkerPool, ResultDoesNotDependOnTheNumberOfWorkers) {
  const auto alone = work_with(1, 500);
  for (const int workers : {2, 3, 4, 8}) EXPECT_EQ(work_with(workers, 500), alone) << workers;
}

TEST(WorkerPool, DoesEachJobOnceInEveryOfManyBatches) {
  WorkerPool pool(3);
  for (int batch = 0; batch < 20000; ++batch) {
    const int jobs = batch % 9;
    std::array<std::atomic<int>, 9> done{};
    pool.run(jobs, [&](int job) { done[static_cast<std::size_t>(job)].fetch_add(1); });
    for (int job = 0; job < 9; ++job)
      ASSERT_EQ(done[static_cast<std::size_t>(job)].load(), job < jobs ? 1 : 0) << batch;
  }
}

TEST(WorkerPool, OneWorkerIsTheCaller) {
  WorkerPool pool(1);
  EXPECT_EQ(pool.workers(), 1);
  std::set<std::thread::id> threads;
  pool.run(10, [&](int) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST(WorkerPool, WhatTheJobsWroteIsVisibleToTheCaller) {
  WorkerPool pool(4);
  std::array<int, 1000> values{};
  for (int batch = 1; batch < 300; ++batch) {
    pool.run(static_cast<int>(values.size()),
             [&](int job) { values[static_cast<std::size_t>(job)] += batch; });
    ASSERT_EQ(std::accumulate(values.begin(), values.end(), 0), 1000 * batch * (batch + 1) / 2);
  }
}

TEST(WorkerPool, SaysSoWhenAWorkerIsNotTiedToItsCore) {
  const WorkerPool pool(2, 0, {1000});
  ASSERT_EQ(pool.refusals().size(), 1U);
  EXPECT_EQ(pool.refusals()[0], "worker 1 is not tied to core 1000: Invalid argument.");
}

}  // namespace
}  // namespace omma
