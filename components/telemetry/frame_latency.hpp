// Latency of the chain: how long after its trigger each stage was done with a frame set, beside its budget
// and the statistics since the start. Kept on the telemetry thread, where the last stage ends.
#pragma once

#include <array>
#include <cstdint>

#include "components/telemetry/frame_stages.hpp"
#include "components/telemetry/omma.h"
#include "fsw/kernel/timing.hpp"
#include "fsw/services/event.hpp"

namespace omma::telemetry {

inline constexpr EventDescriptor kFrameLate{
    .id = 22,
    .severity = EventSeverity::kWarning,
    .name = "frame_late",
    .text =
        "frame set {0}: {2} from its trigger to stage {1} (2 frame, 3 dots, 4 pairings, 5 solution, 6 "
        "published), "
        "budget {3}",
    .values = {{{"frame"}, {"stage"}, {"latency", "ms"}, {"budget", "ms"}}},
    .burst = 2,
    .interval_ns = 10'000'000'000};

inline constexpr std::array kLatencyEvents{kFrameLate};
static_assert(are_well_formed(kLatencyEvents));

class FrameLatency {
 public:
  explicit FrameLatency(const PerStage<>& budgets) : budgets_(budgets) {}

  /// Adds one frame set and writes its stages.
  /// @param done  on-board time at which each stage was done
  /// @param out   `stages` holds room for kFrameStages
  /// @return the first stage beyond its budget; kTrigger where there is none
  FrameStage add(const PerStage<>& done, omma_FrameTiming& out) noexcept;

  TimeNs budget(FrameStage stage) const { return budgets_[static_cast<std::size_t>(stage)]; }

 private:
  const PerStage<> budgets_;  // 0: none
  PerStage<DurationStatistics> latency_;
  PerStage<std::uint64_t> over_budget_{};
};

}  // namespace omma::telemetry
