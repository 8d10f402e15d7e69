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
#include "tests/fsw/app/mission_file.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

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

constexpr const char* kMotionTable =
    "[motion]\ndriver = \"simulated\"\ngimbal = \"gimbals/dissertation.toml\"\ntrajectory = "
    "\"trajectories/three_axes.csv\"\n";

TEST_F(MissionFile, MayMoveAGimbal) {
  EXPECT_FALSE(read_mission(file()).motion);
  replace("demo.toml", "[imaging]", std::string(kMotionTable) + "\n[imaging]");
  const Mission mission = read_mission(file());
  ASSERT_TRUE(mission.motion);
  ASSERT_EQ(mission.motion->axes.size(), 3U);
  EXPECT_EQ(mission.motion->axes[1].axis.name.view(), "y");
  EXPECT_EQ(mission.motion->beats_per_frame_set, 20U);
  EXPECT_EQ(mission.motion->period_ns(), 5'000'000);
}

TEST_F(MissionFile, MistakesInItsMotionAreNamed) {
  const std::string table = kMotionTable;
  replace("demo.toml", "[imaging]", table + "rate_hz = 200\nchannels = 12\n[imaging]");
  const auto refusal = [&](const std::string& from, const std::string& to) {
    replace("demo.toml", from, to);
    const std::string said = message();
    replace("demo.toml", to, from);
    return said;
  };
  EXPECT_THAT(refusal("\"simulated\"", "\"dynamixel\""),
              HasSubstr("motion.driver: expected \"recorded\", \"simulated\" or \"maestro\""));
  EXPECT_THAT(refusal("\"simulated\"", "\"maestro\""), HasSubstr("motion.device: expected the serial line"));
  EXPECT_THAT(refusal("rate_hz = 200", "rate_hz = 125"), HasSubstr("a whole multiple of frame_rate_hz"));
  EXPECT_THAT(refusal("rate_hz = 200", "rate_hz = 5"), HasSubstr("a whole multiple of frame_rate_hz"));
  EXPECT_THAT(refusal("channels = 12", "channels = 2"),
              HasSubstr("motion.channels: expected the channel of every axis"));
  EXPECT_THAT(refusal("gimbals/dissertation", "gimbals/other"),
              HasSubstr("other.toml: file: expected a TOML file"));
  EXPECT_THAT(refusal("three_axes.csv", "four_axes.csv"), HasSubstr("no such file"));
  EXPECT_THAT(refusal("channels = 12", "chanels = 12"), HasSubstr("unknown key"));
}

TEST_F(MissionFile, OfTheLabSwitchesEachPartByOneWord) {
  const std::filesystem::path lab = folder_ / "lab.toml";
  const Mission simulated = read_mission(lab);
  EXPECT_EQ(simulated.trigger.driver, TriggerKind::kSimulated);
  ASSERT_TRUE(simulated.motion);
  EXPECT_EQ(simulated.motion->driver, ServoKind::kSimulated);
  EXPECT_EQ(simulated.motion->beats_per_frame_set, 108U);
  replace("lab.toml",
          "[trigger]                        # the lab's line was a digital output of the Maestro: driver = "
          "\"maestro\"\ndriver = \"simulated\"",
          "[trigger]\ndriver = \"gpiod\"");
  replace("lab.toml", "driver = \"simulated\"             # the lab's: ", "");
  const Mission real = read_mission(lab);
  EXPECT_EQ(real.trigger.driver, TriggerKind::kGpiod);
  EXPECT_EQ(real.trigger.gpiod.line, "frame_sync");
  EXPECT_EQ(real.trigger.gpiod.pulse.width_ns, 1'000'000);
  EXPECT_EQ(real.motion->driver, ServoKind::kMaestro);
  EXPECT_TRUE(has_trigger_line(real) && has_servo_board(real));
  EXPECT_FALSE(has_trigger_line(simulated) || has_servo_board(simulated));
  EXPECT_THROW(servo_driver(real, {.lockstep = true}), InputError);  // no servo follows a replay
  EXPECT_THROW(trigger_driver(real, {.lockstep = true}, nullptr), InputError);
  EXPECT_EQ(real.motion->maestro.device, "/dev/ttyACM0");
}

TEST_F(MissionFile, MistakesInItsTriggerAreNamed) {
  replace("demo.toml", "[imaging]",
          "[trigger]\ndriver = \"gpiod\"\nchip = \"gpiochip0\"\nline = \"3\"\nwidth_ms = 2\npolarity = "
          "\"rising\"\n[imaging]");
  EXPECT_EQ(message(), "no error");
  const auto refusal = [&](const std::string& from, const std::string& to) {
    replace("demo.toml", from, to);
    const std::string said = message();
    replace("demo.toml", to, from);
    return said;
  };
  EXPECT_THAT(refusal("\"gpiod\"", "\"usb\""),
              HasSubstr("trigger.driver: expected \"recorded\", \"simulated\""));
  EXPECT_THAT(refusal("\"gpiod\"", "\"maestro\""), HasSubstr("trigger.channel: expected the channel"));
  EXPECT_THAT(refusal("chip = \"gpiochip0\"", "chip = \"\""),
              HasSubstr("trigger.chip: expected a GPIO chip"));
  EXPECT_THAT(refusal("line = \"3\"", "line = \"\""), HasSubstr("trigger.line: expected a line"));
  EXPECT_THAT(refusal("width_ms = 2", "width_ms = 100"),
              HasSubstr("trigger.width_ms: expected less than the period of the frame sets, 100.000000 ms"));
  EXPECT_THAT(refusal("\"rising\"", "\"both\""), HasSubstr("trigger.polarity: expected \"rising\" or"));
  EXPECT_THAT(refusal("width_ms", "witdh_ms"), HasSubstr("unknown key"));
}

