// The pool's threads and how they take jobs.
#include "fsw/kernel/worker_pool.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>
#include <latch>
#include <mutex>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/real_time_scope.hpp"

namespace omma {
namespace {

// The kernel call itself: std::atomic::wait would spin and yield first.
void sleep_while(const std::atomic<std::uint32_t>& word, std::uint32_t value) noexcept {
  syscall(SYS_futex, &word, FUTEX_WAIT_PRIVATE, value, nullptr, nullptr, 0);
}

void wake_all(const std::atomic<std::uint32_t>& word) noexcept {
  syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace

WorkerPool::WorkerPool(int workers, int priority, const std::vector<int>& cores) {
  const int n_threads = workers > 1 ? workers - 1 : 0;
  std::latch ready(n_threads);
  std::mutex refusals_mutex;  // start-up only
  for (int i = 0; i < n_threads; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const int core = index < cores.size() ? cores[index] : kAnyCore;
    threads_.emplace_back([this, i, priority, core, &ready, &refusals_mutex] {
      const Refusals refused = make_thread_real_time("worker " + std::to_string(i + 1), priority, core);
      {
        const std::lock_guard lock(refusals_mutex);
        refusals_.insert(refusals_.end(), refused.begin(), refused.end());
      }
      ready.count_down();
      serve(i + 1);
    });
  }
  ready.wait();
}

WorkerPool::~WorkerPool() {
  ending_.store(true, std::memory_order_relaxed);
  batch_.fetch_add(1, std::memory_order_release);
  wake_all(batch_);
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::run_erased(int n_jobs, Trampoline call, void* context) noexcept {
  if (n_jobs <= 0) return;
  if (threads_.empty() || n_jobs == 1) {
    call_ = call;
    context_ = context;
    for (int i = 0; i < n_jobs; ++i) do_job(0, i);
    return;
  }
  call_ = call;
  context_ = context;
  unfinished_.store(static_cast<std::uint32_t>(n_jobs), std::memory_order_relaxed);
  const std::uint32_t batch = batch_.load(std::memory_order_relaxed) + 1;
  next_.store(std::uint64_t{batch} << 32 | static_cast<std::uint64_t>(n_jobs) << 16,
              std::memory_order_release);
  batch_.store(batch, std::memory_order_release);
  wake_all(batch_);
  while (do_one_job(0)) {
  }
  for (std::uint32_t left = unfinished_.load(std::memory_order_acquire); left != 0;
       left = unfinished_.load(std::memory_order_acquire))
    sleep_while(unfinished_, left);
}

void WorkerPool::do_job(int worker, int job) noexcept {
  if (observer_ == nullptr) {
    call_(context_, job);
    return;
  }
  MonotonicClock clock;
  const TimeNs start = clock.stopwatch();
  call_(context_, job);
  observer_->job_done(worker, job, start, elapsed(start, clock.stopwatch()));
}

bool WorkerPool::do_one_job(int worker) noexcept {
  constexpr std::uint64_t kLow = 0xffff;
  std::uint64_t seen = next_.load(std::memory_order_acquire);
  do {
    if ((seen & kLow) >= (seen >> 16 & kLow)) return false;
  } while (
      !next_.compare_exchange_weak(seen, seen + 1, std::memory_order_acq_rel, std::memory_order_acquire));
  // The job taken keeps the batch open until it is counted off: call_ and context_ stand still.
  do_job(worker, static_cast<int>(seen & kLow));
  if (unfinished_.fetch_sub(1, std::memory_order_acq_rel) == 1) wake_all(unfinished_);
  return true;
}

void WorkerPool::serve(int worker) noexcept {
  std::uint32_t seen = 0;
  while (!ending_.load(std::memory_order_relaxed)) {
    {
      const RealTimeScope real_time;
      while (do_one_job(worker)) {
      }
    }
    const std::uint32_t batch = batch_.load(std::memory_order_acquire);
    if (batch == seen) sleep_while(batch_, seen);
    seen = batch;
  }
}

}  // namespace omma
