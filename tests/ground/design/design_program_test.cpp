// `omma design` and `omma stars` as a user runs them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const std::string kRig = OMMA_SOURCE_DIR "/config/rigs/dissertation.toml";
const std::string kCard = OMMA_SOURCE_DIR "/config/targets/docking_card.tsv";

TEST(DesignProgram, PrintsTheTableOfSymmetricRigs) {
  const OperatorsFolder folder;
  const Told told = folder.omma("design");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  for (const char* field : {"191.4", "193.2", "154.8", "140.4", "123.8"})
    EXPECT_THAT(told.out, HasSubstr(field));
}

TEST(DesignProgram, WritesAPageAPictureAndFiguresOfARig) {
  const OperatorsFolder folder;
  const Told told = folder.omma("design --rig " + kRig + " --field 152.8,187,187 --targets " + kCard +
                                " --output study --json");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const auto json = nlohmann::json::parse(told.out);
  EXPECT_NEAR(json["rig"]["coverage_at_infinity"]["seen_share"].get<double>(), 0.907, 0.01);
  EXPECT_EQ(json["rig"]["coverage_at_infinity"]["blind_spots"].size(), 1U);  // the tetrahedron's empty face
  EXPECT_EQ(json["rig"]["cameras"][0]["pose"]["targets"], 25);
  const std::string page = folder.read("study/design.html");
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(folder.read("study/design.json")), json);
}

TEST(DesignProgram, WritesASymmetricRigThatCanBeReadBack) {
  const OperatorsFolder folder;
  const std::string lens = OMMA_SOURCE_DIR "/config/lenses/cam0_f1.27mm_4.65um_1024x768.txt";
  ASSERT_EQ(folder.omma("design --cameras 4 --lens " + lens + " --output four").exit_code, 0);
  const Told told = folder.omma("design --rig four/rig.toml");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("need 154.8 deg"));
}

TEST(DesignProgram, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma(arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
  };
  refused("design --cameras 4", "--cameras: expected --lens with it");
  refused("design --lens x.txt", "--lens: expected --cameras with it");
  refused("design --rig a --cameras 2 --lens b", "rig: expected one of --rig and --cameras");
  refused("design --rig nowhere.toml", "nowhere.toml");
  refused("design --distance 0.1", "--distance: expected more than the spacing of 0.2 m, found 0.1");
  refused("design --rig " + kRig + " --distance 0.05 --spacing 0.01", "--distance: expected more than the");
  refused("design --rig " + kRig + " --field 100,100",
          "--field: expected one field of view, or one for each");
  refused("design --cameras 7 --lens x", "--cameras");
  refused("design --output /dev/null/x", "--output: expected a folder that can be made");
}

TEST(StarsProgram, TellsTheTrueNumberBesideTheEstimate) {
  const OperatorsFolder folder;
  const Told told = folder.omma("stars --fov 100 --magnitude 2 --json --output sky");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const auto json = nlohmann::json::parse(told.out);
  ASSERT_EQ(json.size(), 1U);
  EXPECT_NEAR(json[0]["uniform"].get<double>(), 8.57,
              0.01);                          // "at least eight" of the dissertation: the mean
  EXPECT_LE(json[0]["least"].get<int>(), 2);  // but some directions show hardly any
  EXPECT_THAT(folder.read("sky/stars.html"), HasSubstr("Stars in a field of 100"));
}

TEST(StarsProgram, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  EXPECT_EQ(folder.omma("stars --fov 0").exit_code, 2);
  EXPECT_THAT(folder.omma("stars --fov 400").err, HasSubstr("--fov: expected fields of view above 0"));
  EXPECT_EQ(folder.omma("stars --magnitude bright").exit_code, 2);
}

}  // namespace
}  // namespace omma
