// A fixed pool for work that one step splits (the cameras of a frame set). The workers are started once; the
// calling step takes part and returns when all jobs are done. Jobs are numbered and each writes its own
// output, so the result does not depend on how many workers there are or which of them did what.
// Waking the sleeping workers, and sleeping until the last job is done, is one system call each (futex);
// nothing else here leaves the program. With one worker the caller does everything and no call is made.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/real_time.hpp"

namespace omma {

/// Told of every job, on the thread that did it and inside its real-time section.
class JobObserver {
 public:
  /// @param worker    0: the caller; else number of the pool's thread
  /// @param start_ns  on the stopwatch (Clock::stopwatch)
  virtual void job_done(int worker, int job, TimeNs start_ns, TimeNs wall_ns) noexcept = 0;

 protected:
  ~JobObserver() = default;
};

class WorkerPool {
 public:
  /// @param workers   including the caller: 1 starts no thread
  /// @param priority  of the threads, best the calling rate group's: SCHED_FIFO 1 to 99, or 0
  /// @param cores     the i-th thread is tied to cores[i]; empty: to none
  explicit WorkerPool(int workers, int priority = 0, const std::vector<int>& cores = {});
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// While no job runs: from now on `observer` is told. It outlives the last job.
  void observe(JobObserver& observer) noexcept { observer_ = &observer; }

  int workers() const { return static_cast<int>(threads_.size()) + 1; }
  /// Real-time privileges that were not granted.
  const Refusals& refusals() const { return refusals_; }

  /// Calls job(0) … job(n_jobs − 1), each once, and returns when all have returned. One caller at a time; a
  /// job must not throw and must not call `run` of the same pool. At most 65535 jobs.
  template <class Job>
  void run(int n_jobs, Job&& job) noexcept {
    using Callable = std::remove_reference_t<Job>;
    static_assert(std::is_invocable_v<Callable&, int>, "a job is called with its number");
    // The trampoline is a plain function pointer: no std::function, nothing allocated.
    run_erased(
        n_jobs, [](void* context, int index) noexcept { (*static_cast<Callable*>(context))(index); },
        const_cast<void*>(static_cast<const void*>(&job)));
  }

 private:
  using Trampoline = void (*)(void*, int) noexcept;

  void run_erased(int n_jobs, Trampoline call, void* context) noexcept;
  void do_job(int worker, int job) noexcept;
  bool do_one_job(int worker) noexcept;
  void serve(int worker) noexcept;

  // The batch at hand. Written between batches, read only by who holds a job of the batch.
  Trampoline call_ = nullptr;
  void* context_ = nullptr;
  JobObserver* observer_ = nullptr;

  /// Batch number (upper 32 bits), its jobs (16), the next one to take (16), in one word: a worker late from
  /// one batch can neither take a job of the next by mistake nor look at what is being written.
  alignas(64) std::atomic<std::uint64_t> next_{0};
  alignas(64) std::atomic<std::uint32_t> batch_{0};       // workers sleep on it
  alignas(64) std::atomic<std::uint32_t> unfinished_{0};  // jobs; the caller sleeps on it
  std::atomic<bool> ending_{false};
  std::vector<std::thread> threads_;
  Refusals refusals_;
};

}  // namespace omma
