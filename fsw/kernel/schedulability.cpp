// Response-time analysis of the rate group table.
#include "fsw/kernel/schedulability.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <thread>

namespace omma {
namespace {

/// One thread that takes processors: a group's own, or one of those that share a component's step.
struct Thread {
  std::size_t group = 0;
  TimeNs period = 0;
  TimeNs work = 0;  // each period, at most
  int priority = 0;
  int core = kAnyCore;
};

TimeNs total_budget(const RateGroup& group) {
  TimeNs sum = 0;
  for (const ScheduledComponent& scheduled : group.components) sum += scheduled.budget.count();
  return sum;
}

int most_threads(const RateGroup& group) {
  int most = 1;
  for (const ScheduledComponent& scheduled : group.components) most = std::max(most, scheduled.threads);
  return most;
}

std::vector<Thread> threads_of(const RateGroupTable& table) {
  std::vector<Thread> threads;
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    const RateGroup& group = table.groups[g];
    if (group.priority == 0) continue;
    const TimeNs period = table.base_period.count() * group.divisor;
    threads.push_back({g, period, total_budget(group), group.priority, group.core});
    for (const ScheduledComponent& scheduled : group.components)
      for (int i = 1; i < scheduled.threads; ++i)
        threads.push_back({g, period, scheduled.budget.count(), group.priority, kAnyCore});
  }
  return threads;
}

/// The threads that may delay a group, and how much.
class Interference {
 public:
  Interference(const RateGroup& group, std::size_t index, const std::vector<Thread>& all, int processors)
      : shared_step_(most_threads(group) > 1), moves_(group.core == kAnyCore), processors_(processors) {
    for (const Thread& thread : all) {
      if (thread.group == index || thread.priority < group.priority) continue;
      const bool elsewhere = !moves_ && !shared_step_ && thread.core != kAnyCore && thread.core != group.core;
      if (processors > 1 && elsewhere) continue;
      threads_.push_back(thread);
      settled_ = settled_ && !moves_ && !shared_step_ && thread.core != kAnyCore;
    }
    settled_ = settled_ || processors == 1;
  }

  /// @param responses  of the groups so far; those not yet known stand at their period
  TimeNs within(TimeNs window, const std::vector<GroupResponse>& responses) const {
    if (moves_ && !shared_step_ && threads_.size() < static_cast<std::size_t>(processors_)) return 0;
    TimeNs sum = 0;
    for (const Thread& thread : threads_) {
      const TimeNs carried =
          settled_ ? 0 : std::max<TimeNs>(0, responses[thread.group].response_ns - thread.work);
      sum += (window + carried + thread.period - 1) / thread.period * thread.work;
    }
    return moves_ && !shared_step_ ? sum / processors_ : sum;
  }

 private:
  bool shared_step_;
  bool moves_;
  bool settled_ = true;  // nobody who delays it moves between processors: no work is carried in
  int processors_;
  std::vector<Thread> threads_;
};

std::string milliseconds(TimeNs duration) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f ms", static_cast<double>(duration) * 1e-6);
  return text.data();
}

std::string percent(double part) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0f %%", 100 * part);
  return text.data();
}

std::string fault(const RateGroup& group, const GroupResponse& found, double utilisation) {
  const std::string who = "rate group '" + std::string(group.name) + "' ";
  if (found.budget_ns > found.period_ns)
    return who + "has budgets of " + milliseconds(found.budget_ns) + " in a period of " +
           milliseconds(found.period_ns) + " (" +
           percent(static_cast<double>(found.budget_ns) / static_cast<double>(found.period_ns)) +
           " of a processor).";
  return who + "may take " + milliseconds(found.response_ns) + " or more of its period of " +
         milliseconds(found.period_ns) + ": its budgets are " + milliseconds(found.budget_ns) +
         ", the rest goes to groups of its priority or above (real-time groups use " + percent(utilisation) +
         " of the processors).";
}

std::string fault(const RateGroup& group, const ScheduledComponent& scheduled, int processors) {
  return "rate group '" + std::string(group.name) + "': " + std::to_string(scheduled.threads) +
         " threads share a step of '" + std::string(scheduled.component.name()) + "' on " +
         std::to_string(processors) + (processors == 1 ? " processor." : " processors.");
}

