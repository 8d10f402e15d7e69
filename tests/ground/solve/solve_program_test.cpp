// The real `omma solve` on shared photographs: what it prints, and that a rig file joins its cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hal/recorded/image_file.hpp"
#include "tests/bench/photographs.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::vector<Photograph> shared(PhotographGroup group) {
  return photographs(OMMA_SHARED_DATA "/data", group);
}

#define OMMA_NEEDS(photographs) \
  if ((photographs).empty()) GTEST_SKIP() << "needs the photographs of the shared data folder"

std::string quoted(const std::filesystem::path& path) {
  return "'" + path.string() + "'";
}

Eigen::Quaterniond attitude_of(const json& object) {
  const auto q = object.at("rig_from_j2000").get<std::vector<double>>();
  return {q.at(3), q.at(0), q.at(1), q.at(2)};
}

void expect_right(const Photograph& photograph, const json& object) {
  ASSERT_TRUE(object.at("solved").get<bool>()) << object;
  EXPECT_EQ(object.at("reason"), "");
  const Eigen::Vector3d error = error_arcsec(photograph, attitude_of(object));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LE(std::abs(error[axis]), photograph.tolerance_arcsec[axis]) << photograph.name;
}

/// The rig as a file an operator would write.
std::string rig_file(const Photograph& photograph) {
  std::ostringstream text;
  text.precision(15);
  text << "name = \"stellarium\"\n";
  for (std::size_t c = 0; c < photograph.rig.cameras.size(); ++c) {
    const RigCamera& camera = photograph.rig.cameras[c];
    const Eigen::Quaterniond& q = camera.rig_from_camera.rotation;
    text << "[[camera]]\nname = \"" << camera.name.view() << "\"\nlens = \""
         << photograph.lenses.at(c).string() << "\"\nrig_from_camera = { quaternion_xyzw = [" << q.x() << ", "
         << q.y() << ", " << q.z() << ", " << q.w() << "], translation_m = [0, 0, 0] }\n";
  }
  return text.str();
}

