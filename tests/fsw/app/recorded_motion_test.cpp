// The gimbal's part of the shim: a flight whose axes are recorded tells what they did in the flight that
// recorded them, whatever its own trajectory says; recordings that are none are named.
#include <gmock/gmock.h>

#include "components/motion/motion_files.hpp"
#include "components/telemetry/mcap_reader.hpp"
#include "fsw/app/flight.hpp"
#include "fsw/app/recorded_motion_file.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/fsw/app/mission_file.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

constexpr int kFrameSets = 4;
constexpr const char* kRecording = "recording = \"lab.mcap\"";

/// The lab's mission, over frames of a dark room.
class RecordedGimbal : public MissionFile {
 protected:
  void SetUp() override {
    MissionFile::SetUp();
    const Mission mission = read_mission(lab());
    for (std::size_t c = 0; c < mission.rig.cameras.size(); ++c) {
      const RigCamera& camera = mission.rig.cameras[c];
      const std::string name(camera.name.view());
      Image dark;
      dark.resize(camera.lens.width(), camera.lens.height(),
                  mission.cameras[c].bits > 8 ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
      std::fill(dark.pixels.begin(), dark.pixels.end(), std::byte{0});
      std::filesystem::create_directories(folder_ / "frames" / name);
      for (int n = 0; n < kFrameSets; ++n)
        write_png(folder_ / "frames" / name / (name + "_" + std::to_string(n) + ".png"), dark.view(),
                  PngEffort::kFast);
    }
  }
  std::filesystem::path lab() const { return folder_ / "lab.toml"; }

  void fly(const std::string& log) const {
    FlightOptions options;
    options.frames = (folder_ / "frames").string();
    options.log = (folder_ / log).string();
    options.no_dds = true;
    Flight(read_mission(lab()), options).run();
  }
  void play_recorded() const {
    replace("lab.toml", "driver = \"simulated\"             # the lab's: driver = \"maestro\"",
            "driver = \"recorded\"");
  }
  void play_back(const std::string& recording) const {
    play_recorded();
    replace("lab.toml", kRecording, "recording = \"" + recording + "\"");
  }
  /// The samples of the motion as they were sent.
  std::vector<std::string> motion(const std::string& log) const {
    mcap::Reader reader((folder_ / log).string());
    std::vector<std::string> samples;
    reader.for_each_message([](const mcap::Channel& channel) { return channel.topic.ends_with("/motion"); },
                            [&](const mcap::MessageView& message) {
                              samples.emplace_back(reinterpret_cast<const char*>(message.data.data()),
                                                   message.data.size());
                              return true;
                            });
    return samples;
  }
  std::string refusal() const {
    return refusal_of([&] { read_mission(lab()); });
  }
};

TEST_F(RecordedGimbal, TellsTheSameMotionAsTheFlightThatRecordedIt) {
  fly("flown.mcap");
  play_back("flown.mcap");
  // Another trajectory: what is told is not made anew.
  std::ofstream(folder_ / "trajectories" / "three_axes.csv") << "time_s,z_deg\n0,5\n60,6\n";
  fly("replayed.mcap");
  EXPECT_EQ(motion("flown.mcap").size(), std::size_t{kFrameSets});
  EXPECT_EQ(motion("replayed.mcap"), motion("flown.mcap"));
  // And a recording of a recorded motion is one as good.
  replace("lab.toml", "recording = \"flown.mcap\"", "recording = \"replayed.mcap\"");
  fly("again.mcap");
  EXPECT_EQ(motion("again.mcap"), motion("flown.mcap"));
}

TEST_F(RecordedGimbal, TellsATableOfAngles) {
  std::ofstream(folder_ / "told.csv") << "time_s,z_deg,x_deg\n0,0,10\n0.54,20,10\n1.08,20,30\n";
  play_back("told.csv");
  fly("told.mcap");
  EXPECT_EQ(motion("told.mcap").size(), 3U);  // it says nothing of the fourth frame set
  const RecordedMotion back =
      read_recorded_motion(folder_ / "told.mcap", read_gimbal_file(folder_ / "gimbals/dissertation.toml"));
  MotionReport report;
  back.tell(1, 0, report);
  constexpr double kDegree = 0.017453292519943295;
  EXPECT_NEAR(report.axes[0].state.angle, 20 * kDegree, 1e-12);
  back.tell(2, 0, report);
  EXPECT_NEAR(report.axes[2].state.angle, 30 * kDegree, 1e-12);
}

TEST_F(RecordedGimbal, WithoutARecordingIsRefused) {
  play_recorded();
  replace("lab.toml", kRecording, "");
  EXPECT_THAT(refusal(),
              HasSubstr("motion.recording: expected a flight's recording (.mcap) or a table (.csv) of "
                        "what the axes did, found nothing"));
}

TEST_F(RecordedGimbal, MistakesInItsRecordingAreNamed) {
  play_back("none.mcap");
  EXPECT_THAT(refusal(), HasSubstr("none.mcap"));
  std::ofstream(folder_ / "none.mcap") << "no recording";
  EXPECT_THAT(refusal(), HasSubstr("none.mcap"));
  replace("lab.toml", "none.mcap", "none.txt");
  EXPECT_THAT(refusal(),
              HasSubstr("none.txt: recording: expected a name that ends in .mcap or .csv, found .txt"));
  replace("lab.toml", "none.txt", "none.csv");
  std::ofstream(folder_ / "none.csv") << "time_s,w_deg\n0,1\n";
  EXPECT_THAT(refusal(), HasSubstr("none.csv:1: column 2: expected time_s or an axis of the gimbal (z_deg"));
}

TEST_F(RecordedGimbal, OfAnotherGimbalIsRefused) {
  fly("flown.mcap");
  const std::vector<GimbalAxis> gimbal = read_gimbal_file(folder_ / "gimbals/dissertation.toml");
  EXPECT_THAT(refusal_of([&] { read_recorded_motion(folder_ / "flown.mcap", {gimbal[0]}); }),
              HasSubstr("flown.mcap: axes: expected those of the gimbal, z, found 3"));
  std::vector<GimbalAxis> renamed = gimbal;
  renamed[1].name = Name("pitch");
  EXPECT_THAT(refusal_of([&] { read_recorded_motion(folder_ / "flown.mcap", renamed); }),
              HasSubstr("found 3 without pitch"));
}

}  // namespace
}  // namespace omma
