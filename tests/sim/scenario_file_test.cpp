// Scenario files: what each new table is refused for, and that the files in config are read.
#include "sim/scenario_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "fsw/kernel/input_error.hpp"
#include "tests/paths.hpp"

namespace omma::sim {
namespace {

const std::string kConfig = OMMA_SOURCE_DIR "/config/";

const char* const kSensors = R"(
[[sensor]]
camera = "hdr1"
bits = 12
gain_e = 2.0
black_level = 64
read_noise_e = 5.0
dark_current_e_s = 20
full_well_e = 9000
exposure_s = 0.05
zero_point_e_s = 120000
sky_e_s = 150
psf_sigma_px = 0.70
vignetting = 0.25
field_deg = 152.8
)";

std::string scenario(
    const std::string& rest, const std::string& sensor = "",
    const std::string& trajectory = "rig_from_j2000 = [0, 0, 0, 1]\nrate_deg_s = [0, 0, 0]\n",
    const std::string& root = "") {
  return "name = \"test\"\nrig = \"" + kConfig + "rigs/hdr1.toml\"\nepoch_utc = \"2026-01-01T00:00:00Z\"\n" +
         "frame_rate_hz = 10\nframes = 2\n" + root + "[trajectory]\n" + trajectory + kSensors + sensor + rest;
}

Scenario read(const std::string& text) {
  const auto file =
      std::filesystem::temp_directory_path() / ("scenario_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << text;
  struct Remove {
    std::filesystem::path file;
    ~Remove() { std::filesystem::remove(file); }
  } remove{file};
  return read_scenario_file(file);
}

void expect_refused(const std::string& text, const std::string& with) {
  try {
    read(text);
    ADD_FAILURE() << "not refused: " << with;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(with), std::string::npos) << error.what();
  }
}

const std::string kOrbit =
    "[orbit]\nsemi_major_axis_km = 6900\ninclination_deg = 51\nascending_node_deg = 0\n";
const std::string kCard = "[[card]]\nname = \"c\"\ntargets = \"" + kConfig +
                          "targets/docking_card.tsv\"\nframe = \"j2000\"\ndisc_diameter_m = 0.01\n"
                          "quaternion_xyzw = [0, 0, 0, 1]\nposition_m = [1, 0, 0]\nvelocity_m_s = [0, 0, 0]\n"
                          "rate_deg_s = [0, 0, 1]\n";
const std::string kPlate = "plate_m = [0.3, 0.2]\nplate_albedo = 0.05\ndisc_albedo = 0.9\n";

TEST(ScenarioFile, ReadsEveryScenarioThatIsDelivered) {
  int read = 0;
  for (const char* folder : {"", "experiments", "scenarios"}) {
    for (const auto& entry : std::filesystem::directory_iterator(kConfig + folder)) {
      if (!entry.path().filename().string().ends_with("_scenario.toml")) continue;
      EXPECT_NO_THROW(read_scenario_file(entry.path())) << entry.path();
      ++read;
    }
  }
  EXPECT_GE(read, 5);
}

TEST(ScenarioFile, InOrbitHasTheSolarSystemAndABodyInFreeFlight) {
  const Scenario s = read(scenario(kOrbit + "[earth]\nalbedo = 0.4\n" + kCard + "free_flight = true\n" +
                                   kPlate + "inertia_kg_m2 = [1, 2, 2.5]\n"));
  EXPECT_TRUE(s.orbit && s.solar_system);
  EXPECT_EQ(s.earth.albedo, 0.4);
  const Pose start = scene_at(s, 0).rig_from_body[0];
  EXPECT_LT((start.translation - Eigen::Vector3d(1, 0, 0)).norm(), 1e-5);
  EXPECT_LT((scene_at(s, 10).rig_from_body[0].translation - start.translation).norm(), 1e-3);
}

TEST(ScenarioFile, RefusesOrbitsThatAreNone) {
  expect_refused(
      scenario("[orbit]\nsemi_major_axis_km = 6450\ninclination_deg = 0\nascending_node_deg = 0\n"),
      "semi_major_axis_km: expected a perigee at least 100 km high");
  expect_refused(scenario(kOrbit + "eccentricity = 1.2\n"), "eccentricity");
  expect_refused(scenario(kOrbit + "[ground]\nup_rig = [0, 0, 1]\n"),
                 "orbit: expected [orbit] or [ground], found both");
  expect_refused(scenario("[earth]\nalbedo = 0.3\n"), "earth: expected an [orbit]");
  expect_refused(scenario(kOrbit + "[sun]\nra_deg = 0\ndec_deg = 0\n"), "sun: expected solar_system = false");
}

TEST(ScenarioFile, RefusesTumblingOfNoBody) {
  const std::string still = "rig_from_j2000 = [0, 0, 0, 1]\nrate_deg_s = [0, 0, 5]\n";
  expect_refused(scenario("", "", still + "inertia_kg_m2 = [1, 1, 5]\n"),
                 "inertia_kg_m2: expected three moments");
  expect_refused(scenario("", "", still + "inertia_kg_m2 = [1, 1]\n"), "inertia_kg_m2");
  expect_refused(
      scenario("", "",
               "rig_from_j2000 = [0, 0, 0, 1]\nrate_deg_s = [0, 0, 1e9]\ninertia_kg_m2 = [1, 1, 1]\n"),
      "rate_deg_s");
}

TEST(ScenarioFile, RefusesFramesThatNothingDefines) {
  expect_refused(
      scenario("", "", "frame = \"ground\"\nrig_from_ground = [0, 0, 0, 1]\nrate_deg_s = [0, 0, 0]\n"),
      "frame: expected \"j2000\", \"ground\" with a site");
  expect_refused(
      scenario("", "", "frame = \"orbit\"\nrig_from_orbit = [0, 0, 0, 1]\nrate_deg_s = [0, 0, 0]\n"),
      "frame: expected");
  expect_refused(
      scenario("", "", "frame = \"moon\"\nrig_from_j2000 = [0, 0, 0, 1]\nrate_deg_s = [0, 0, 0]\n"),
      "\"moon\"");
}

TEST(ScenarioFile, RefusesGroundsThatSayTooLittle) {
  expect_refused(scenario("[ground]\nsite = \"north pole\"\n"), "site: expected \"LAT,LON,HEIGHT\"");
  expect_refused(scenario("[ground]\nup_rig = [0, 0, 2]\n"), "up_rig: expected a vector of length 1");
  expect_refused(scenario("[ground]\nup_rig = [0, 0, 1]\n[[ground.lamp]]\nazimuth_deg = 0\nelevation_deg = "
                          "1\nmagnitude = 0\n"),
                 "azimuth_deg: expected a site");
  expect_refused(scenario("[ground]\nsite = \"36,-97,300\"\n[ground.glow]\nzenith = 20\n"), "zenith");
}

TEST(ScenarioFile, RefusesCardsThatCannotBe) {
  expect_refused(scenario(kCard + "free_flight = true\n" + kPlate),
                 "free_flight: expected a rig with an [orbit]");
  expect_refused(scenario(kCard + "plate_m = [0.3, 0.2]\nplate_albedo = 0.9\ndisc_albedo = 0.1\n"),
                 "disc_albedo: expected discs brighter than the plate");
  expect_refused(scenario(kCard + kPlate + "[card.led]\nv_at_1m = -8\nhalf_angle_deg = 90\n"),
                 "half_angle_deg");
  expect_refused(scenario(kCard + "plate_albedo = 0.05\ndisc_albedo = 0.9\n[[card.face]]\nplate_m = [0, 1]\n"
                                  "quaternion_xyzw = [0, 0, 0, 1]\ncentre_m = [0, 0, 0]\n"),
                 "plate_m: expected two lengths above 0");
}

TEST(ScenarioFile, RefusesResponsesThatCountNoLight) {
  expect_refused(scenario("", "response = [[400, 0.1, 500, 0.2]]\n"), "response");
  expect_refused(scenario("", "response = [500, 0.1, 400, 0.2]\n"), "response: expected pairs");
  expect_refused(scenario("", "response = [400, 0, 500, 0]\n"), "response: expected two points");
  EXPECT_EQ(read(scenario("", "response = [400, 0.1, 500, 0.2]\n")).sensors[0].response.size(), 2U);
}

}  // namespace
}  // namespace omma::sim
