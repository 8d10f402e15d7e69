// `omma calibrate sky` on the log of a flight, as a user runs it, and bad input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const std::string kConfig = OMMA_SOURCE_DIR "/config/";

TEST(CalibrateFlight, TellsLensesTurnsAndDriftFromALogAlone) {
  const OperatorsFolder folder;
  const Told flown = folder.omma("experiment earth-rotation --scenario " + kConfig +
                                 "experiments/earth_rotation_scenario.toml --mission " + kConfig +
                                 "experiments/earth_rotation.toml --frames 24 --output run");
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  const std::string rig = " --rig " + kConfig + "rigs/dissertation.toml";
  const std::string epoch = " --epoch 2026-01-03T04:00:00Z";
  const Told told =
      folder.omma("calibrate sky run/flight.mcap" + rig + epoch + " --windows 4 --json --output found");
  ASSERT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto json = nlohmann::json::parse(told.out);
  ASSERT_EQ(json["windows"].size(), 4U);
  ASSERT_EQ(json["groups"].size(), 5U);  // three lenses, two turns
  EXPECT_EQ(json["windows"][0]["frame_sets"], 6);
  for (const auto& group : json["groups"]) EXPECT_LT(group["chi2"].get<double>(), 40) << group["camera"];
  EXPECT_THAT(folder.read("found/drift.html"), HasSubstr("<svg"));
  EXPECT_THAT(folder.read("found/rig.toml"), HasSubstr("cam2"));
  // The rig that was written can be flown.
  const Told again =
      folder.omma("calibrate sky run/flight.mcap --rig found/rig.toml" + epoch + " --windows 2");
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  EXPECT_THAT(again.out, HasSubstr("drift over"));

  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told wrong = folder.omma("calibrate sky " + arguments + " --output out");
    EXPECT_EQ(wrong.exit_code, 2) << arguments;
    EXPECT_THAT(wrong.err, HasSubstr(sentence)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
  };
  refused("run/flight.mcap", "--rig: expected the rig file that was flown");
  refused("run/flight.mcap --fov 180",
          "--rig: expected the rig file that was flown, with a flight's log, found --fov");
  refused("run/flight.mcap night.png" + rig, "night.png: images: expected logs (.mcap) alone");
  refused("none.mcap" + rig, "none.mcap");
  refused("run/flight.mcap run/flight.mcap" + rig + epoch,
          "--epoch: expected the time of frame 0 of each log, found 1 for 2");
  refused("run/flight.mcap run/flight.mcap" + rig + epoch + " 2026-01-03T04:00:01Z",
          "logs in the order of time");
  refused("run/flight.mcap --rig " + kConfig + "rigs/hdr1.toml" + epoch, "dots: expected the 1 cameras");
  const Told few = folder.omma("calibrate sky run/flight.mcap" + rig + epoch + " --windows 20");
  EXPECT_EQ(few.exit_code, 1);
  EXPECT_THAT(few.out, HasSubstr("no calibration: 0 of 20 windows"));
}

}  // namespace
}  // namespace omma
