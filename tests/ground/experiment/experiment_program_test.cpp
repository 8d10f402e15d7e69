// `omma experiment` as a user runs it, in its short form, and its bad input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/ground/solve/run_omma.hpp"

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
