// The Maestro driver against a simulated board on a real serial line (a pseudo-terminal).
#include "hal/maestro/maestro_servo.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "sim/devices/maestro_simulator.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using maestro::Command;

std::string link_path() {
  const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  return (std::filesystem::temp_directory_path() / ("omma_maestro_" + name + std::to_string(::getpid())))
      .string();
}

MaestroOptions options(const std::string& device) {
  MaestroOptions result;
  result.device = device;
  result.timeout_ms = 1000;
  return result;
}

std::vector<int> bytes(const maestro::Message& message) {
  return {message.span().begin(), message.span().end()};
}

TEST(MaestroProtocol, SaysTheBytesOfTheGuide) {
  // The guide's example: channel 2 to 1500 us is 84 02 70 2E; as device 12 in Pololu's protocol AA 0C 04 02
  // 70 2E.
  EXPECT_EQ(bytes(maestro::encode(Command::kSetTarget, -1, 2, 6000)),
            (std::vector<int>{0x84, 2, 0x70, 0x2E}));
  EXPECT_EQ(bytes(maestro::encode(Command::kSetTarget, 12, 2, 6000)),
            (std::vector<int>{0xAA, 0x0C, 0x04, 2, 0x70, 0x2E}));
  EXPECT_EQ(bytes(maestro::encode(Command::kGetErrors, 12)), (std::vector<int>{0xAA, 0x0C, 0x21}));
}

TEST(MaestroProtocol, NamesErrors) {
  EXPECT_EQ(maestro::error_names(0), "none");
  EXPECT_EQ(maestro::error_names(16 | 1), "serial signal, serial protocol");
}

TEST(MaestroServo, AThousandCommandsArriveInBothProtocols) {
  for (const int number : {-1, 12}) {
    const MaestroSimulator board(link_path());
    MaestroOptions chosen = options(link_path());
    chosen.number = number;
    MaestroServo servo(chosen);
    for (int i = 0; i < 1000; ++i) {
      const auto pulse = static_cast<QuarterMicroseconds>(256 + 15 * i);
      ASSERT_TRUE(servo.set_target(i % 12, pulse));
      ASSERT_EQ(servo.position(i % 12), pulse);
    }
    EXPECT_EQ(servo.errors(), 0);
    EXPECT_EQ(servo.lost_commands(), 0U);
  }
}

TEST(MaestroServo, SpeedAccelerationHomeAndStop) {
  const MaestroSimulator board(link_path());
  MaestroServo servo(options(link_path()));
  EXPECT_TRUE(servo.set_speed(1, 140));
  EXPECT_TRUE(servo.set_acceleration(1, 4));
  EXPECT_TRUE(servo.set_target(1, 6000));
  EXPECT_TRUE(servo.go_home());
  EXPECT_EQ(servo.position(1), 6000);  // the answer comes after everything before it
  EXPECT_EQ(board.speed(1), 140);
  EXPECT_EQ(board.acceleration(1), 4);
  EXPECT_EQ(board.homes(), 1);
  EXPECT_TRUE(servo.stop());
  EXPECT_EQ(servo.position(1), 0);
}

TEST(MaestroServo, ErrorsOfTheBoardAreReadAndCleared) {
  MaestroSimulator board(link_path());
  MaestroServo servo(options(link_path()));
  board.set_errors(2 | 32);
  EXPECT_EQ(maestro::error_names(servo.errors().value()), "serial overrun, serial time-out");
  EXPECT_EQ(servo.errors(), 0);
}

TEST(MaestroServo, ASilentBoardCostsTheTimeOutOnly) {
  MaestroSimulator board(link_path());
  MaestroOptions chosen = options(link_path());
  chosen.timeout_ms = 5;
  MaestroServo servo(chosen);
  board.mute(true);
  EXPECT_EQ(servo.position(0), std::nullopt);
  EXPECT_TRUE(servo.connected());
}

TEST(MaestroServo, SurvivesUnplugAndReplug) {
  auto board = std::make_unique<MaestroSimulator>(link_path());
  MaestroServo servo(options(link_path()));
  ASSERT_TRUE(servo.set_target(0, 6000));
  board.reset();
  EXPECT_FALSE(servo.set_target(0, 6001));
  EXPECT_FALSE(servo.connected());
  EXPECT_FALSE(servo.connect());
  EXPECT_FALSE(servo.set_target(0, 6002));
  EXPECT_EQ(servo.lost_commands(), 2U);
  board = std::make_unique<MaestroSimulator>(link_path());
  EXPECT_TRUE(servo.connect());
  EXPECT_TRUE(servo.set_target(0, 6003));
  EXPECT_EQ(servo.position(0), 6003);
}

TEST(MaestroServo, WhatWentWrongIsCountedAndNamed) {
  auto board = std::make_unique<MaestroSimulator>(link_path());
  MaestroServo servo(options(link_path()));
  EXPECT_TRUE(servo.complaints().empty());
  board->set_errors(2 | 16);
  servo.attend();
  board.reset();
  EXPECT_FALSE(servo.set_target(0, 6000));
  servo.attend();
  servo.attend();
  EXPECT_FALSE(servo.connected());
  board = std::make_unique<MaestroSimulator>(link_path());
  servo.attend();
  EXPECT_TRUE(servo.connected());
  EXPECT_TRUE(servo.set_target(0, 6000));
  const std::vector<std::string> said = servo.complaints();
  ASSERT_EQ(said.size(), 4U);
  EXPECT_NE(said[0].find("the board was lost, 1 times"), std::string::npos);
  EXPECT_NE(said[1].find("did not take a command, 1 times"), std::string::npos);
  EXPECT_NE(said[2].find("serial overrun"), std::string::npos);
  EXPECT_NE(said[3].find("serial protocol"), std::string::npos);
}

TEST(MaestroServo, CommandsOutOfRangeNeverReachTheLine) {
  const MaestroSimulator board(link_path());
  MaestroServo servo(options(link_path()));
  EXPECT_FALSE(servo.set_target(12, 6000));
  EXPECT_FALSE(servo.set_target(-1, 6000));
  EXPECT_FALSE(servo.set_target(0, 16384));
  EXPECT_FALSE(servo.set_acceleration(0, 256));
  EXPECT_EQ(servo.position(12), std::nullopt);
  EXPECT_EQ(servo.errors(), 0);
  EXPECT_EQ(board.target(0), 0);
}

std::string refusal(const MaestroOptions& chosen) {
  return refusal_of([&] { const MaestroServo servo(chosen); });
}

TEST(MaestroServo, BadOptionsAndDevicesAreNamed) {
  const MaestroSimulator board(link_path());
  MaestroOptions chosen = options(link_path());
  chosen.number = 128;
  EXPECT_NE(refusal(chosen).find("number"), std::string::npos);
  EXPECT_NE(refusal(chosen).find("128"), std::string::npos);
  chosen = options(link_path());
  chosen.channels = 25;
  EXPECT_NE(refusal(chosen).find("1 to 24"), std::string::npos);
  chosen = options(link_path());
  chosen.timeout_ms = 0;
  EXPECT_NE(refusal(chosen).find("timeout"), std::string::npos);
  EXPECT_NE(refusal(options(link_path() + "_missing")).find("No such file"), std::string::npos);
  const std::string plain = link_path() + "_plain";
  std::ofstream(plain) << "text";
  EXPECT_NE(refusal(options(plain)).find("serial line"), std::string::npos);
  std::filesystem::remove(plain);
}

}  // namespace
}  // namespace omma
