// `omma calibrate sky` as a user runs it, on a real photograph and on a rendered rig, and its bad input.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ground/draw/canvas.hpp"
#include "tests/ground/run_omma.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kKho = fs::path(OMMA_SHARED_DATA) / "data/sky/kho/LYR-Sony-111220_200933_gray2.png";

TEST(CalibrateSky, FindsTheLensOfARealFisheyeFromItsFieldOfViewAlone) {
  if (!fs::exists(kKho)) GTEST_SKIP() << "no " << kKho;
  const OperatorsFolder folder;
  const std::string when = " --epoch 2020-12-11T20:09:33Z --site 78.148,16.043,500";
  for (const std::string model : {"ocam", "kb4"}) {
    const Told told = folder.omma("calibrate sky " + kKho.string() + " --fov 180 --model " + model + when +
                                  " --json --output " + model);
    ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
    const auto json = nlohmann::json::parse(told.out);
    const auto& camera = json["cameras"][0];
    EXPECT_LE(camera["rms_px"].get<double>(), 0.25) << model;
    EXPECT_GE(camera["stars"].get<int>(), 240) << model;
    EXPECT_GE(camera["widest_deg"].get<double>(), 82) << model;  // out to the horizon
    // The reference fit of the same picture: centre 708.07, 719.53.
    EXPECT_NEAR(camera["parameters"]["centre_u"]["value"].get<double>(), 708.1, 0.4);
    EXPECT_NEAR(camera["parameters"]["centre_v"]["value"].get<double>(), 719.6, 0.4);
    const std::string lens = model + (model == "ocam" ? "/cam0.txt" : "/cam0.yaml");
    const Told solved = folder.omma("solve " + kKho.string() + " --lens " + lens + when + " --json");
    ASSERT_EQ(solved.exit_code, 0) << solved.out << solved.err;
    EXPECT_LT(nlohmann::json::parse(solved.out)["residual_rms_px"].get<double>(), 0.36);
    EXPECT_THAT(folder.read(model + "/calibration.html"), HasSubstr("<svg"));
  }
}

TEST(CalibrateSky, SaysWhyThereIsNone) {
  const OperatorsFolder folder;
  ground::Canvas(300, 200).write_png((folder / "black.png").string());
  const Told told = folder.omma("calibrate sky black.png --fov 150");
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_THAT(told.out,
              HasSubstr("no calibration: no stars recognised with any focal length from 0.77 to 1.30"));
}

TEST(CalibrateSky, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  folder.write("notes.png", "not a picture");
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("calibrate " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err + told.out, HasSubstr(sentence)) << arguments;
  };
  refused("", "subcommand");
  refused("sky a.png", "lens: expected one of --fov, --lens and --rig, found none");
  refused("sky a.png --fov 100 --lens b.txt", "found 2 of them");
  refused("sky a.png --fov 180 --site 1,2,3", "--site: expected --epoch with it");
  refused("sky nowhere.png --fov 180", "nowhere.png");
  refused("sky notes.png --fov 180", "notes.png");
  refused("sky a.png --fov 180 --model pinhole", "--model");
  const std::string rig = OMMA_SOURCE_DIR "/config/rigs/dissertation.toml";
  refused("sky a.png --rig " + rig, "image: expected CAMERA=FILE when a rig is given");
  refused("sky cam9=a.png --rig " + rig, "camera: expected a camera of the rig");
}

}  // namespace
}  // namespace omma
