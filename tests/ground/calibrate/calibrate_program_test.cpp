// `omma calibrate sky` as a user runs it, on a real photograph and on a rendered rig, and its bad input.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ground/draw/canvas.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

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

const fs::path kBoards = fs::path(OMMA_SHARED_DATA) / "data/calibration/images";

// Two cameras 35 degrees and 10 cm apart, a card moved before both.
const std::string kRig = R"(name = "pair"
[[camera]]
name = "left"
lens = "lens.txt"
rig_from_camera = { quaternion_xyzw = [0, 0, 0, 1], translation_m = [0, 0, 0] }
[[camera]]
name = "right"
lens = "lens.txt"
rig_from_camera = { quaternion_xyzw = [0, 0.300705799504, 0, 0.953716950748], translation_m = [TX, 0, 0] }
)";
const std::string kCardScenario = R"(name = "pair"
rig = "rig.toml"
epoch_utc = "2026-01-01T00:00:00Z"
frame_rate_hz = 1
frames = 5
faintest_v = 1
[trajectory]
rig_from_j2000 = [0, 0, 0, 1]
rate_deg_s = [0, 0, 0]
[[card]]
name = "card"
targets = "TARGETS"
frame = "rig"
plate_m = [0.254, 0.203]
plate_v_arcsec2 = 19.5
disc_v_arcsec2 = 15.6
disc_diameter_m = 0.012
[[card.key]]
time_s = 0
quaternion_xyzw = [1, 0, 0, 0]
position_m = [0.2, 0, 0.6]
[[card.key]]
time_s = 2
quaternion_xyzw = [0.955336489, 0, 0.295520207, 0]
position_m = [0.1, 0.1, 0.7]
[[card.key]]
time_s = 4
quaternion_xyzw = [0.955336489, 0.295520207, 0, 0]
position_m = [0.3, -0.1, 0.5]
)";
const std::string kCardSensor = R"([[sensor]]
camera = "CAMERA"
bits = 14
gain_e = 2
black_level = 100
read_noise_e = 10
dark_current_e_s = 10
full_well_e = 30000
exposure_s = 0.1
zero_point_e_s = 5000
sky_e_s = 10
psf_sigma_px = 0.7
vignetting = 0.1
field_deg = 120
)";

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  return text.replace(text.find(word), word.size(), by);
}

TEST(CalibrateRig, FindsWhereTheSecondCameraIsFromARecordingOfACard) {
  const OperatorsFolder folder;
  const std::string targets = OMMA_SOURCE_DIR "/config/targets/docking_card.tsv";
  ASSERT_EQ(folder.omma("ideal-lens --size 640,480 --focal 300 --field 120 --out lens.txt").exit_code, 0);
  folder.write("rig.toml", replaced(kRig, "TX", "0.1"));
  folder.write("guess.toml", replaced(replaced(kRig, "TX", "0.13"), "0.300705799504, 0, 0.953716950748",
                                      "0.258819045103, 0, 0.965925826289"));
  folder.write("scenario.toml", replaced(kCardScenario, "TARGETS", targets) +
                                    replaced(kCardSensor, "CAMERA", "left") +
                                    replaced(kCardSensor, "CAMERA", "right"));
  Told told = folder.omma("simulate scenario.toml --out frames");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  told =
      folder.omma("calibrate rig --rig guess.toml --targets " + targets + " --recording frames --output out");
  // The card moves here and the rig stands still; seen from the rig that is the same.
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(folder.read("out/calibration.json"));
  EXPECT_EQ(json["images"], 10);
  EXPECT_EQ(json["views"], 10);
  EXPECT_NEAR(json["cameras"][1]["translation_m"][0].get<double>(), 0.1, 5e-4);
  EXPECT_NEAR(json["cameras"][1]["translation_m"][2].get<double>(), 0, 5e-4);
  EXPECT_NEAR(json["cameras"][1]["quaternion_xyzw"][1].get<double>(), 0.300705799504, 3e-4);
  EXPECT_LT(json["rms_px"].get<double>(), 0.15);
  EXPECT_THAT(folder.read("out/rig.toml"), HasSubstr("omma calibrate rig"));
  EXPECT_EQ(folder.omma("design --rig out/rig.toml").exit_code, 0);  // it reads back
}

