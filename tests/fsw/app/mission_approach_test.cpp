// How a mission says that a body is followed from afar, and what is said of every mistake in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fsw/app/mission_file.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

TEST_F(MissionFile, SaysHowALightIsFollowedOrWhatIsWrongWithIt) {
  auto refusal = [&](const std::string& from, const std::string& to) {
    replace("scenarios/range_modes.toml", from, to);
    std::string said = "nothing";
    try {
      read_mission(folder_ / "scenarios/range_modes.toml");
    } catch (const InputError& error) {
      said = error.what();
    }
    replace("scenarios/range_modes.toml", to, from);
    return said;
  };
  const Mission mission = read_mission(folder_ / "scenarios/range_modes.toml");
  ASSERT_EQ(mission.approach.bodies.size(), 1U);
  EXPECT_DOUBLE_EQ(mission.approach.bodies[0].range.magnitude_at_1m, -4.4);
  EXPECT_DOUBLE_EQ(mission.approach.modes.range_sigma_leave, 0.35);
  EXPECT_DOUBLE_EQ(mission.approach.bodies[0].range.acceleration, 0.005);
  EXPECT_EQ(mission.approach.candidates, 4);
  EXPECT_THAT(refusal("magnitude_at_1m = -4.4", "magnitude = -4.4"),
              HasSubstr("body[0].light.magnitude_at_1m"));
  EXPECT_THAT(refusal("magnitude_sigma = 0.3", "magnitude_sigma = 0"),
              HasSubstr("body[0].light.magnitude_sigma"));
  EXPECT_THAT(refusal("magnitude_sigma = 0.3", "magnitude_sigma = 0.3, colour = 1"),
              HasSubstr("unknown key"));
  EXPECT_THAT(refusal("range_sigma_leave = 0.35", "range_sigma_leave = 0.1"),
              HasSubstr("approach.range_sigma_leave: expected no less than range_sigma_enter"));
  EXPECT_THAT(refusal("snr_leave = 7", "snr_leave = 11"),
              HasSubstr("approach.snr_leave: expected no more than snr_enter"));
  EXPECT_THAT(refusal("settle = 3", "settle = 0"), HasSubstr("approach.settle"));
  EXPECT_THAT(refusal("patience = 5", "patiense = 5"), HasSubstr("unknown key"));
  EXPECT_THAT(refusal("candidates = 4", "candidates = 9"), HasSubstr("approach.candidates: expected"));
  EXPECT_THAT(refusal("candidates = 4", "candidates = 0"), HasSubstr("approach.candidates: expected"));
  EXPECT_THAT(refusal("acceleration_m_s2 = 0.005", "acceleration_m_s2 = 0"),
              HasSubstr("body[0].light.acceleration_m_s2"));
}

}  // namespace
}  // namespace omma
