// `omma experiment` as a user runs it, in its short form, and its bad input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

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
  refused("", "--scenario or --recorded");
  refused("--scenario " + kConfig + "docking_scenario.toml", "a logarithmic sensor");
  refused("--recorded images", "the camera's lens file");
  refused("--recorded images --lens " OMMA_SOURCE_DIR "/config/lenses/hdr1_f3.0mm_10um_768x576.txt",
          "a folder of images");
  std::filesystem::create_directories(folder / "images");
  refused("--recorded images --lens " OMMA_SOURCE_DIR "/config/lenses/hdr1_f3.0mm_10um_768x576.txt",
          "at least one PNG");
  folder.write("images/a.png", "no picture");
  refused("--recorded images --lens " OMMA_SOURCE_DIR "/config/lenses/hdr1_f3.0mm_10um_768x576.txt", "a.png");
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
