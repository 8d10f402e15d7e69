// `omma experiment` as a user runs it, in its short form, and its bad input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "components/geometry/pose.hpp"
#include "ground/format.hpp"
#include "ground/report/truth.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const std::string kConfig = OMMA_SOURCE_DIR "/config/experiments/";
const std::string kFiles =
    " --scenario " + kConfig + "earth_rotation_scenario.toml --mission " + kConfig + "earth_rotation.toml";

TEST(EarthRotation, IsAtTheBoundAndFarBelowTheDissertation) {
  const OperatorsFolder folder;
  const Told told = folder.omma("experiment earth-rotation" + kFiles + " --frames 24 --output run");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(folder.read("run/earth_rotation.json"));
  EXPECT_EQ(json["solved"], 24);
  EXPECT_EQ(json["pairings"]["wrong"], 0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(json["rms_over_bound"][axis].get<double>(), 1.6);  // 24 frame sets tell a deviation to 15 %
    EXPECT_LT(json["rms_arcsec"][axis].get<double>(), 25);
  }
  EXPECT_LT(json["derotated_rms_j2000_arcsec"][2].get<double>(), 25);
  EXPECT_LT(json["nees"]["mean"].get<double>(), 5);
  const std::string page = folder.read("run/earth_rotation.html");
  EXPECT_THAT(page, HasSubstr("Beside the dissertation"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("width=device-width"));                                    // a phone
  EXPECT_THAT(page, HasSubstr("@media print"));                                          // paper
  for (const char* outside : {"http:", "https:", "src='/", "href=", "@import", "url("})  // no network
    EXPECT_THAT(page, ::testing::Not(HasSubstr(outside)));
  EXPECT_FALSE(std::filesystem::exists(folder / "run/frames/hdr1"));  // the images are removed
  EXPECT_TRUE(std::filesystem::exists(folder / "run/frames/truth.jsonl"));
}

const std::string kDocking =
    " --scenario " + kConfig + "docking_scenario.toml --mission " + kConfig + "docking.toml";

TEST(OrientationDockingImaging, FindsAttitudeAndPoseAtTheBoundAndMakesThePanorama) {
  const OperatorsFolder folder;
  const Told told =
      folder.omma("experiment orientation-docking-imaging" + kDocking + " --frames 20 --output run");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(folder.read("run/docking.json"));
  EXPECT_EQ(json["pose"]["solved"], 20);
  EXPECT_EQ(json["attitude"]["solved"], 20);
  EXPECT_EQ(json["pairings"]["wrong"], 0);
  EXPECT_NEAR(json["pose"]["range_m"].get<double>(), 49 * 0.0254, 0.01);
  EXPECT_LT(json["pose"]["position_over_bound"].get<double>(), 1.6);      // 20 frame sets, one long axis
  EXPECT_LT(json["pose"]["position_rms_of_range"].get<double>(), 0.001);  // the dissertation has 0.018
  EXPECT_LT(json["pose"]["rotation_over_bound"].get<double>(), 1.5);
  EXPECT_THAT(folder.read("run/docking.html"), HasSubstr("Beside the dissertation"));
}

TEST(Repetition, StandsElsewhereInEachTrial) {
  const OperatorsFolder folder;
  const Told told = folder.omma("experiment repetition" + kDocking + " --frames 8 --trials 2 --output run");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(folder.read("run/repetition.json"));
  ASSERT_EQ(json["trials"].size(), 2U);
  EXPECT_EQ(json["trials"][1]["solved"], 8);
  EXPECT_NE(json["trials"][0]["bound_rms"], json["trials"][1]["bound_rms"]);
  EXPECT_THAT(folder.read("run/repetition.html"), HasSubstr("Position error of all trials"));
}

TEST(Docking, RefusesAScenarioWithoutACardAndAMissionWithoutABody) {
  const OperatorsFolder folder;
  const Told no_card = folder.omma("experiment repetition" + kFiles + " --frames 3 --output run");
  EXPECT_EQ(no_card.exit_code, 2);
  EXPECT_THAT(no_card.err,
              HasSubstr("earth_rotation_scenario.toml: card: expected at least one [[card]], found none"));
  const Told no_body = folder.omma("experiment orientation-docking-imaging --scenario " + kConfig +
                                   "docking_scenario.toml --mission " + kConfig +
                                   "earth_rotation.toml --frames 3 --output run");
  EXPECT_EQ(no_body.exit_code, 2);
  EXPECT_THAT(no_body.err, HasSubstr("body: expected at least one body"));
  EXPECT_EQ(folder.omma("experiment repetition" + kDocking + " --trials 1 --output run").exit_code, 2);
}

// What a truth camera beside the rig would have seen of its platform: another frame, another origin, and a
// clock that is a tenth of a second ahead.
std::string platform_table(const std::filesystem::path& truth) {
  const Pose rig_from_platform{rotation_exp({0.1, -0.7, 0.3}), {0.05, -0.12, 0.2}};
  const Pose camera_from_room{rotation_exp({0.9, 0.4, -0.2}), {0.3, 1.1, 2.0}};
  std::string text = "time_s,qx,qy,qz,qw,x_m,y_m,z_m\n";
  for (const ground::TruthFrame& frame : ground::read_truth(truth, 3)) {
    // The card stands still: it is the room.
    const Pose p = camera_from_room * frame.bodies.front().rig_from_body.inverse() * rig_from_platform;
    const Eigen::Quaterniond& q = p.rotation;
    const Eigen::Vector3d& t = p.translation;
    text +=
        ground::format("%.9f,%.12f,%.12f,%.12f,%.12f,%.9f,%.9f,%.9f\n", 1e-9 * double(frame.time_ns) + 0.1,
                       q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z());
  }
  return text;
}

TEST(EarthRotation, TakesARecordingAndJudgesItByItsTruthOrByARigAtRest) {
  const OperatorsFolder folder;
  const std::string mission = " --mission " + kConfig + "earth_rotation.toml";
  ASSERT_EQ(
      folder.omma("experiment earth-rotation" + kFiles + " --frames 12 --keep-frames --output run").exit_code,
      0);
  const Told again =
      folder.omma("experiment earth-rotation --recording run/frames" + mission + " --output again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto first = nlohmann::json::parse(folder.read("run/earth_rotation.json"));
  const auto second = nlohmann::json::parse(folder.read("again/earth_rotation.json"));
  EXPECT_EQ(first["rms_arcsec"], second["rms_arcsec"]);
  EXPECT_EQ(first["bound_rms_arcsec"], second["bound_rms_arcsec"]);
  EXPECT_EQ(second["recorded"], true);
  EXPECT_TRUE(std::filesystem::exists(folder / "run/frames/hdr1"));  // a recording is never removed

  std::filesystem::remove(folder / "run/frames/truth.jsonl");
  const Told alone =
      folder.omma("experiment earth-rotation --recording run/frames" + mission + " --output alone");
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("against a rig at rest, rig axes"));
  const auto third = nlohmann::json::parse(folder.read("alone/earth_rotation.json"));
  EXPECT_EQ(third["bound_from"], "own sigma");
  for (int axis = 0; axis < 3; ++axis) {  // twelve frame sets, less their mean
    EXPECT_GT(third["rms_over_bound"][axis].get<double>(), 0.4);
    EXPECT_LT(third["rms_over_bound"][axis].get<double>(), 1.6);
  }
}

TEST(Docking, TakesARecordingAndAPlatformThatATruthCameraWatched) {
  const OperatorsFolder folder;
  const std::string mission = " --mission " + kConfig + "docking.toml";
  ASSERT_EQ(folder
                .omma("experiment orientation-docking-imaging" + kDocking +
                      " --frames 40 --keep-frames --output run")
                .exit_code,
            0);
  const Told twice =
      folder.omma("experiment repetition --recording run/frames run/frames" + mission + " --output twice");
  ASSERT_EQ(twice.exit_code, 0) << twice.err;
  const auto trials = nlohmann::json::parse(folder.read("twice/repetition.json"));
  EXPECT_EQ(trials["trials"][0]["rms"], trials["trials"][1]["rms"]);  // the same frames
  EXPECT_EQ(trials["trials"][0]["solved"], 40);

  folder.write("platform.csv", platform_table(folder / "run/frames/truth.jsonl"));
  std::filesystem::remove(folder / "run/frames/truth.jsonl");
  const Told told =
      folder.omma("experiment orientation-docking-imaging --recording run/frames --platform platform.csv" +
                  mission + " --output watched");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const auto json = nlohmann::json::parse(folder.read("watched/docking.json"));
  EXPECT_EQ(json["reference"], "platform.csv");
  for (const char* by : {"by_attitude", "by_pose"}) {
    EXPECT_NEAR(json["platform"][by]["time_offset_s"].get<double>(), 0.1,
                4 * json["platform"][by]["time_offset_sigma_s"].get<double>() + 1e-3);
  }
  EXPECT_LT(json["platform"]["by_attitude"]["time_offset_sigma_s"].get<double>(), 0.02);
  EXPECT_GT(json["pose"]["position_over_bound"].get<double>(), 0.5);
  EXPECT_LT(json["pose"]["position_over_bound"].get<double>(), 1.4);
  EXPECT_LT(json["pose"]["position_rms_of_range"].get<double>(), 0.001);

  // Algorithm 8 by itself, on the log of this flight.
  const Told match = folder.omma(
      "compare-motion watched/flight.mcap platform.csv --body card --align both --time-offset --invert "
      "--output match");
  ASSERT_EQ(match.exit_code, 0) << match.err;
  const auto found = nlohmann::json::parse(folder.read("match/motion.json"));
  const auto& shift = found["left"]["translation_m"];
  EXPECT_NEAR(found["time_offset_s"].get<double>(), 0.1, 4 * found["time_offset_sigma_s"].get<double>());
  EXPECT_NEAR(shift[0].get<double>(), 0.05, 0.02);  // rig_from_platform
  EXPECT_NEAR(shift[1].get<double>(), -0.12, 0.02);
  EXPECT_NEAR(shift[2].get<double>(), 0.2, 0.02);
}

TEST(Recordings, ThatCannotBeUsedAreRefused) {
  const OperatorsFolder folder;
  const std::string mission = " --mission " + kConfig + "docking.toml --output out";
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("experiment " + arguments + mission);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
  };
  std::filesystem::create_directories(folder / "frames/hdr1");
  folder.write("frames/hdr1/hdr1_0.png", "no picture");
  folder.write("turns.csv", "time_s,qx,qy,qz,qw\n0,0,0,0,1\n1,0,0,0,1\n2,0,0,0,1\n");
  refused("earth-rotation", "one of --scenario and --recording, found neither");
  refused("earth-rotation --recording frames --scenario x", "one of --scenario and --recording, found both");
  refused("earth-rotation --recording none", "none/hdr1");
  refused("earth-rotation --recording frames", "frames/cam0");
  refused("earth-rotation --recording frames --frames 5", "--frames requires --scenario");
  refused("earth-rotation --recording frames frames", "--recording: At Most 1");
  refused("orientation-docking-imaging --recording frames",
          "truth.jsonl in the folder, or --platform, found neither");
  refused("orientation-docking-imaging --recording frames --platform none.csv", "none.csv: file");
  refused(
      "orientation-docking-imaging --recording frames --platform turns.csv",
      "turns.csv:1: heading: expected poses, with x_m,y_m,z_m behind the quaternion, found attitudes alone");
  refused("orientation-docking-imaging --recording frames --derotate", "--derotate requires --platform");
  refused("orientation-docking-imaging --scenario x --platform turns.csv", "--platform requires --recording");
  refused("repetition --recording frames", "at least two recordings to compare");
  refused("repetition --recording frames frames --platform turns.csv",
          "one for each --recording, found 1 for 2");
}

