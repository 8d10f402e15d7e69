// Commands end to end: the flight program in real time and the ground's `omma command`, processes of their
// own, over DDS on this machine alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "components/geometry/rig_file.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/ground/loopback_dds.hpp"
#include "tests/ground/run_program.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The flight program, or another, until this goes.
class Flight {
 public:
  Flight(const std::string& arguments, const fs::path& said, const std::string& program = "omma-fsw") {
    const std::string command = "exec " OMMA_RUN + program + " " + arguments + " >" + said.string() + " 2>&1";
    std::string words[] = {"sh", "-c", command};
    char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    EXPECT_EQ(posix_spawn(&process_, "/bin/sh", nullptr, nullptr, argv, environ), 0);
  }
  ~Flight() { stop(); }
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  /// As a service manager does. @return the exit code
  int stop() {
    if (process_ == 0) return exit_code_;
    kill(process_, SIGTERM);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return exit_code_;
  }

 private:
  pid_t process_ = 0;
  int exit_code_ = -1;
};

class LiveCommands : public testing::Test {
 protected:
  LiveCommands() {
    test::use_loopback_dds();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write_mission();
    write_dark_frames();
  }
  ~LiveCommands() override { fs::remove_all(folder_); }

  int domain() const { return 100 + static_cast<int>(getpid() % 90); }
  test::ProgramRun command(const std::string& words) const {
    return test::run_omma("command --wait 40 --domain " + std::to_string(domain()) + " " + words);
  }
  std::string flight_arguments() const {
    return (folder_ / "mission.toml").string() + " --real-time --rounds 100000 --frames " +
           (folder_ / "frames").string() + " --parameters " + (folder_ / "parameters").string();
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("omma_live_commands_" + std::to_string(getpid()));

 private:
  void write_mission() const {
    const std::string config = OMMA_SOURCE_DIR "/config/";
    std::string text = text_of(config + "demo.toml");
    const auto insert = [&text](const std::string& after, const std::string& what) {
      text.insert(text.find(after) + after.size(), what);
    };
    insert("\nrig = \"", config);
    insert("\ntargets = \"", config);
    insert("spacecraft = \"demo\"\n", "dds_domain = " + std::to_string(domain()) + "\n");
    std::ofstream(folder_ / "mission.toml") << text;
  }
  void write_dark_frames() const {
    for (const RigCamera& camera : read_rig_file(OMMA_SOURCE_DIR "/config/rigs/dissertation.toml").cameras) {
      const std::string name(camera.name.view());
      Image image;
      image.resize(camera.lens.width(), camera.lens.height(),
                   name == "hdr1" ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
      fs::create_directories(folder_ / "frames" / name);
      write_png(folder_ / "frames" / name / (name + "_000000.png"), image.view());
    }
  }
};

TEST_F(LiveCommands, AreListedAnsweredRejectedCarriedOutAndKeptForTheNextStart) {
  {
    Flight flight(flight_arguments(), folder_ / "said");
    const test::ProgramRun list = command("");
    EXPECT_EQ(list.exit_code, 0) << list.output << text_of(folder_ / "said");
    EXPECT_THAT(list.output, HasSubstr("set_parameter <parameter> <value>"));
    EXPECT_THAT(list.output, HasSubstr("extractor.threshold.cam0"));

    const test::ProgramRun good = command("no_operation");
    EXPECT_EQ(good.exit_code, 0) << good.output;
    EXPECT_EQ(good.output, "1 no_operation: accepted\n1 no_operation: completed\n");
    const test::ProgramRun beyond = command("set_parameter tracker.gate_chi2 5000");
    EXPECT_EQ(beyond.exit_code, 1);
    EXPECT_EQ(beyond.output,
              "2 set_parameter tracker.gate_chi2 5000: rejected: value is 5000, and must be a number 1 to "
              "1000\n");
    EXPECT_EQ(command("set_parameter tracker.patience 7").exit_code, 0);
    EXPECT_THAT(command("commit_parameters").output, HasSubstr("commit_parameters: completed"));
    EXPECT_THAT(text_of(folder_ / "parameters" / "parameters.a"), HasSubstr("tracker.patience 7\n"));

    EXPECT_EQ(command("set_mode safe").exit_code, 0);
    EXPECT_THAT(command("start_picture").output, HasSubstr("rejected: not in the present mode"));
    const test::ProgramRun monitor =
        test::run_omma("monitor --once --wait 20 --domain " + std::to_string(domain()));
    EXPECT_THAT(monitor.output, HasSubstr("mode SAFE since"));

    const test::ProgramRun unknown = command("explode");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.output,
                HasSubstr("omma: command: command: expected the name of a command, found \"explode\""));
    EXPECT_EQ(flight.stop(), 0) << text_of(folder_ / "said");
  }
  Flight again(flight_arguments(), folder_ / "said");
  EXPECT_THAT(command("no_operation").output, HasSubstr("1 no_operation: completed"));
  EXPECT_EQ(again.stop(), 0);
  EXPECT_THAT(text_of(folder_ / "said"),
              HasSubstr("parameters.a: tracker.patience = 7 (the mission says 3)"));
}

constexpr int kRampSide = 48;

std::uint16_t ramp(int u, int v) {
  return static_cast<std::uint16_t>(1000 + 20 * u + 3 * v);
}

TEST_F(LiveCommands, PicturesAreAskedForHeardAndPutTogether) {
  std::string mission = text_of(folder_ / "mission.toml");
  const std::string width = "panorama_width = 1200";
  mission.replace(mission.find(width), width.size(),
                  "panorama_width = 128\nview_width = 96\nview_height = 64");
  std::ofstream(folder_ / "mission.toml") << mission;
  const fs::path frame = folder_ / "frames" / "hdr1" / "hdr1_000000.png";
  Image image = read_image(frame);
  image.white_level = 4095;
  for (int v = 0; v < kRampSide; ++v)
    for (int u = 0; u < kRampSide; ++u)
      reinterpret_cast<std::uint16_t*>(image.pixels.data())[(v + 80) * image.width + u + 100] = ramp(u, v);
  write_png(frame, image.view());

  const std::string at = " --domain " + std::to_string(domain());
  const std::string pass = (folder_ / "pass.mcap").string();
  Flight flight(flight_arguments(), folder_ / "said");
  EXPECT_EQ(command("no_operation").exit_code, 0) << text_of(folder_ / "said");
  {
    Flight record("record " + pass + at, folder_ / "recorded", "omma");
    std::this_thread::sleep_for(std::chrono::seconds(2));  // until it listens
    EXPECT_THAT(command("request_picture view_rig 30 -10 40").output,
                HasSubstr("request_picture view_rig 30 -10 40: completed"));
    EXPECT_THAT(command("request_region 0 100 80 " + std::to_string(kRampSide)).output,
                HasSubstr(": completed"));
    const test::ProgramRun beyond = command("request_region 0 700 80 100");
    EXPECT_EQ(beyond.exit_code, 1);
    EXPECT_THAT(beyond.output, HasSubstr("size"));
    const test::ProgramRun wide = command("request_picture view 0 0 179");
    EXPECT_EQ(wide.exit_code, 1);
    EXPECT_THAT(wide.output, HasSubstr("field"));
    std::this_thread::sleep_for(std::chrono::seconds(3));
  }
  EXPECT_EQ(flight.stop(), 0) << text_of(folder_ / "said");
  const test::ProgramRun images =
      test::run_omma("images " + pass + " --out " + (folder_ / "pictures").string());
  EXPECT_THAT(images.output, HasSubstr("30.00 -10.00, 40.00 deg"));
  EXPECT_THAT(images.output, HasSubstr("camera 0 from 100, 80"));
  bool found = false;
  for (const auto& entry : fs::directory_iterator(folder_ / "pictures")) {
    if (!entry.path().string().ends_with("_camera.png")) continue;
    found = true;
    const Image region = read_image(entry.path());
    EXPECT_EQ(region.white_level, 4095);
    ASSERT_EQ(region.width, kRampSide);
    for (int v = 0; v < kRampSide; ++v)
      for (int u = 0; u < kRampSide; ++u) ASSERT_EQ(region.view().row<std::uint16_t>(v)[u], ramp(u, v));
  }
  EXPECT_TRUE(found) << images.output;
}

TEST_F(LiveCommands, SilenceAndABadDictionaryAreSentences) {
  const test::ProgramRun silence =
      test::run_omma("command no_operation --wait 0.3 --domain " + std::to_string(domain()));
  EXPECT_EQ(silence.exit_code, 1);
  EXPECT_THAT(silence.output, HasSubstr("no spacecraft was heard in domain"));
  std::ofstream(folder_ / "bad.json") << "{\"commands\": 3";
  const test::ProgramRun bad = test::run_omma("command --dictionary " + (folder_ / "bad.json").string());
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.output, HasSubstr("bad.json: dictionary: expected what `omma-fsw MISSION --dictionary`"));
  EXPECT_EQ(test::run_omma("command --dictionary /no/such/file").exit_code, 2);
  const std::string file = (folder_ / "dictionary.json").string();
  const test::ProgramRun told = test::run_program(OMMA_RUN "omma-fsw " + (folder_ / "mission.toml").string() +
                                                  " --dictionary >" + file);
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_THAT(test::run_omma("command --dictionary " + file).output, HasSubstr("search_again"));
}

}  // namespace
}  // namespace omma::ground