TEST(CalibrateRig, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  const std::string rig = OMMA_SOURCE_DIR "/config/rigs/dissertation.toml";
  const std::string targets = " --targets " OMMA_SOURCE_DIR "/config/targets/docking_card.tsv";
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("calibrate rig " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
  };
  refused("--rig " + rig + targets, "CAMERA=IMAGE... or --recording");
  refused("--rig " OMMA_SOURCE_DIR "/config/rigs/hdr1.toml" + targets + " hdr1=a.png",
          "at least two cameras");
  refused("--rig " + rig + targets + " cam9=a.png", "cam9");
  refused("--rig " + rig + targets + " hdr1=a.png", "a.png");
  refused("--rig " + rig + targets + " --recording nowhere", "a folder for every camera");
  refused("--rig " + rig + " --targets none.tsv hdr1=a.png", "none.tsv");
}

TEST(CalibrateLens, BeatsTheFigureOfOpenCvOnRealCornersAndOnViewsKeptApart) {
  if (!fs::exists(kBoards)) GTEST_SKIP() << "no " << kBoards;
  const OperatorsFolder folder;
  const std::string set = (kBoards / "babelcalib_ov_plane").string();
  const Told told = folder.omma("calibrate lens " + set + "/train/*.orpc --board-file " + set +
                                "/ov_plane.dsc --test " + set + "/test/*.orpc --json --output lens");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(told.out);
  EXPECT_LT(json["rms_px"].get<double>(), 0.500);
  EXPECT_LT(json["test"]["rms_px"].get<double>(), 0.500);
  EXPECT_EQ(json["views"].size(), 18U);
  EXPECT_THAT(folder.read("lens/camchain.yaml"), HasSubstr("distortion_model: equidistant"));
  EXPECT_THAT(folder.read("lens/calibration.html"), HasSubstr("<svg"));
}

TEST(CalibrateLens, SaysThatAPinholeCanNotDescribeAFisheye) {
  if (!fs::exists(kBoards)) GTEST_SKIP() << "no " << kBoards;
  const OperatorsFolder folder;
  const std::string set = (kBoards / "babelcalib_ov_plane").string();
  const Told told = folder.omma("calibrate lens " + set + "/train/*-14-1*.orpc --board-file " + set +
                                "/ov_plane.dsc --model caltech");
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_THAT(told.out, HasSubstr("the model asked for can not describe this lens"));
}

TEST(CalibrateLens, FindsTheCornersOfACheckerboardItself) {
  if (!fs::exists(kBoards)) GTEST_SKIP() << "no " << kBoards;
  const OperatorsFolder folder;
  std::string images;
  for (const char* name : {"img1.png", "img17.png", "img42.png"})
    images += " " + (kBoards / "camodocal" / name).string();
  const Told told = folder.omma("calibrate lens" + images + " --board 9x6 --json");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  EXPECT_LT(nlohmann::json::parse(told.out)["rms_px"].get<double>(), 0.4);
}

TEST(CalibrateLens, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  ground::Canvas(300, 200).write_png((folder / "black.png").string());
  ground::Canvas(200, 200).write_png((folder / "square.png").string());
  folder.write("corners.orpc", "filename: a.png\nwidth: 10\nheight: 10\nencoding: ascii\n0,7,1,x,3\n");
  folder.write("board.dsc", "0,2,2,1\ntags\n-1,0,0,0,0,0\n");
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("calibrate lens " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
  };
  refused("black.png", "--board: expected COLUMNSxROWS of inner corners");
  refused("black.png --board 9", "--board: expected COLUMNSxROWS");
  refused("black.png square.png --board 9x6", "square.png: image size: expected 300 x 200 as the first");
  refused("corners.orpc", "--board-file: expected the board's .dsc file");
  refused("corners.orpc --board-file board.dsc",
          "corners.orpc:5: corner: expected board, corner, flag, u, v");
  refused("nowhere.png --board 9x6", "nowhere.png");
  const Told none = folder.omma("calibrate lens black.png --board 9x6");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.out, HasSubstr("the board was found in 0 of 1 images; three are needed"));
}

}  // namespace
}  // namespace omma