const std::string kDynamicRange = " --scenario " + kConfig + "dynamic_range_scenario.toml";

// Two frames and one blacklevel: the dimmest star of one frame, without and with the lamp. With the lamp
// stars are few, and one more or less is half a magnitude.
TEST(DynamicRange, ShowsTheDissertationsDimmestStars) {
  const OperatorsFolder folder;
  const Told told =
      folder.omma("experiment dynamic-range" + kDynamicRange + " --frames 2 --blacklevels 157 --output run");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(folder.read("run/dynamic_range.json"));
  ASSERT_EQ(json["sequences"].size(), 2U);
  EXPECT_NEAR(json["sequences"][0]["limits"][2]["dimmest_v"].get<double>(), 4.25, 0.3);
  EXPECT_NEAR(json["sequences"][1]["limits"][2]["dimmest_v"].get<double>(), 2.2, 0.7);
  EXPECT_EQ(json["transit"].size(), 8U);
  EXPECT_THAT(folder.read("run/dynamic_range.html"), HasSubstr("data:image/png;base64,"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run/b157_lamp_darken.png"));
}

TEST(DynamicRange, RefusesWhatItCannotUse) {
  const OperatorsFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("experiment dynamic-range --output run " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "run")) << arguments;
  };
  refused("", "--scenario or --recording");
  refused("--scenario " + kConfig + "docking_scenario.toml", "a logarithmic sensor");
  refused("--recording images", "the camera's lens file");
  refused("--recording images --lens " OMMA_SOURCE_DIR "/config/lenses/hdr1_f3.0mm_10um_768x576.txt",
          "a folder of images");
  std::filesystem::create_directories(folder / "images");
  refused("--recording images --lens " OMMA_SOURCE_DIR "/config/lenses/hdr1_f3.0mm_10um_768x576.txt",
          "at least one PNG");
  folder.write("images/a.png", "no picture");
  refused("--recording images --lens " OMMA_SOURCE_DIR "/config/lenses/hdr1_f3.0mm_10um_768x576.txt",
          "a.png");
}

TEST(EarthRotation, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  EXPECT_EQ(folder.omma("experiment").exit_code, 2);
  EXPECT_EQ(folder.omma("experiment earth-rotation --output x").exit_code, 2);
  const Told lost = folder.omma("experiment earth-rotation --scenario no.toml --mission no.toml --output x");
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_THAT(lost.err, HasSubstr("no.toml"));
  folder.write("mission.toml", "spacecraft = 5\n");
  const Told wrong = folder.omma("experiment earth-rotation --scenario " + kConfig +
                                 "earth_rotation_scenario.toml --mission mission.toml --frames 3 --output x");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("mission.toml:1: spacecraft"));
  EXPECT_EQ(folder.omma("experiment earth-rotation" + kFiles + " --frames 2 --output x").exit_code, 2);
}

}  // namespace
}  // namespace omma
