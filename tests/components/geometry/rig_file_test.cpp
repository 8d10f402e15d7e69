// Rig files: what is right is read, what is wrong is named with its line and field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "tests/components/geometry/temporary_file.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const char* const kLens = "1 -300\n1 2\n99.5 149.5\n1 0 0\n200 300\n";

class RigFile : public ::testing::Test {
 protected:
  std::string camera(const std::string& name, const std::string& rotation = "0, 0, 0, 1",
                     const std::string& more = "") const {
    return "[[camera]]\nname = \"" + name + "\"\nlens = \"" + lens_.name() +
           "\"\nrig_from_camera = { quaternion_xyzw = [" + rotation +
           "], translation_m = [0.1, 0, -0.07] }\n" + more;
  }
  static std::string error_of(const std::string& text) {
    const TemporaryFile file("rig.toml", text);
    return refusal_of([&] { read_rig_file(file.path()); });
  }
  TemporaryFile lens_{"lens.txt", kLens};
};

TEST_F(RigFile, IsReadWithLensesRelativeToIt) {
  const TemporaryFile file("rig.toml",
                           "name = \"demo\"\n" + camera("cam0") + camera("cam1", "0, 0.70711, 0, 0.70711"));
  const Rig rig = read_rig_file(file.path());
  EXPECT_EQ(rig.name.view(), "demo");
  ASSERT_EQ(rig.cameras.size(), 2U);
  EXPECT_EQ(rig.cameras[1].name.view(), "cam1");
  EXPECT_EQ(rig.cameras[0].lens.width(), 300);
  EXPECT_DOUBLE_EQ(rig.cameras[0].rig_from_camera.translation.z(), -0.07);
  EXPECT_NEAR(rig.cameras[1].rig_from_camera.rotation.norm(), 1, 1e-15);
  // A quarter turn about y: the camera looks along the rig's x.
  const Eigen::Vector3d axis = rig.cameras[1].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_LT((axis - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST_F(RigFile, WrongEntriesAreNamedWithTheirLine) {
  const std::string head = "name = \"demo\"\n";
  EXPECT_THAT(error_of(head + camera("cam0", "0, 0, 0, 1", "mask = \"a.png\"\n")),
              AllOf(HasSubstr("rig.toml:6: camera[0].mask"), HasSubstr("found an unknown key")));
  EXPECT_THAT(error_of(head + "size = 3\n" + camera("cam0")), HasSubstr("rig.toml:2: size"));
  EXPECT_THAT(
      error_of(head + camera("cam0") + camera("cam0")),
      HasSubstr("rig.toml:7: camera[1].name: expected a name no other camera has, found \"cam0\" again"));
  EXPECT_THAT(
      error_of(head + camera("cam0", "0, 0, 0, 1.01")),
      HasSubstr("rig.toml:5: camera[0].rig_from_camera.quaternion_xyzw: expected a quaternion of length 1, "
                "found length 1.01"));
  EXPECT_THAT(error_of(head + camera("cam0", "0, 0, 0, nan")),
              HasSubstr("rig.toml:5: camera[0].rig_from_camera"));
  EXPECT_THAT(error_of(head + camera("cam0", "0, 0, 1")), HasSubstr("expected an array of 4 numbers"));
  EXPECT_THAT(error_of(head + camera("")), HasSubstr("camera[0].name: expected a name, found an empty one"));
  EXPECT_THAT(error_of(head + camera(std::string(40, 'a'))), HasSubstr("limits::kNameLength"));
  EXPECT_THAT(error_of(head), HasSubstr("expected at least one [[camera]], found none"));
  EXPECT_THAT(error_of(camera("cam0")), HasSubstr("name: expected a text, found nothing"));
  EXPECT_THAT(error_of("name = \"demo\n"), HasSubstr("rig.toml:1: syntax"));
}

TEST_F(RigFile, MoreCamerasThanTheLimitAreRefusedByItsName) {
  std::string text = "name = \"demo\"\n";
  for (int i = 0; i <= limits::kCameras; ++i) text += camera("cam" + std::to_string(i));
  EXPECT_THAT(error_of(text), HasSubstr("expected at most 6 cameras (limits::kCameras), found 7"));
}

TEST_F(RigFile, AMissingLensFileIsNamed) {
  std::string text = "name = \"demo\"\n" + camera("cam0");
  text.replace(text.find(lens_.name()), lens_.name().size(), "nowhere.txt");
  EXPECT_THAT(error_of(text), HasSubstr("nowhere.txt: file: expected a readable file, found no such file"));
}

TEST(ProjectRig, OfTheDissertationIsRead) {
  const Rig rig = read_rig_file(std::string(OMMA_SOURCE_DIR) + "/config/rigs/dissertation.toml");
  ASSERT_EQ(rig.cameras.size(), 3U);
  EXPECT_GT(rig.cameras[1].lens.max_angle(), 93.5 * std::numbers::pi / 180);
}

}  // namespace
}  // namespace omma