TEST_F(MissionFile, MaySayWhereTheRigIs) {
  replace("demo.toml", "[tracker]", "[observer]\nsite = \"36.1,-97.1,290\"\n\n[tracker]");
  const Mission grounded = read_mission(file());
  ASSERT_TRUE(grounded.tracker.observer.site);
  EXPECT_NEAR(*grounded.tracker.observer.site->pressure, 979, 1);  // of a standard atmosphere
  replace("demo.toml", "site = \"36.1,-97.1,290\"",
          "[observer.orbit]\nsemi_major_axis_km = 6878\ninclination_deg = 97\nascending_node_deg = 40");
  EXPECT_TRUE(read_mission(file()).tracker.orbit);
}

TEST_F(MissionFile, WithAPlaceThatCannotBeIsRefused) {
  replace("demo.toml", "[tracker]", "[observer]\nsite = \"here\"\n\n[tracker]");
  EXPECT_THAT(message(), HasSubstr("observer.site: expected \"LAT,LON,HEIGHT\""));
  replace("demo.toml", "site = \"here\"", "sigma_m = 5");
  EXPECT_THAT(message(), HasSubstr("observer.site: expected a site on the ground or an [observer.orbit]"));
  replace("demo.toml", "sigma_m = 5", "site = \"36,-97,290\"");
  replace("demo.toml", "epoch = \"2026", "# epoch = \"2026");
  EXPECT_THAT(message(), HasSubstr("observer.site: expected an epoch"));
}

TEST_F(MissionFile, WithAFilterThatDoesNotExistIsRefused) {
  replace("demo.toml", "[imaging]", "[attitude]\nfilter = \"ekf\"\n\n[imaging]");
  EXPECT_THAT(message(), HasSubstr("filter: expected \"none\" or \"mekf\", found ekf"));
}

TEST_F(MissionFile, MayAskForACompositeOfPartOfTheSkyCompressed) {
  replace("demo.toml", "[imaging]",
          "[imaging]\nkind = \"fisheye_j2000\"\npan_deg = 90\ncomposite = \"darkest\"\ncomposed = "
          "12\ncompress = true");
  const Mission mission = read_mission(file());
  EXPECT_EQ(mission.imaging.kind, ImageKind::kFisheyeJ2000);
  EXPECT_EQ(mission.imaging.composite, ImageComposite::kDarkest);
  EXPECT_EQ(mission.imaging.composed, 12);
  EXPECT_TRUE(mission.imaging.compress);
  EXPECT_NEAR(mission.imaging.pan, 1.5708, 1e-4);
}

TEST_F(MissionFile, WithAPictureThatCannotBeMadeIsRefused) {
  replace("demo.toml", "[imaging]", "[imaging]\nkind = \"mercator\"");
  EXPECT_THAT(message(),
              HasSubstr("imaging.kind: expected \"panorama_j2000\", \"panorama_rig\", \"view\", "
                        "\"fisheye_j2000\", \"fisheye_rig\", \"camera\" or \"view_rig\", found mercator"));
  SetUp();
  replace("demo.toml", "[imaging]", "[imaging]\ncomposite = \"fused\"\nfused_bits = 17");
  EXPECT_THAT(message(), HasSubstr("imaging.fused_bits: expected a whole number from 8 to 16"));
  SetUp();
  replace("demo.toml", "[imaging]",
          "[imaging]\nkind = \"camera\"\ncomposite = \"fused\"\ncamera = \"cam0\"\nregion_px = [0, 0, 9, 9]");
  EXPECT_THAT(message(), HasSubstr("imaging.composite: expected no \"fused\" where kind is \"camera\""));
  SetUp();
  replace("demo.toml", "[imaging]", "[imaging]\ncomposed = 5");
  EXPECT_THAT(message(), HasSubstr("imaging.composed: expected "));
  SetUp();
  replace("demo.toml", "[imaging]",
          "[imaging]\nkind = \"camera\"\ncamera = \"cam1\"\nregion_px = [0, 0, 9, 9]");
  EXPECT_THAT(message(), HasSubstr("imaging.camera: expected a camera of the rig dissertation, found cam1"));
  SetUp();
  replace("demo.toml", "[imaging]",
          "[imaging]\nkind = \"camera\"\ncamera = \"cam2\"\nregion_px = [600, 0, 64, 9]");
  EXPECT_THAT(message(),
              HasSubstr("imaging.region_px: expected left, top, width, height within 640 x 480, found "
                        "a region beyond it"));
}

