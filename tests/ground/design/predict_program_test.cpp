// `omma predict` as a user runs it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const std::string kRig = "--rig " OMMA_SOURCE_DIR "/config/rigs/dissertation.toml ";
const std::string kCard = "--targets " OMMA_SOURCE_DIR "/config/targets/docking_card.tsv ";

TEST(PredictProgram, TellsAttitudeWithAndWithoutCalibration) {
  const OperatorsFolder folder;
  folder.write("errors.toml", "lens_scale = 1e-3\n");
  const Told told =
      folder.omma("predict " + kRig + "--errors errors.toml --attitudes 20 --magnitude 4 --check 60 --json");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const auto attitude = nlohmann::json::parse(told.out)["attitude"];
  EXPECT_GT(attitude["sigma_rad"]["median"], attitude["noise_sigma_rad"]["median"]);
  EXPECT_EQ(attitude["check"]["solved"], 60);
  EXPECT_NEAR(attitude["check"]["rotation_rms_over_predicted"].get<double>(), 1, 0.3);
}

TEST(PredictProgram, TellsPosesBeforeEachCamera) {
  const OperatorsFolder folder;
  const Told told = folder.omma("predict " + kRig + kCard + "--range 0.5,2 --tilt 20 --check 30");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("docking_card 2.000 m before cam2"));
  EXPECT_THAT(told.out, HasSubstr("30 of 30 solved"));
}

TEST(PredictProgram, SaysWhatIsNotObservable) {
  const OperatorsFolder folder;
  folder.write("two.tsv", "A\t0\t0\t0\t1\t1\nB\t0.1\t0\t0\t1\t1\n");
  const Told told = folder.omma("predict " + kRig + "--targets two.tsv");
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_THAT(told.out, HasSubstr("not observable"));
}

TEST(PredictProgram, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  folder.write("bad.toml", "lens_scale = -1\n");
  folder.write("unknown.toml", "lens_scael = 1e-3\n");
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma(arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
    EXPECT_EQ(told.out, "") << arguments;
  };
  refused("predict", "--rig");
  refused("predict --rig nowhere.toml", "nowhere.toml");
  refused("predict " + kRig + "--errors bad.toml", "lens_scale");
  refused("predict " + kRig + "--errors unknown.toml", "lens_scael");
  refused("predict " + kRig + "--errors nowhere.toml", "nowhere.toml");
  refused("predict " + kRig + "--targets nowhere.tsv", "nowhere.tsv");
  refused("predict " + kRig + "--field 100,100", "one field of view, or one for each camera");
  refused("predict " + kRig + "--dot-sigma 0", "--dot-sigma");
  refused("predict " + kRig + "--check 0", "--check");
}

}  // namespace
}  // namespace omma
