// The whole flight program through an approach: a faint point among the stars, a light whose brightness tells
// its range, fiducials; each mode's bearing and range judged against the truth the images were drawn from.
#include <gtest/gtest.h>

#include "sim/scenario_file.hpp"
#include "tests/bench/flown_approach.hpp"

namespace omma {
namespace {

TEST(Approach, GoesThroughAllRangeModesWithAnHonestUncertainty) {
  FlownApproach flown =
      fly_approach(sim::read_scenario_file(config_file("scenarios/range_modes_scenario.toml")),
                   read_mission(config_file("scenarios/range_modes.toml")));
  EXPECT_EQ(flown.allocations, 0U);
  EXPECT_EQ(flown.steps_back, 0);  // an approach, and no way back
  EXPECT_EQ(flown.wrong, 0);
  for (const auto& [mode, of] : flown.modes)
    std::printf(
        "range mode %d: %d frame sets, bearing NEES %.2f (2), range NEES %.2f (1), worst range error %.1f "
        "%%\n",
        static_cast<int>(mode), of.frame_sets, of.bearing_nees / of.frame_sets, of.range_nees / of.frame_sets,
        100 * of.worst_range);
  const OfOneMode& far = flown.modes[RangeMode::kFar];
  const OfOneMode& intermediate = flown.modes[RangeMode::kIntermediate];
  const OfOneMode& close = flown.modes[RangeMode::kClose];
  // One approach: errors of the calibration are one draw, so the upper ends are of three sigma.
  EXPECT_GE(far.frame_sets, 60);
  EXPECT_LT(far.bearing_nees, 5 * far.frame_sets);
  EXPECT_GE(intermediate.frame_sets, 20);
  EXPECT_LT(intermediate.bearing_nees, 5 * intermediate.frame_sets);
  EXPECT_LT(intermediate.range_nees, 9 * intermediate.frame_sets);
  EXPECT_LT(intermediate.worst_range, 0.35);
  EXPECT_GE(close.frame_sets, 20);
  EXPECT_GT(close.bearing_nees, 0.5 * close.frame_sets);
  EXPECT_LT(close.bearing_nees, 4 * close.frame_sets);
  EXPECT_LT(close.range_nees, 3 * close.frame_sets);
  EXPECT_LT(close.worst_range, 0.02);
  // 0.3 before fiducials were seen; how much of the sky it hides stays untold.
  EXPECT_LT(flown.last_magnitude_sigma, 0.1);
}

}  // namespace
}  // namespace omma
