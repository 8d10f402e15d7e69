// `omma motion` and `omma servo-board` as a user runs them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const std::string kGimbal = " --gimbal " OMMA_SOURCE_DIR "/config/gimbals/dissertation.toml ";
const std::string kTrajectory = OMMA_SOURCE_DIR "/config/trajectories/three_axes.csv";

TEST(MotionProgram, ShowsTheLabsTrajectoryInTheTerminalAndOnAPage) {
  const OperatorsFolder folder;
  const Told told = folder.omma("motion " + kTrajectory + kGimbal + "--output look");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("axis z [deg]"));
  EXPECT_THAT(told.out, HasSubstr("\xE2\xA1"));  // dots of Braille
  const std::string page = folder.read("look/motion.html");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("Not to be run"), std::string::npos);
}

TEST(MotionProgram, RefusesATrajectoryThatBreaksALimitAndShowsItAllTheSame) {
  const OperatorsFolder folder;
  folder.write("fast.csv", "time_s,z_deg,y_deg\n0,-60,0\n1.4,60,95\n");
  const Told told = folder.omma("motion fast.csv" + kGimbal + "--json --output look");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_THAT(told.err,
              HasSubstr("fast.csv: axis z at 0.700 s: speed 128.6 deg/s, expected at most 120 deg/s"));
  EXPECT_THAT(told.err, HasSubstr("axis y at 1.400 s: angle 95 deg, expected at most 90 deg"));
  const auto json = nlohmann::json::parse(told.out);
  EXPECT_NEAR(json["axes"][0]["largest_speed_deg_s"]["value"].get<double>(), 128.571, 0.001);
  EXPECT_EQ(json["broken_limits"].size(), 4U);  // z: speed, acceleration; y: angle, acceleration
  EXPECT_THAT(folder.read("look/motion.html"), HasSubstr("Not to be run"));
}

TEST(MotionProgram, MissingFilesAndOptionsAreNamed) {
  const OperatorsFolder folder;
  EXPECT_THAT(folder.omma("motion none.csv" + kGimbal).err,
              HasSubstr("none.csv: file: expected a readable file"));
  EXPECT_THAT(folder.omma("motion none.csv --gimbal none.toml").err,
              HasSubstr("none.toml: file: expected a TOML file"));
  EXPECT_EQ(folder.omma("motion none.csv").exit_code, 2);
}

TEST(ServoBoardProgram, ListensOnAPseudoTerminalAndRefusesWhatIsNoSerialLine) {
  const OperatorsFolder folder;
  const Told told = folder.omma("servo-board --link board --seconds 0.1");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("0 commands heard, protocol errors: none; last  no pulses"));
  folder.write("plain", "text");
  const Told refused = folder.omma("servo-board --device plain --seconds 0.1");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("plain: device: expected a serial line"));
  EXPECT_EQ(folder.omma("servo-board").exit_code, 2);
}

}  // namespace
}  // namespace omma
