// `omma calibrate axes` as a user runs it: a card that turns before a camera, rendered, flown and its axes
// found; and bad input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "ground/format.hpp"
#include "tests/bench/swung_platform.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const std::string kConfig = OMMA_SOURCE_DIR "/config/";

std::string scenario(const std::string& rate) {
  return "name = \"axes\"\nrig = \"" + kConfig + "rigs/hdr1.toml\"\nepoch_utc = \"2026-01-03T04:00:00Z\"\n" +
         R"(frame_rate_hz = 1.852
frames = 20
seed = 1
faintest_v = 3
truth_minimum_snr = 3
[trajectory]
rig_from_j2000 = [0, 0, 0, 1]
rate_deg_s = [0, 0, 0]
[[sensor]]
camera = "hdr1"
bits = 14
gain_e = 2.0
black_level = 160
read_noise_e = 12
dark_current_e_s = 40
full_well_e = 30000
exposure_s = 0.1
zero_point_e_s = 17000
sky_e_s = 250
psf_sigma_px = 0.65
vignetting = 0.25
field_deg = 152.8
blur_samples = 3
[[card]]
name = "card"
frame = "rig"
plate_m = [0.254, 0.203]
plate_v_arcsec2 = 19.5
disc_v_arcsec2 = 15.6
disc_diameter_m = 0.012
quaternion_xyzw = [1, 0, 0, 0]
position_m = [0.1, 0.05, 0.6]
velocity_m_s = [0, 0, 0]
)" + "targets = \"" +
         kConfig + "targets/docking_card.tsv\"\nrate_deg_s = " + rate + "\n";
}

std::string mission() {
  return "spacecraft = \"axes\"\nrig = \"" + kConfig + "rigs/hdr1.toml\"\nframe_rate_hz = 1.852\n" +
         "[[camera]]\nname = \"hdr1\"\ndriver = \"recorded\"\nbits = 14\n" +
         "extractor = { gain_e_per_level = 2.0, black_level = 160 }\n" +
         "[[body]]\nname = \"card\"\ntargets = \"" + kConfig + "targets/docking_card.tsv\"\n";
}

// The card turns about its own origin: both axes go through it, at right angles.
TEST(CalibrateAxes, FindsTheAxesOfACardThatTurnsBeforeACamera) {
  const OperatorsFolder folder;
  folder.write("mission.toml", mission());
  for (const auto& [axis, rate] : {std::pair{"x", "[3, 0, 0]"}, std::pair{"y", "[0, 3, 0]"}}) {
    const std::string name = axis;
    folder.write(name + ".toml", scenario(rate));
    const Told rendered = folder.omma("simulate " + name + ".toml --out frames_" + name);
    ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
    const std::string flight = "cd '" + (folder / "").string() +
                               "' && " OMMA_RUN "omma-fsw mission.toml --no-dds --frames frames_" + name +
                               " --log " + name + ".mcap >flight.txt 2>&1";
    ASSERT_EQ(std::system(flight.c_str()), 0) << folder.read("flight.txt");
  }
  const Told told = folder.omma("calibrate axes x=x.mcap y=y.mcap --body card --output found");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  EXPECT_THAT(told.out, HasSubstr("shim x"));
  const auto json = nlohmann::json::parse(folder.read("found/axes.json"));
  const double centre[3] = {0.1, 0.05, 0.6};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(json["common_point_m"][k].get<double>(), centre[k], 1e-3);
  EXPECT_NEAR(json["pairs"][0]["angle_deg"].get<double>(), 90,
              5 * json["pairs"][0]["angle_sigma_deg"].get<double>());
  EXPECT_LT(json["pairs"][0]["angle_sigma_deg"].get<double>(), 0.3);
  EXPECT_LT(json["shims"][0]["length_m"].get<double>(), 1e-3);
  EXPECT_THAT(folder.read("found/axes.html"), HasSubstr("<svg"));
}

std::string table(const ground::TimedPoses& motion) {
  std::string text = "time_s,qx,qy,qz,qw,x_m,y_m,z_m\n";
  for (const ground::TimedPose& s : motion.samples) {
    const Eigen::Quaterniond& q = s.pose.rotation;
    const Eigen::Vector3d& t = s.pose.translation;
    text += ground::format("%.6f,%.12f,%.12f,%.12f,%.12f,%.9f,%.9f,%.9f\n", s.time, q.x(), q.y(), q.z(),
                           q.w(), t.x(), t.y(), t.z());
  }
  return text;
}

TEST(CalibrateAxes, RefusesWhatItCannotUse) {
  const OperatorsFolder folder;
  const SwungPlatform platform = swung_platform({}, 1);
  Swing rest;
  rest.arc = 0;
  rest.turn_noise = 1e-5;
  folder.write("z.csv", table(platform.motions[0]));
  folder.write("still.csv", table(swung_platform(rest, 1).motions[0]));
  folder.write("turns.csv", "time_s,qx,qy,qz,qw\n0,0,0,0,1\n1,0,0,0,1\n2,0,0,0,1\n");
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("calibrate axes " + arguments + " --output out");
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
  };
  refused("", "motions is required");
  refused("z.csv", "motion: expected NAME=FILE, an axis and the poses while it moved, found z.csv");
  refused("z=", "expected NAME=FILE");
  refused("z=none.csv", "none.csv: file: expected a log");
  refused("z=turns.csv", "turns.csv: motion: expected poses");
  refused("z=z.csv z=z.csv", "each axis once, found z twice");
  refused("z=z.csv --keep y", "--keep: expected one of the axes given, found y");
  const Told still = folder.omma("calibrate axes z=still.csv");
  EXPECT_EQ(still.exit_code, 1);
  EXPECT_THAT(still.out, HasSubstr("no axis: z: turns by 0.0"));
  const Told parallel = folder.omma("calibrate axes z=z.csv again=z.csv");
  EXPECT_EQ(parallel.exit_code, 1);
  EXPECT_THAT(parallel.out, HasSubstr("the axes are parallel"));
  const Told alone = folder.omma("calibrate axes z=z.csv --json");
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(alone.out)["axes"][0]["poses"], 60);
}

}  // namespace
}  // namespace omma
