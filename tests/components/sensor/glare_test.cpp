#include "components/sensor/glare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

Image sky_with_disc(double radius, int grey) {
  Image image;
  image.resize(640, 480, PixelFormat::kGrey8);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
      image.pixels[static_cast<std::size_t>(v * 640 + u)] =
          static_cast<std::byte>(std::hypot(u - 300, v - 200) < radius ? grey : 20);
  return image;
}

TEST(Glare, IsALargeBrightRegionWithItsSurroundings) {
  Glare glare(640, 480, {});
  PixelMask mask(640, 480);
  EXPECT_EQ(glare.add_to(sky_with_disc(60, 255).view(), mask), 1);
  int seen_near = 0, masked_far = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double distance = std::hypot(u - 300, v - 200);
      seen_near += distance < 90 && !mask.at(u, v) ? 1 : 0;
      masked_far += distance > 60 + 100 * 1.5 && mask.at(u, v) ? 1 : 0;
    }
  }
  EXPECT_EQ(seen_near, 0);
  EXPECT_EQ(masked_far, 0);
}

TEST(Glare, IsNotASmallDiscNorADimOne) {
  Glare glare(640, 480, {});
  PixelMask mask(640, 480);
  EXPECT_EQ(glare.add_to(sky_with_disc(12, 255).view(), mask), 0);
  EXPECT_EQ(glare.add_to(sky_with_disc(60, 100).view(), mask), 0);
  EXPECT_FALSE(mask.any());
}

TEST(Glare, OfAWholeBrightImageMasksItAll) {
  Glare glare(640, 480, {});
  PixelMask mask(640, 480);
  EXPECT_EQ(glare.add_to(sky_with_disc(2000, 255).view(), mask), 1);
  EXPECT_EQ(mask.share(), 1);
}

}  // namespace
}  // namespace omma
