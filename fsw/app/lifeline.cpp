#include "fsw/app/lifeline.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "fsw/kernel/clock.hpp"

namespace omma {
namespace {

constexpr TimeNs kMillisecond = 1'000'000;
constexpr TimeNs kStatusPeriod = 1000 * kMillisecond;
constexpr TimeNs kLockstepPatience = 30'000 * kMillisecond;

/// A stroke may be withheld three times in a row before the shorter of the two time-outs has passed.
std::chrono::milliseconds stroke_period(const Watchdog* watchdog, const ServiceNotice& notice) {
  TimeNs shortest = 4 * kStatusPeriod;
  if (watchdog != nullptr) shortest = std::min(shortest, watchdog->timeout());
  if (notice.watchdog_ns() > 0) shortest = std::min(shortest, notice.watchdog_ns());
  return std::chrono::milliseconds(std::max<TimeNs>(10, shortest / 4 / kMillisecond));
}

}  // namespace

Lifeline::Lifeline(const Scheduler& scheduler, Events& events, std::unique_ptr<Watchdog> watchdog,
                   ServiceNotice notice, bool lockstep)
    : scheduler_(scheduler),
      events_(events),
      watchdog_(std::move(watchdog)),
      notice_(std::move(notice)),
      patience_ns_(lockstep ? kLockstepPatience
                            : stroke_period(watchdog_.get(), notice_).count() * kMillisecond),
      signs_(scheduler, patience_ns_, MonotonicClock().now()),
      chores_(stroke_period(watchdog_.get(), notice_)) {
  chores_.add([this] { serve(); });
}

void Lifeline::start() {
  if (watchdog_ != nullptr) watchdog_->stroke();
  notice_.tell("READY=1\nSTATUS=time begins");
  chores_.start();
}

std::string Lifeline::stop() {
  ending_.store(true);
  chores_.stop();
  notice_.tell("STOPPING=1");
  if (watchdog_ == nullptr || watchdog_->disarm()) return "";
  return "the watchdog cannot be disarmed and will reset the computer.";
}

void Lifeline::serve() {
  if (ending_.load()) return;
  const TimeNs now = MonotonicClock().now();
  const int sick_group = signs_.look(now);
  if (sick_group == LifeSigns::kAllWell) {
    if (watchdog_ != nullptr) watchdog_->stroke();
    if (notice_.watchdog_ns() > 0) notice_.tell("WATCHDOG=1");
  } else {
    events_.raise<kStrokeWithheld>(Tick{.number = 0, .time_ns = now}, sick_group);
  }
  if (elapsed(told_ns_, now) < kStatusPeriod && sick_group == LifeSigns::kAllWell) return;
  told_ns_ = now;
  tell_status(sick_group);
}

void Lifeline::tell_status(int sick_group) {
  std::uint64_t beats = 0;
  std::uint64_t missed = 0;
  for (std::size_t g = 0; g < scheduler_.group_count(); ++g) {
    beats += scheduler_.group(g).timing().latency.count();
    missed += scheduler_.group(g).timing().missed.load(std::memory_order_relaxed);
  }
  std::array<char, 160> text{};
  const auto count = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  if (sick_group == LifeSigns::kAllWell) {
    std::snprintf(text.data(), text.size(), "STATUS=flying: %llu beats served, %llu missed", count(beats),
                  count(missed));
  } else {
    const std::string_view name = scheduler_.group(static_cast<std::size_t>(sick_group)).group().name;
    std::snprintf(text.data(), text.size(),
                  "STATUS=rate group '%.*s' misses its deadlines: %llu beats served, %llu missed",
                  static_cast<int>(name.size()), name.data(), count(beats), count(missed));
  }
  notice_.tell(text.data());
}

}  // namespace omma
