// Several observers of one scheduler, told one after the other in the order they were added.
#pragma once

#include <initializer_list>

#include "fsw/kernel/schedule_observer.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

class ScheduleObservers final : public ScheduleObserver {
 public:
  static constexpr std::size_t kMost = 8;

  /// At most kMost; they outlive the scheduler.
  ScheduleObservers(std::initializer_list<ScheduleObserver*> observers) {
    for (ScheduleObserver* observer : observers) observers_.push_back(observer);
  }

  void beat_started(std::uint16_t group, const Tick& tick, TimeNs latency_ns) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->beat_started(group, tick, latency_ns);
  }
  void component_stepped(SchedulePlace place, const Tick& tick, const StepTime& time) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->component_stepped(place, tick, time);
  }
  void beat_finished(std::uint16_t group, const Tick& tick) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->beat_finished(group, tick);
  }
  void over_budget(SchedulePlace place, const Tick& tick, const StepTime& time,
                   TimeNs budget_ns) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->over_budget(place, tick, time, budget_ns);
  }
  void budget_reaction(SchedulePlace place, const Tick& tick, BreachReaction reaction,
                       int level) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->budget_reaction(place, tick, reaction, level);
  }
  void budget_recovered(SchedulePlace place, const Tick& tick, int level) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->budget_recovered(place, tick, level);
  }
  void missed(std::uint16_t group, const Tick& first, std::uint64_t count) noexcept override {
    for (ScheduleObserver* observer : observers_) observer->missed(group, first, count);
  }

 private:
  StaticVector<ScheduleObserver*, kMost> observers_;
};

}  // namespace omma
