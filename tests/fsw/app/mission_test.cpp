// A mission file is read whole or refused with one sentence: file, line, field, expected, found.
#include "fsw/app/mission.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "components/telemetry/topics.hpp"
#include "fsw/app/camera_drivers.hpp"
#include "fsw/app/program_dictionary.hpp"
#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

/// A copy of config/ whose mission a test may spoil.
class MissionFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(OMMA_BINARY_DIR) / "tests" /
              (std::string("mission_test_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::copy(std::filesystem::path(OMMA_SOURCE_DIR) / "config", folder_,
                          std::filesystem::copy_options::recursive);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file() const { return folder_ / "demo.toml"; }

  void replace(const std::string& name, const std::string& from, const std::string& to) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    std::string content = text.str();
    const std::size_t at = content.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    content.replace(at, from.size(), to);
    std::ofstream(folder_ / name) << content;
  }

  std::string message() const {
    try {
      read_mission(file());
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(MissionFile, OfTheDemoIsRead) {
  const Mission mission = read_mission(file());
  EXPECT_EQ(mission.spacecraft.view(), "demo");
  ASSERT_EQ(mission.rig.cameras.size(), 3U);
  ASSERT_EQ(mission.cameras.size(), 3U);
  EXPECT_EQ(mission.cameras[0].bits, 12);
  ASSERT_EQ(mission.bodies.size(), 1U);
  EXPECT_EQ(mission.bodies[0].targets.size(), 25U);
}

TEST_F(MissionFile, MayAskForAnAttitudeFilter) {
  EXPECT_EQ(read_mission(file()).attitude.filter, AttitudeFilterKind::kNone);
  replace("demo.toml", "[imaging]",
          "[attitude]\nfilter = \"mekf\"\nacceleration_density = 2e-4\n\n[imaging]");
  const Mission mission = read_mission(file());
  EXPECT_EQ(mission.attitude.filter, AttitudeFilterKind::kMekf);
  EXPECT_EQ(mission.attitude.mekf.acceleration_density, 2e-4);
}

TEST_F(MissionFile, WithAFilterThatDoesNotExistIsRefused) {
  replace("demo.toml", "[imaging]", "[attitude]\nfilter = \"ekf\"\n\n[imaging]");
  EXPECT_THAT(message(), HasSubstr("filter: expected \"none\" or \"mekf\", found ekf"));
}

TEST_F(MissionFile, ThatIsMissingIsNamed) {
  std::filesystem::remove(file());
  EXPECT_THAT(message(), HasSubstr("demo.toml: "));
}

TEST_F(MissionFile, WithAnUnknownKeyIsRefused) {
  replace("demo.toml", "frame_rate_hz", "frames_a_second = 3\nframe_rate_hz");
  EXPECT_THAT(message(), HasSubstr("demo.toml:5: frames_a_second: expected "));
}

TEST_F(MissionFile, WithACameraTheRigDoesNotHaveIsRefused) {
  replace("demo.toml", "name = \"cam2\"", "name = \"cam9\"");
  EXPECT_THAT(message(), HasSubstr("camera[2].name: expected a camera of the rig dissertation, found cam9"));
}

TEST_F(MissionFile, WithoutOneOfTheRigsCamerasIsRefused) {
  replace("demo.toml", "[[camera]]\nname = \"cam2\"\ndriver = \"recorded\"\nbits = 8\n", "[[body]]\n#");
  EXPECT_NE(message(), "no error");
}

TEST_F(MissionFile, WithACameraTwiceIsRefused) {
  replace("demo.toml", "name = \"cam2\"", "name = \"cam0\"");
  EXPECT_THAT(message(), HasSubstr("camera[2].name: expected each camera once, found cam0 again"));
}

TEST_F(MissionFile, WithAnEpochThatIsNoTimeIsRefused) {
  replace("demo.toml", "epoch = \"2026", "epoch = \"spring 2026");
  EXPECT_THAT(message(),
              HasSubstr("epoch: expected a UTC time like 2026-03-20T12:00:00Z, found spring 2026"));
}

TEST_F(MissionFile, WithASpacecraftNameThatNoTopicCanHaveIsRefused) {
  for (const std::string name :
       {"two words", "a/b", "", "caf\u00e9", "longer-than-the-thirty-one-characters"}) {
    SetUp();
    replace("demo.toml", "spacecraft = \"demo\"", "spacecraft = \"" + name + "\"");
    EXPECT_THAT(message(),
                HasSubstr("spacecraft: expected a name of 1 to 31 letters, digits, _ and -, found"));
  }
}

TEST_F(MissionFile, LatencyBudgetsThatGoBackOrNameNoStageAreRefused) {
  replace("demo.toml", "[[camera]]", "[latency]\nframe_ms = 30\ndots_ms = 20\n[[camera]]");
  EXPECT_THAT(message(),
              HasSubstr("latency.dots_ms: expected no less than the stage before it has, found 20"));
  SetUp();
  replace("demo.toml", "[[camera]]", "[latency]\nstars_ms = 30\n[[camera]]");
  EXPECT_THAT(message(), HasSubstr("latency.stars_ms: expected "));
}

TEST_F(MissionFile, IsDescribedWithoutItsFrames) {
  replace("demo.toml", "spacecraft = \"demo\"", "spacecraft = \"cubesat-1\"");
  const auto told = [&](const std::string& option) {
    const std::string command =
        OMMA_RUN "omma-fsw " + file().string() + option + " > " + (folder_ / "said").string();
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
    std::ostringstream said;
    said << std::ifstream(folder_ / "said").rdbuf();
    return said.str();
  };
  EXPECT_THAT(told(" --graph"), HasSubstr("digraph wiring"));
  EXPECT_THAT(told(" --schedule --workers 1"), HasSubstr("vision                  100.000 ms"));
  const auto dictionary = nlohmann::json::parse(told(" --dictionary"));
  EXPECT_EQ(dictionary.at("program"), "omma-fsw");
  EXPECT_EQ(dictionary.at("topics").size(), telemetry::kTopicCount);
  EXPECT_EQ(dictionary.at("topics").at(2).at("name"), "omma/cubesat-1/attitude");
  EXPECT_EQ(dictionary.at("events").size(), kEvents.size());
  EXPECT_EQ(dictionary.at("rate_groups").at(0).at("components").size(), 9U);
  EXPECT_THAT(dictionary.at("idl").get<std::string>(), HasSubstr("struct Attitude"));
}

TEST_F(MissionFile, MayMixRecordedAndLiveCameras) {
  replace(
      "demo.toml", "driver = \"recorded\"\nbits = 12",
      "driver = \"v4l2\"\ndevice = \"navcam0\"\nformat = \"Y16\"\nbits = 12\nbayer = \"green\"\nmemory = "
      "\"dma-buf\"\n"
      "controls = { exposure = 100, trigger = \"External\" }\ncontrol_names = { exposure = \"shutter\" }");
  const Mission mission = read_mission(file());
  EXPECT_TRUE(has_live_cameras(mission));
  const CameraSetup& setup = mission.cameras[0].setup;
  EXPECT_EQ(setup.device, "navcam0");
  EXPECT_EQ(setup.width, 768);
  EXPECT_EQ(setup.bits, 12);
  EXPECT_EQ(setup.bayer, BayerUse::kGreen);
  EXPECT_TRUE(setup.dma_buf);
  ASSERT_EQ(setup.controls.size(), 2U);
  EXPECT_EQ(setup.controls[0].value, "100");
  EXPECT_EQ(setup.controls[1].value, "External");
  EXPECT_EQ(setup.control_names[0].value, "shutter");
  EXPECT_EQ(setup.frame_rate_hz, 10);
  EXPECT_EQ(mission.cameras[1].driver, "recorded");
}

TEST_F(MissionFile, OfLiveCamerasThatMakeNoSenseIsRefused) {
  const std::string recorded = "driver = \"recorded\"\nbits = 12";
  replace("demo.toml", recorded, "driver = \"v4l2\"");
  EXPECT_THAT(message(), HasSubstr("camera[0].device: expected a text, found nothing"));
  replace("demo.toml", "driver = \"v4l2\"", "driver = \"v4l2\"\ndevice = \"x\"\nmemory = \"paper\"");
  EXPECT_THAT(message(), HasSubstr("camera[0].memory: expected \"mmap\" or \"dma-buf\", found paper"));
  replace("demo.toml", "memory = \"paper\"", "bayer = \"blue\"");
  EXPECT_THAT(message(), HasSubstr("camera[0].bayer: expected \"grey\", \"green\" or \"raw\", found blue"));
  replace("demo.toml", "bayer = \"blue\"", "controls = { gain = 1.5 }");
  EXPECT_THAT(
      message(),
      HasSubstr("camera[0].controls.gain: expected a whole number, a text, true or false, found 1.5"));
}

TEST_F(MissionFile, WithAnUnknownDriverIsRefused) {
  replace("demo.toml", "driver = \"recorded\"", "driver = \"telepathy\"");
  EXPECT_THAT(message(), HasSubstr("camera[0].driver: expected \"recorded\", \"v4l2\", \"libcamera\", "
                                   "\"simulated\", found telepathy"));
}

TEST_F(MissionFile, NamesTheTargetFileAndLineOfADuplicateTarget) {
  replace("targets/docking_card.tsv", "T02", "T01");
  EXPECT_THAT(message(), HasSubstr("docking_card.tsv:2: "));
}

TEST_F(MissionFile, NamesTheTargetFileAndLineOfAnEmptyTargetId) {
  replace("targets/docking_card.tsv", "T03", "");
  EXPECT_THAT(message(), HasSubstr("docking_card.tsv:3: "));
}

TEST_F(MissionFile, NamesTheRigFileOfALensThatIsMissing) {
  replace("rigs/dissertation.toml", "hdr1_f3.0mm_10um_768x576.txt", "lost.txt");
  EXPECT_THAT(message(), HasSubstr("lost.txt"));
}

TEST_F(MissionFile, ThatIsWrongEndsTheFlightProgramWithTwo) {
  replace("demo.toml", "bits = 12", "bits = 99");
  const std::string command = OMMA_RUN "omma-fsw " + file().string() + " 2> " + (folder_ / "said").string();
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  std::ostringstream said;
  said << std::ifstream(folder_ / "said").rdbuf();
  EXPECT_THAT(said.str(), HasSubstr("camera[0].bits: expected "));
}

TEST_F(MissionFile, WithAFrameRateTheScheduleCannotHoldIsRefusedInRealTime) {
  replace("demo.toml", "frame_rate_hz = 10", "frame_rate_hz = 50");
  const std::filesystem::path frames = folder_ / "frames";
  const Mission mission = read_mission(file());
  for (std::size_t c = 0; c < mission.cameras.size(); ++c) {
    const RigCamera& camera = mission.rig.cameras[c];
    const std::string name(camera.name.view());
    Image image;
    image.resize(camera.lens.width(), camera.lens.height(),
                 mission.cameras[c].bits > 8 ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
    std::filesystem::create_directories(frames / name);
    write_png(frames / name / (name + "_000000.png"), image.view());
  }
  const std::string command = OMMA_RUN "omma-fsw " + file().string() + " --no-dds --real-time --frames " +
                              frames.string() + " 2> " + (folder_ / "said").string();
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  std::ostringstream said;
  said << std::ifstream(folder_ / "said").rdbuf();
  EXPECT_THAT(said.str(),
              HasSubstr("the schedule does not hold: rate group 'vision' has budgets of 42.600 ms in "
                        "a period of 20.000 ms"));
}

TEST_F(MissionFile, WithFramesOfAnotherSizeEndsTheFlightProgramWithTwo) {
  const std::filesystem::path frames = folder_ / "frames";
  Image small;
  small.resize(3, 2, PixelFormat::kGrey8);
  for (const char* camera : {"hdr1", "cam0", "cam2"}) {
    std::filesystem::create_directories(frames / camera);
    write_png(frames / camera / (std::string(camera) + "_000000.png"), small.view());
  }
  const std::string command = OMMA_RUN "omma-fsw " + file().string() + " --frames " + frames.string() +
                              " 2> " + (folder_ / "said").string();
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
}

}  // namespace
}  // namespace omma
