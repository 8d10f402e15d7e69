// From places in the schedule to stages of the chain.
#include "components/telemetry/frame_stages.hpp"

#include <algorithm>

namespace omma::telemetry {
namespace {

struct Place {
  std::uint16_t group = 0;
  std::uint16_t position = 0;
  bool found = false;
};

Place place_of(const RateGroupTable& table, const Component* component) {
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    const auto& components = table.groups[g].components;
    for (std::size_t p = 0; p < components.size(); ++p)
      if (&components[p].component == component)
        return {static_cast<std::uint16_t>(g), static_cast<std::uint16_t>(p), true};
  }
  return {};
}

}  // namespace

std::string_view stage_name(FrameStage stage) {
  static constexpr PerStage<std::string_view> kNames{"trigger",  "exposure", "frame",    "dots",
                                                     "pairings", "solution", "published"};
  return kNames[static_cast<std::size_t>(stage)];
}

FrameStages::FrameStages(const RateGroupTable& table, const std::vector<StageEnd>& ends, bool lockstep)
    : lockstep_(lockstep) {
  stage_of_.fill(kNoStage);
  done_.fill(kNotDone);
  for (const StageEnd& end : ends) {
    const Place place = place_of(table, end.component);
    if (!place.found || place.position >= stage_of_.size()) continue;
    group_ = place.group;
    stage_of_[place.position] = static_cast<std::uint8_t>(end.stage);
  }
}

void FrameStages::component_stepped(SchedulePlace place, const Tick& tick, const StepTime& time) noexcept {
  if (place.group != group_ || place.position >= stage_of_.size()) return;
  if (place.position == 0) {
    done_.fill(kNotDone);
    if (lockstep_) offset_ns_ = elapsed(time.start_ns, tick.time_ns);
  }
  const std::uint8_t stage = stage_of_[place.position];
  if (stage != kNoStage) done_[stage] = time.start_ns + time.wall_ns + offset_ns_;
}

PerStage<> stage_budgets(const RateGroupTable& table, const std::vector<StageEnd>& ends) {
  PerStage<> budgets{};
  for (const StageEnd& end : ends) {
    const Place place = place_of(table, end.component);
    if (!place.found) continue;
    const RateGroup& group = table.groups[place.group];
    TimeNs budget = 0;
    for (std::size_t p = 0; p <= place.position; ++p) budget += group.components[p].budget.count();
    TimeNs& of_stage = budgets[static_cast<std::size_t>(end.stage)];
    of_stage = std::max(of_stage, budget);
    TimeNs all = table.base_period.count() * group.divisor;
    for (const ScheduledComponent& scheduled : group.components) all += scheduled.budget.count();
    budgets[static_cast<std::size_t>(FrameStage::kPublished)] = all;
  }
  return budgets;
}

}  // namespace omma::telemetry
