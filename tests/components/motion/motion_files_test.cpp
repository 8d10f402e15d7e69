// Gimbal and trajectory files are read whole or refused with one sentence.
#include "components/motion/motion_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = 0.017453292519943295;

constexpr const char* kGimbal = R"([[axis]]
name = "z"
channel = 0
angle_deg = [-90, 90]
speed_deg_s = 120
acceleration_deg_s2 = 300
calibration = [{ angle_deg = -90, pulse_us = 600 }, { angle_deg = 90, pulse_us = 2400 }]
[[axis]]
name = "y"
channel = 3
angle_deg = [-45, 45]
speed_deg_s = 120
acceleration_deg_s2 = 300
home_deg = -10
calibration = [{ angle_deg = -90, pulse_us = 2400 }, { angle_deg = 90, pulse_us = 600 }]
)";

class MotionFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("omma_motion_files_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path written(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::vector<GimbalAxis> gimbal(const std::string& text = kGimbal) const {
    return read_gimbal_file(written("gimbal.toml", text));
  }
  std::string gimbal_refusal(std::string text, const std::string& from, const std::string& to) const {
    text.replace(text.find(from), from.size(), to);
    return refusal_of([&] { gimbal(text); });
  }
  std::string refusal(const std::string& text, const std::string& name = "turn.csv") const {
    const std::vector<GimbalAxis> axes = gimbal();
    return refusal_of([&] { read_trajectory_file(written(name, text), axes); });
  }

  std::filesystem::path folder_;
};

TEST_F(MotionFiles, AGimbalIsRead) {
  const std::vector<GimbalAxis> axes = gimbal();
  ASSERT_EQ(axes.size(), 2U);
  EXPECT_EQ(axes[0].name.view(), "z");
  EXPECT_EQ(axes[0].home, 0);
  EXPECT_EQ(axes[0].pulses.pulse(0), 6000);
  EXPECT_EQ(axes[1].channel, 3);
  EXPECT_NEAR(axes[1].home, -10 * kDegree, 1e-12);
  EXPECT_NEAR(axes[1].limits.highest_angle, 45 * kDegree, 1e-12);
}

TEST_F(MotionFiles, MistakesInAGimbalAreNamedWithFileLineAndField) {
  EXPECT_THAT(gimbal_refusal(kGimbal, "channel = 3", "channel = 0"),
              HasSubstr("gimbal.toml:10: axis[1].channel"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "channel = 3", "channel = 24"), HasSubstr("0 to 23"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "\"y\"", "\"z\""), HasSubstr("each axis once"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "\"y\"", "\"a b\""), HasSubstr("without spaces"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "[-45, 45]", "[45, -45]"), HasSubstr("[lowest, highest]"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "[-45, 45]", "[-95, 45]"), HasSubstr("within the calibration"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "speed_deg_s = 120", "speed_deg_s = 0"),
              HasSubstr("axis[0].speed_deg_s"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "home_deg = -10", "home_deg = 50"), HasSubstr("axis[1].home_deg"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "pulse_us = 600", "pulse_us = 5000"), HasSubstr("64 to 4080"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "angle_deg = -90, pulse", "angle_deg = 91, pulse"),
              HasSubstr("point 2: expected an angle above"));
  EXPECT_THAT(gimbal_refusal(kGimbal, "home_deg", "house_deg"), HasSubstr("unknown key"));
}

TEST_F(MotionFiles, KeyPointsAreReadFromCsvWithEmptyCells) {
  const auto axes = read_trajectory_file(
      written("turn.csv", "# a turn\ntime_s, z_deg, y_deg\n0, 0, -10\n2, , 5\n4, 30,\n6, 0, -10\n"),
      gimbal());
  ASSERT_EQ(axes.size(), 2U);
  EXPECT_NEAR(axes[0].trajectory.at(4).angle, 30 * kDegree, 1e-12);
  EXPECT_NEAR(axes[1].trajectory.at(2).angle, 5 * kDegree, 1e-12);
}

