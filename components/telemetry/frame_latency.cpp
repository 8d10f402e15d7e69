// One frame set into the statistics and out into its sample.
#include "components/telemetry/frame_latency.hpp"

#include "components/telemetry/samples.hpp"

namespace omma::telemetry {

FrameStage FrameLatency::add(const PerStage<>& done, omma_FrameTiming& out) noexcept {
  FrameStage late = FrameStage::kTrigger;
  out.stages._length = kFrameStages;
  for (std::size_t s = 0; s < kFrameStages; ++s) {
    const bool reached = done[s] != kNotDone;
    const TimeNs latency = reached ? elapsed(done[0], done[s]) : 0;
    if (reached) latency_[s].add(latency);
    if (budgets_[s] > 0 && latency > budgets_[s]) {
      ++over_budget_[s];
      if (late == FrameStage::kTrigger) late = static_cast<FrameStage>(s);
    }
    const DurationSnapshot all = latency_[s].snapshot();
    omma_StageTiming& stage = out.stages._buffer[s];
    set_text(stage.name, stage_name(static_cast<FrameStage>(s)));
    stage.reached = reached;
    stage.time_ns = reached ? done[s] : 0;
    stage.latency_ns = latency;
    stage.budget_ns = budgets_[s];
    stage.mean_ns = static_cast<TimeNs>(all.mean_ns());
    stage.p99_ns = all.quantile_ns(0.99);
    stage.max_ns = all.max_ns;
    stage.over_budget = over_budget_[s];
  }
  return late;
}

}  // namespace omma::telemetry
