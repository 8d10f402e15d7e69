// When each stage of the chain was done with the present frame set: from the stamps the scheduler takes
// anyway, kept for the telemetry component, which runs last on the same thread. Measured times: not the same
// in two replays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "config/limits.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/schedule_observer.hpp"

namespace omma::telemetry {

/// On the way of a frame set, in order.
enum class FrameStage : std::uint8_t {
  kTrigger,    ///< the edge; latencies count from here
  kExposure,   ///< midpoint of the exposure
  kFrame,      ///< all cameras' images are here
  kDots,       ///< dots are extracted
  kPairings,   ///< dots are paired
  kSolution,   ///< attitude and poses are estimated
  kPublished,  ///< every sink has its samples
};
inline constexpr std::size_t kFrameStages = 7;

std::string_view stage_name(FrameStage stage);

/// Of each stage [ns]: an instant, a latency, or a budget.
template <class T = TimeNs>
using PerStage = std::array<T, kFrameStages>;

/// In place of an instant: the stage was not reached in this beat.
inline constexpr TimeNs kNotDone = std::numeric_limits<TimeNs>::min();

/// A component after whose step a stage is done; the last of several counts.
struct StageEnd {
  const Component* component = nullptr;
  FrameStage stage = FrameStage::kFrame;
};

class FrameStages final : public ScheduleObserver {
 public:
  /// @param ends      all in one rate group
  /// @param lockstep  on-board time stands still during a beat: stamps count from its begin
  FrameStages(const RateGroupTable& table, const std::vector<StageEnd>& ends, bool lockstep);

  /// On-board time at which each stage of the present beat was done, or kNotDone.
  const PerStage<>& done() const { return done_; }
  /// What turns a reading of the stopwatch into on-board time, for the stages that come after the beat [ns].
  TimeNs on_board_offset() const { return offset_ns_; }

  void component_stepped(SchedulePlace place, const Tick& tick, const StepTime& time) noexcept override;

 private:
  static constexpr std::uint8_t kNoStage = 0xff;

  const bool lockstep_;
  std::uint16_t group_ = 0;
  std::array<std::uint8_t, limits::kComponents> stage_of_;  // by the component's place in its group
  PerStage<> done_;
  TimeNs offset_ns_ = 0;
};

/// Budgets that follow from the table's: each stage is to be done when the steps up to it have taken theirs,
/// and published one period later.
PerStage<> stage_budgets(const RateGroupTable& table, const std::vector<StageEnd>& ends);

}  // namespace omma::telemetry