TEST(SolveProgram, SolvesTheLongyearbyenPhotographFromTheCommandLine) {
  const auto all = shared(PhotographGroup::kLongyearbyen);
  OMMA_NEEDS(all);
  const OperatorsFolder folder;
  for (const Photograph& photograph : all) {
    std::string arguments =
        "solve --json " + quoted(photograph.images[0]) + " --lens " + quoted(photograph.lenses[0]);
    if (!photograph.epoch.empty()) arguments += " --epoch " + photograph.epoch + " --site " + photograph.site;
    const Told run = folder.omma(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json object = json::parse(run.out);
    expect_right(photograph, object);
    EXPECT_GE(object.at("stars_used").get<int>(), 60);
  }
}

TEST(SolveProgram, JoinsTheCamerasOfARigFile) {
  const auto all = shared(PhotographGroup::kRigs);
  OMMA_NEEDS(all);
  const OperatorsFolder folder;
  for (const Photograph& photograph : all) {
    folder.write("rig.toml", rig_file(photograph));
    std::string arguments = "solve --json --rig rig.toml";
    for (std::size_t c = 0; c < photograph.images.size(); ++c)
      arguments += " cam" + std::to_string(c) + "=" + quoted(photograph.images[c]);
    const Told run = folder.omma(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json object = json::parse(run.out);
    expect_right(photograph, object);
    ASSERT_EQ(object.at("cameras").size(), 3u);
    int stars = 0;
    for (const json& camera : object.at("cameras")) {
      EXPECT_GT(camera.at("stars_used").get<int>(), 50);
      EXPECT_GE(camera.at("dots").get<int>(), camera.at("stars_used").get<int>());
      stars += camera.at("stars_used").get<int>();
    }
    EXPECT_EQ(object.at("stars_used").get<int>(), stars);
  }
}

// Right ascension, declination and roll say the same as the quaternion.
TEST(SolveProgram, PointingOfEachCameraFollowsFromTheQuaternion) {
  const auto all = shared(PhotographGroup::kRigs);
  OMMA_NEEDS(all);
  const Photograph& photograph = all[0];
  const OperatorsFolder folder;
  folder.write("rig.toml", rig_file(photograph));
  std::string arguments = "solve --json --rig rig.toml";
  for (std::size_t c = 0; c < photograph.images.size(); ++c)
    arguments += " cam" + std::to_string(c) + "=" + quoted(photograph.images[c]);
  const json object = json::parse(folder.omma(arguments).out);
  constexpr double kDegree = M_PI / 180;
  for (std::size_t c = 0; c < 3; ++c) {
    const json& camera = object.at("cameras").at(c);
    const double ra = camera.at("ra_deg").get<double>() * kDegree;
    const double dec = camera.at("dec_deg").get<double>() * kDegree;
    const double roll = camera.at("roll_deg").get<double>() * kDegree;
    const Eigen::Matrix3d camera_from_j2000 =
        (photograph.rig.cameras[c].rig_from_camera.rotation.conjugate() * attitude_of(object))
            .toRotationMatrix();
    const Eigen::Vector3d axis(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec));
    EXPECT_NEAR((camera_from_j2000 * axis - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-9);
    // Roll: the position angle of the image's up, from north over east.
    const Eigen::Vector3d north(-std::sin(dec) * std::cos(ra), -std::sin(dec) * std::sin(ra), std::cos(dec));
    const Eigen::Vector3d east(-std::sin(ra), std::cos(ra), 0);
    const Eigen::Vector3d up = std::cos(roll) * north + std::sin(roll) * east;
    EXPECT_NEAR((camera_from_j2000 * up + Eigen::Vector3d::UnitY()).norm(), 0, 1e-9);
  }
}

TEST(SolveProgram, PrintsTextForAReaderAndAPictureOfWhatItFound) {
  const auto all = shared(PhotographGroup::kSingles);
  OMMA_NEEDS(all);
  const OperatorsFolder folder;
  const Told run = folder.omma("solve " + quoted(all[0].images[0]) + " --lens " + quoted(all[0].lenses[0]) +
                               " --annotate found.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* part :
       {"RA", "Dec", "roll", "rig_from_j2000", "1-sigma", "stars used", "residual rms", "time"})
    EXPECT_THAT(run.out, HasSubstr(part));
  const ImageSize size = read_png_size(folder / "found.png");
  EXPECT_GE(size.width, 1024);
  EXPECT_GE(size.height, 768);
}

TEST(SolveProgram, SolvesAFieldOfAnAssumedPinhole) {
  const auto all = shared(PhotographGroup::kMediumField);
  OMMA_NEEDS(all);
  const OperatorsFolder folder;
  const Photograph& photograph = all[0];
  std::ostringstream arguments;
  arguments.precision(12);
  arguments << "solve --json " << quoted(photograph.images[0]) << " --fov " << photograph.fov_deg;
  const Told run = folder.omma(arguments.str());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  expect_right(photograph, json::parse(run.out));
}

TEST(SolveProgram, AHintIsFollowedAndAWrongOneIsTold) {
  const auto all = shared(PhotographGroup::kMediumField);
  OMMA_NEEDS(all);
  const OperatorsFolder folder;
  const Photograph& photograph = all[0];
  std::ostringstream start;
  start.precision(12);
  start << "solve --json " << quoted(photograph.images[0]) << " --fov " << photograph.fov_deg;
  const json unaided = json::parse(folder.omma(start.str()).out);
  const double ra = unaided.at("cameras").at(0).at("ra_deg"), dec = unaided.at("cameras").at(0).at("dec_deg");
  const auto told = [&](double hint_dec) {
    std::ostringstream arguments;
    arguments << start.str() << " --near " << ra << "," << hint_dec << ",5";
    return json::parse(folder.omma(arguments.str()).out);
  };
  const json near = told(dec + 2);
  expect_right(photograph, near);
  EXPECT_FALSE(near.at("away_from_hint").get<bool>());
  const json wrong = told(dec > 0 ? dec - 60 : dec + 60);
  expect_right(photograph, wrong);
  EXPECT_TRUE(wrong.at("away_from_hint").get<bool>());
}

}  // namespace
}  // namespace omma
