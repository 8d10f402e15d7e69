// Objects of a binary image and the measures they are judged by.
#include "components/extractor/classical/binary_objects.hpp"

#include <gtest/gtest.h>

namespace omma {
namespace {

std::vector<BinaryObject> objects(const GreyImage& binary) {
  ObjectFinder finder(binary.width, binary.height);
  std::vector<BinaryObject> all;
  finder.for_each(binary, [&](const BinaryObject& object) { all.push_back(object); });
  return all;
}

GreyImage ellipse(double a, double b, double hole = 0) {
  GreyImage image(64, 64);
  for (int v = 0; v < 64; ++v) {
    for (int u = 0; u < 64; ++u) {
      const double du = (u - 30.3) / a, dv = (v - 31.7) / b;
      const double r = du * du + dv * dv;
      image.at(u, v) = r <= 1 && r >= hole ? 1 : 0;
    }
  }
  return image;
}

TEST(Objects, AnEllipseIsOneAndHasItsAxesRatio) {
  const auto found = objects(ellipse(15, 8));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].ellipticity(), 1, 0.03);
  EXPECT_NEAR(found[0].elongation(), 15.0 / 8, 0.05);
  EXPECT_NEAR(found[0].centre.x(), 30.3, 0.1);
  EXPECT_NEAR(found[0].centre.y(), 31.7, 0.1);
  EXPECT_NEAR(found[0].compactness(), M_PI / 4, 0.06);
  EXPECT_EQ(found[0].holes, 0);
  EXPECT_FALSE(found[0].at_edge(ellipse(15, 8)));
}

TEST(Objects, AHoleIsCountedAndSpoilsTheEllipse) {
  GreyImage image = ellipse(15, 12, 0.3);
  image.at(44, 31) = 0;  // a second hole
  const auto found = objects(image);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].holes, 2);
  EXPECT_LT(found[0].ellipticity(), 0.8);
}

TEST(Objects, ACrossIsNoEllipse) {
  GreyImage image(64, 64);
  for (int k = 10; k < 50; ++k)
    for (int w = -2; w <= 2; ++w) image.at(k, 30 + w) = image.at(30 + w, k) = 1;
  const auto found = objects(image);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(found[0].ellipticity(), 0.6);
}

TEST(Objects, DiagonalPixelsAreOneAndThoseNotKeptAreCleared) {
  GreyImage image(16, 16);
  image.at(0, 3) = image.at(1, 4) = image.at(10, 10) = 1;
  ObjectFinder finder(16, 16);
  std::vector<double> areas;
  finder.for_each(image, [&](const BinaryObject& object) { areas.push_back(object.area()); });
  EXPECT_EQ(areas, (std::vector<double>{2, 1}));
  finder.keep(image, [&](const BinaryObject& o) { return !o.at_edge(image); });
  EXPECT_EQ(image.at(0, 3) + image.at(1, 4), 0);
  EXPECT_EQ(image.at(10, 10), 1);
  for (int pass = 0; pass < 300; ++pass) finder.keep(image, [](const BinaryObject&) { return true; });
  EXPECT_EQ(image.at(10, 10), 1);
}

}  // namespace
}  // namespace omma