void find_response(std::size_t index, const RateGroupTable& table, const std::vector<Thread>& threads,
                   int processors, std::vector<GroupResponse>& responses) {
  const Interference interference(table.groups[index], index, threads, processors);
  GroupResponse& mine = responses[index];
  TimeNs response = mine.budget_ns;
  // Each round adds at least a beat of someone, and stops beyond the period: the rounds are bounded.
  while (response <= mine.period_ns) {
    const TimeNs next = mine.budget_ns + interference.within(response, responses);
    if (next == response) break;
    response = next;
  }
  mine.response_ns = response;
  mine.holds = response <= mine.period_ns;
}

}  // namespace

Schedulability analyse_schedule(const RateGroupTable& table, int processors) {
  Schedulability result;
  const std::vector<Thread> threads = threads_of(table);
  for (const Thread& thread : threads)
    result.utilisation += static_cast<double>(thread.work) / static_cast<double>(thread.period) /
                          static_cast<double>(processors);
  for (const RateGroup& group : table.groups) {
    GroupResponse response;
    response.period_ns = table.base_period.count() * group.divisor;
    response.budget_ns = total_budget(group);
    response.real_time = group.priority > 0;
    response.response_ns = response.real_time ? response.period_ns : response.budget_ns;
    response.holds = response.budget_ns <= response.period_ns;
    TimeNs work = response.budget_ns;
    for (const ScheduledComponent& scheduled : group.components) {
      work += (scheduled.threads - 1) * scheduled.budget.count();
      if (response.real_time && scheduled.budget.count() == 0)
        result.without_budget.emplace_back(scheduled.component.name());
      if (response.real_time && scheduled.threads > processors)
        result.faults.push_back(fault(group, scheduled, processors));
    }
    response.utilisation = static_cast<double>(work) / static_cast<double>(response.period_ns);
    result.groups.push_back(response);
  }
  std::vector<std::size_t> order(table.groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return table.groups[a].priority > table.groups[b].priority;
  });
  for (const std::size_t index : order)
    if (result.groups[index].real_time) find_response(index, table, threads, processors, result.groups);
  for (std::size_t g = 0; g < table.groups.size(); ++g)
    if (!result.groups[g].holds)
      result.faults.push_back(fault(table.groups[g], result.groups[g], result.utilisation));
  return result;
}

void check_schedule(const RateGroupTable& table, int processors) {
  const Schedulability found = analyse_schedule(table, processors);
  if (found.faults.empty()) return;
  std::string message = "the schedule does not hold:";
  for (const std::string& sentence : found.faults)
    message += (found.faults.size() > 1 ? "\n  " : " ") + sentence;
  throw ScheduleError(message);
}

std::string schedule_text(const RateGroupTable& table, int processors) {
  const Schedulability found = analyse_schedule(table, processors);
  std::string text;
  const auto line = [&text](const char* format, const auto&... values) {
    std::array<char, 192> out{};
    std::snprintf(out.data(), out.size(), format, values...);
    text += out.data();
  };
  line("%-20s %13s %10s %10s %9s %5s %6s  %s\n", "group or component", "period", "budget", "response",
       "priority", "core", "use", "after breaches");
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    const RateGroup& group = table.groups[g];
    const GroupResponse& response = found.groups[g];
    const std::string core = group.core == kAnyCore ? "any" : std::to_string(group.core);
    const std::string longest = response.real_time ? milliseconds(response.response_ns) : "no promise";
    line("%-20.20s %13s %10s %10s %9d %5s %6s%s\n", std::string(group.name).c_str(),
         milliseconds(response.period_ns).c_str(), milliseconds(response.budget_ns).c_str(), longest.c_str(),
         group.priority, core.c_str(), percent(response.utilisation).c_str(),
         response.holds ? group.critical ? "  critical" : "" : "  DOES NOT HOLD");
    for (const ScheduledComponent& scheduled : group.components) {
      const BudgetRule& rule = scheduled.on_breach;
      const std::string budget = scheduled.budget.count() > 0 ? milliseconds(scheduled.budget.count()) : "-";
      line("  %-18.18s %13s %10s", std::string(scheduled.component.name()).c_str(), "", budget.c_str());
      if (scheduled.threads > 1) line("  on %d threads", scheduled.threads);
      if (rule.reaction != BreachReaction::kNone)
        line("%*s%s after %d in %d", scheduled.threads > 1 ? 22 : 36, "", reaction_name(rule.reaction).data(),
             rule.breaches, rule.window());
      text += '\n';
    }
  }
  line("real-time groups use %s of %d processor%s\n", percent(found.utilisation).c_str(), processors,
       processors == 1 ? "" : "s");
  for (const std::string& name : found.without_budget) text += name + " has no budget and is not counted\n";
  for (const std::string& sentence : found.faults) text += sentence + "\n";
  return text;
}

int processors_here() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace omma
