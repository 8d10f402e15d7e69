#include "components/tracker/field_map.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/bench/sky_problem.hpp"
#include "tests/random_direction.hpp"

namespace omma {
namespace {

TEST(FieldMap, AgreesWithTheLensButAtTheEdge) {
  RigCamera camera = pinhole_rig(20).cameras[0];
  camera.rig_from_camera.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized());
  const FieldMap field(camera, nullptr);
  ASSERT_TRUE(field.sees_anything());
  EXPECT_NEAR(field.axis().dot(camera.rig_from_camera.rotation * Eigen::Vector3d::UnitZ()), 1, 1e-12);
  std::mt19937_64 random(1);
  int seen = 0, other = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // Twice as wide as the field, and its opposite.
    Eigen::Vector3d d = (0.3 * random_direction(random) + Eigen::Vector3d::UnitZ()).normalized();
    if (trial % 10 == 0) d = -d;
    const Eigen::Vector3d in_rig = camera.rig_from_camera.rotation * d;
    Eigen::Vector2d pixel;
    const bool sees = camera.lens.project(d, pixel);
    seen += sees ? 1 : 0;
    other += sees != field.sees(in_rig) ? 1 : 0;
    if (!sees) continue;
    EXPECT_LE(std::acos(std::min(1.0, field.axis().dot(in_rig))), field.radius() + 1e-9);
  }
  EXPECT_GT(seen, 2000);
  EXPECT_LT(other, seen / 25);
}

TEST(FieldMap, SeesNothingWhereTheCameraIsBlind) {
  const RigCamera camera = pinhole_rig(20).cameras[0];
  PixelMask mask(camera.lens.width(), camera.lens.height());
  mask.add_box(0, 0, camera.lens.width() / 2, camera.lens.height());
  const FieldMap field(camera, &mask);
  EXPECT_FALSE(field.sees(Eigen::Vector3d(-0.1, 0, 1).normalized()));
  EXPECT_TRUE(field.sees(Eigen::Vector3d(0.1, 0, 1).normalized()));
}

TEST(FieldMap, OfAWideCameraIsEmpty) {
  const FieldMap field(equidistant_rig(1, 122).cameras[0], nullptr);
  EXPECT_FALSE(field.sees_anything());
  EXPECT_FALSE(field.sees(Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(FieldMap().sees_anything());
}

}  // namespace
}  // namespace omma