TEST_F(MotionFiles, KeyPointsAreReadFromTomlAndUnnamedAxesRestAtHome) {
  const auto axes = read_trajectory_file(
      written(
          "turn.toml",
          "[[axis]]\nname = \"z\"\nkey_points = [{ time_s = 1, angle_deg = 0 }, { time_s = 3, angle_deg = "
          "40 }]\n"),
      gimbal());
  EXPECT_NEAR(axes[0].trajectory.at(3).angle, 40 * kDegree, 1e-12);
  EXPECT_EQ(axes[1].trajectory.at(2).angle, axes[1].axis.home);
}

TEST_F(MotionFiles, MistakesInKeyPointsAreNamedWithFileLineAndField) {
  EXPECT_THAT(refusal(""), HasSubstr("a first line of names"));
  EXPECT_THAT(refusal("time_s,z_deg\n"), HasSubstr("expected key points, found none"));
  EXPECT_THAT(refusal("time_s,x_deg\n"),
              HasSubstr("turn.csv:1: column 2: expected time_s or an axis of the gimbal (z_deg, y_deg)"));
  EXPECT_THAT(refusal("time_s,z_deg,z_deg\n"), HasSubstr("each column once"));
  EXPECT_THAT(refusal("z_deg\n"), HasSubstr("a column time_s"));
  EXPECT_THAT(refusal("time_s,z_deg\n0,0\n1,2,3\n"), HasSubstr("turn.csv:3: line: expected 2 cells"));
  EXPECT_THAT(refusal("time_s,z_deg\n0,0\n1,two\n"),
              HasSubstr("turn.csv:3: z_deg: expected a number, found \"two\""));
  EXPECT_THAT(refusal("time_s,z_deg\n0,0\n,2\n"),
              HasSubstr("turn.csv:3: time_s: expected a number, found nothing"));
  EXPECT_THAT(refusal("time_s,z_deg\n1,0\n1,2\n"), HasSubstr("turn.csv:3: time_s: expected a time after"));
  EXPECT_THAT(refusal("time_s,z_deg\n1,0\n"),
              HasSubstr("turn.csv:2: axis z: expected a trajectory, found expected at least 2"));
  EXPECT_THAT(refusal("time_s,z_deg\n0,0\n", "turn.txt"), HasSubstr("ends in .csv or .toml"));
  EXPECT_THAT(refusal("[[axis]]\nname = \"x\"\nkey_points = []\n", "turn.toml"),
              HasSubstr("turn.toml:2: axis[0].name: expected an axis of the gimbal (z, y)"));
  EXPECT_THAT(refusal("[[axis]]\nname = \"z\"\nkey_points = [{ time_s = 1, angle_deg = 0 }, { time_s = 1, "
                      "angle_deg = 1 }]\n",
                      "turn.toml"),
              HasSubstr("key_points[1].time_s: expected a time after"));
}

TEST_F(MotionFiles, BrokenLimitsAreNamedWithAxisTimeValueAndLimit) {
  EXPECT_THAT(refusal("time_s,y_deg\n0,0\n5,46\n"),
              HasSubstr("axis y at 5.000 s: angle 46 deg, expected at most 45 deg"));
  EXPECT_THAT(refusal("time_s,y_deg\n0,0\n5,-46\n"), HasSubstr("expected at least -45 deg"));
  // 3/2 of the mean speed, half way; 6 angle / time² at the beginning.
  EXPECT_THAT(refusal("time_s,z_deg\n0,-60\n1.4,60\n"),
              HasSubstr("axis z at 0.700 s: speed 128.6 deg/s, expected at most 120 deg/s"));
  EXPECT_THAT(refusal("time_s,z_deg\n2,0\n2.5,15\n"),
              HasSubstr("axis z at 2.000 s: acceleration 360 deg/s2, expected at most 300 deg/s2"));
}

}  // namespace
}  // namespace omma
