#include "fsw/services/life_signs.hpp"

#include "fsw/kernel/scheduler.hpp"

namespace omma {

LifeSigns::LifeSigns(const Scheduler& scheduler, TimeNs patience_ns, TimeNs now_ns)
    : patience_ns_(patience_ns) {
  for (std::size_t g = 0; g < scheduler.group_count(); ++g) {
    const GroupRunner& group = scheduler.group(g);
    if (group.group().critical)
      watched_.push_back({.group = &group,
                          .index = static_cast<int>(g),
                          .period_ns = group.period_ns(),
                          .served_ns = now_ns});
  }
}

int LifeSigns::look(TimeNs now_ns) noexcept {
  int first = kAllWell;
  for (Watched& watched : watched_)
    if (!well(watched, now_ns) && first == kAllWell) first = watched.index;
  return first;
}

bool LifeSigns::well(Watched& watched, TimeNs now_ns) const noexcept {
  const std::uint64_t missed = watched.group->timing().missed.load(std::memory_order_relaxed);
  const std::uint64_t served = watched.group->timing().latency.count();
  const bool none_missed = missed == watched.missed;
  watched.missed = missed;
  if (served != watched.served) watched.served_ns = now_ns;
  watched.served = served;
  return none_missed && elapsed(watched.served_ns, now_ns) <= 2 * watched.period_ns + patience_ns_;
}

}  // namespace omma
