// Flight recorder: what every rate group did lately, always on. Each group's thread writes its steps, its
// lateness and its slips into a ring of its own, of fixed size, from the stamps the scheduler takes anyway:
// no clock is read, nothing is allocated, no one waits. So does each worker that shares a step, with its
// jobs. Events are kept by the event service (Events::history). To be looked at, the rings are copied out by
// an ordinary thread (trace_dump.hpp).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fsw/kernel/history_ring.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/schedule_observer.hpp"
#include "fsw/kernel/worker_pool.hpp"

namespace omma {

enum class TraceKind : std::uint8_t {
  kBeat,       ///< a beat began: due at `start_ns`, late by `duration_ns`
  kStep,       ///< a component's step, from begin to end
  kMissed,     ///< `value` beats were missed, the first due at `start_ns`
  kBreach,     ///< the step before broke its budget of `duration_ns`
  kReaction,   ///< `value`: which BreachReaction
  kRecovered,  ///< `value`: the level to which it is degraded from now on
  kJob,        ///< a job of a shared step, from begin to end: number `value`
};

/// Four whole words, so that it is put together in registers: the last holds what is short.
struct TraceRecord {
  TimeNs start_ns = 0;  ///< on the stopwatch
  TimeNs duration_ns = 0;
  std::uint64_t tick = 0;
  std::uint64_t packed = 0;

  /// @param position  of the component in its group
  /// @param value     as the kind says; of a step: 1 when it was pre-empted or waited
  static constexpr std::uint64_t pack(TraceKind kind, std::uint16_t position, std::uint32_t value) {
    return static_cast<std::uint64_t>(value) << 32 | static_cast<std::uint64_t>(position) << 8 |
           static_cast<std::uint64_t>(kind);
  }
  constexpr TraceKind kind() const { return static_cast<TraceKind>(packed & 0xff); }
  constexpr std::uint16_t position() const { return static_cast<std::uint16_t>(packed >> 8); }
  constexpr std::uint32_t value() const { return static_cast<std::uint32_t>(packed >> 32); }
};

class FlightRecorder final : public ScheduleObserver, public JobObserver {
 public:
  /// A beat of n components takes n + 1 records: 4096 are 45 s of the vision chain at 10 Hz, or 2 s of one
  /// component at 1 kHz; 40 bytes each.
  static constexpr std::size_t kRecords = 4096;
  using Ring = HistoryRing<TraceRecord, Writers::kOne>;

  struct Group {
    Group(const RateGroup& group, std::size_t records);

    std::string name;
    std::vector<std::string> components;
    Ring ring;
  };

  /// Allocates all rings.
  /// @param lockstep  time waits: then beats are never late, and their instants are not the stopwatch's
  /// @param workers   that share steps, the caller included; 0: no pool is observed
  FlightRecorder(const RateGroupTable& table, bool lockstep, int workers = 0, std::size_t records = kRecords);

  /// In the table's order; to be read from any thread.
  const std::vector<std::unique_ptr<Group>>& groups() const { return groups_; }
  /// Of each worker, the caller first.
  const std::vector<std::unique_ptr<Ring>>& workers() const { return workers_; }
  /// Times that beats were missed, all groups: a slip is worth looking at.
  std::uint64_t slips() const noexcept { return slips_.load(std::memory_order_relaxed); }

  void beat_started(std::uint16_t group, const Tick& tick, TimeNs latency_ns) noexcept override;
  void component_stepped(SchedulePlace place, const Tick& tick, const StepTime& time) noexcept override;
  void over_budget(SchedulePlace place, const Tick& tick, const StepTime& time,
                   TimeNs budget_ns) noexcept override;
  void budget_reaction(SchedulePlace place, const Tick& tick, BreachReaction reaction,
                       int level) noexcept override;
  void budget_recovered(SchedulePlace place, const Tick& tick, int level) noexcept override;
  void missed(std::uint16_t group, const Tick& first, std::uint64_t count) noexcept override;
  void job_done(int worker, int job, TimeNs start_ns, TimeNs wall_ns) noexcept override;

 private:
  void mark(SchedulePlace place, const Tick& tick, TimeNs duration_ns, TraceKind kind,
            std::uint32_t value) noexcept;

  const bool lockstep_;
  std::vector<std::unique_ptr<Group>> groups_;
  std::vector<std::unique_ptr<Ring>> workers_;
  std::vector<TimeNs> step_end_ns_;  // of each group's newest step: when its consequences are drawn
  std::atomic<std::uint64_t> slips_{0};
};

}  // namespace omma