TEST_F(MissionFile, WithSurveillanceThatCannotBeIsRefused) {
  replace("demo.toml", "[imaging]", "[surveillance]\nlargest_rate_deg_s = 1.5\npatience = 20\n\n[imaging]");
  EXPECT_EQ(read_mission(file()).surveillance.patience, 20);
  SetUp();
  replace("demo.toml", "[imaging]", "[surveillance]\nlargest_rate_deg_s = 0\n\n[imaging]");
  EXPECT_THAT(message(), HasSubstr("surveillance.largest_rate_deg_s: expected "));
  SetUp();
  replace("demo.toml", "[imaging]", "[surveillance]\nradar = true\n\n[imaging]");
  EXPECT_THAT(message(), HasSubstr("surveillance.radar: expected "));
}

TEST_F(MissionFile, MayAskForWindowsBetweenWholeSearches) {
  EXPECT_EQ(read_mission(file()).lookout.full_search_every, 1);
  replace("demo.toml", "[imaging]", "[lookout]\nfull_search_every = 10\n\n[imaging]");
  EXPECT_EQ(read_mission(file()).lookout.full_search_every, 10);
  SetUp();
  replace("demo.toml", "[imaging]", "[lookout]\nfull_search_every = 0\n\n[imaging]");
  EXPECT_THAT(message(), HasSubstr("lookout.full_search_every: expected "));
  SetUp();
  replace("demo.toml", "[imaging]", "[lookout]\nbinoculars = true\n\n[imaging]");
  EXPECT_THAT(message(), HasSubstr("lookout.binoculars: expected "));
}

TEST_F(MissionFile, SaysHowWrongTheCalibrationMayBe) {
  replace("demo.toml", "[tracker]",
          "[calibration_error]\nlens_scale = 2e-4\nsurvey_m = 1e-4\n\n[integrity]\nrisk = 1e-6\n\n[tracker]");
  const Mission mission = read_mission(file());
  EXPECT_EQ(mission.attitude.integrity.calibration.lens_scale, 2e-4);
  EXPECT_EQ(mission.pose.integrity.calibration.survey, 1e-4);
  EXPECT_EQ(mission.pose.integrity.risk, 1e-6);
  EXPECT_NEAR(mission.pose.axes[1].z(), -1.0 / 3, 1e-6);  // cam0 of the dissertation's rig
}

TEST_F(MissionFile, WithANegativeCalibrationErrorIsRefused) {
  replace("demo.toml", "[tracker]", "[calibration_error]\ncamera_rotation_deg = -0.1\n\n[tracker]");
  EXPECT_THAT(message(), AllOf(HasSubstr("demo.toml"), HasSubstr("camera_rotation_deg"), HasSubstr("-0.1")));
}

TEST_F(MissionFile, WithAnIntegrityRiskOfNothingIsRefused) {
  replace("demo.toml", "[tracker]", "[integrity]\nrisk = 0\n\n[tracker]");
  EXPECT_THAT(message(), AllOf(HasSubstr("demo.toml"), HasSubstr("risk")));
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
  EXPECT_EQ(dictionary.at("rate_groups").at(0).at("components").size(), 18U);
  EXPECT_THAT(dictionary.at("idl").get<std::string>(), HasSubstr("struct Attitude"));
}

TEST_F(MissionFile, MayMixRecordedAndLiveCameras) {
  replace(
      "demo.toml", "driver = \"recorded\"\nbits = 12",
      "driver = \"v4l2\"\ndevice = \"navcam0\"\nformat = \"Y16\"\nbits = 12\nbayer = \"green\"\nmemory = "
      "\"dma-buf\"\nmemory_from = \"/dev/dma_heap/linux,cma\"\n"
      "controls = { exposure = 100, trigger = \"External\" }\ncontrol_names = { exposure = \"shutter\" }");
  const Mission mission = read_mission(file());
  EXPECT_TRUE(has_live_cameras(mission));
  const CameraSetup& setup = mission.cameras[0].setup;
  EXPECT_EQ(setup.device, "navcam0");
  EXPECT_EQ(setup.width, 768);
  EXPECT_EQ(setup.bits, 12);
  EXPECT_EQ(setup.bayer, BayerUse::kGreen);
  EXPECT_TRUE(setup.dma_buf);
  EXPECT_EQ(setup.memory_from, "/dev/dma_heap/linux,cma");
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
  replace("demo.toml", "memory = \"paper\"", "memory_from = \"/dev/dma_heap/system\"");
  EXPECT_THAT(message(),
              HasSubstr("camera[0].memory_from: expected memory = \"dma-buf\" beside it, found mmap"));
  replace("demo.toml", "memory_from = \"/dev/dma_heap/system\"", "bayer = \"blue\"");
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
              HasSubstr("the schedule does not hold: rate group 'vision' has budgets of 47.700 ms in "
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
