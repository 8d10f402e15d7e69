// Device images become grey images: every layout, its white level, mosaics binned the right way round.
#include "hal/live/pixel_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class In, class Out>
std::vector<Out> grey_of(const char* format, BayerUse bayer, const std::vector<In>& pixels, int width,
                         int height, std::ptrdiff_t stride) {
  const PixelLayout& layout = *find_pixel_layout(format);
  const GreyShape shape = grey_shape(layout, bayer, width, height);
  std::vector<Out> out(shape.bytes() / sizeof(Out));
  to_grey(layout, bayer, reinterpret_cast<const std::byte*>(pixels.data()), stride, shape,
          reinterpret_cast<std::byte*>(out.data()));
  return out;
}

TEST(PixelLayout, GreyRowsAreTakenOutOfPaddedOnes) {
  const std::vector<std::uint8_t> pixels{1, 2, 3, 99, 4, 5, 6, 99};
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("GREY", BayerUse::kGrey, pixels, 3, 2, 4)),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(PixelLayout, SixteenBitPixelsKeepTheirLevels) {
  const std::vector<std::uint16_t> pixels{0, 1023, 512, 7};
  EXPECT_THAT((grey_of<std::uint16_t, std::uint16_t>("Y10", BayerUse::kGrey, pixels, 2, 2, 4)),
              ElementsAre(0, 1023, 512, 7));
}

TEST(PixelLayout, WhiteLevelIsTheLayouts) {
  for (const auto& [name, white] :
       {std::pair{"GREY", 255}, {"Y10", 1023}, {"Y12", 4095}, {"Y16", 65535}, {"BG10", 1023}})
    EXPECT_EQ(grey_shape(*find_pixel_layout(name), BayerUse::kGrey, 4, 4).white_level, white) << name;
}

TEST(PixelLayout, MosaicIsBinnedToTheMeanOfItsCell) {
  const std::vector<std::uint8_t> cell{10, 20, 30, 41};
  for (const char* const name : {"BA81", "GBRG", "GRBG", "RGGB"})
    EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>(name, BayerUse::kGrey, cell, 2, 2, 2)), ElementsAre(25))
        << name;
}

TEST(PixelLayout, GreensOfAMosaicAreWhereItsNameSays) {
  const std::vector<std::uint8_t> cell{10, 20, 30, 40};
  for (const char* const name : {"BA81", "RGGB"})  // greens on the other diagonal
    EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>(name, BayerUse::kGreen, cell, 2, 2, 2)), ElementsAre(25))
        << name;
  const std::vector<std::uint16_t> wide{100, 200, 300, 500};
  for (const char* const name : {"GB10", "BA10", "GB12", "GR16"})
    EXPECT_THAT((grey_of<std::uint16_t, std::uint16_t>(name, BayerUse::kGreen, wide, 2, 2, 4)),
                ElementsAre(300))
        << name;
  for (const char* const name : {"BG10", "RG10", "RG16", "BYR2"})
    EXPECT_THAT((grey_of<std::uint16_t, std::uint16_t>(name, BayerUse::kGreen, wide, 2, 2, 4)),
                ElementsAre(250))
        << name;
}

TEST(PixelLayout, RawMosaicStaysAsItIs) {
  const std::vector<std::uint8_t> cell{10, 20, 30, 40};
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("BA81", BayerUse::kRaw, cell, 2, 2, 2)),
              ElementsAre(10, 20, 30, 40));
}

TEST(PixelLayout, OddLastRowAndColumnOfAMosaicAreLeftOut) {
  const std::vector<std::uint8_t> pixels{1, 1, 9, 1, 1, 9, 9, 9, 9};
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("BA81", BayerUse::kGrey, pixels, 3, 3, 3)),
              ElementsAre(1));
}

TEST(PixelLayout, LuminanceOfColour) {
  const std::vector<std::uint8_t> yuyv{50, 128, 60, 128};
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("YUYV", BayerUse::kGrey, yuyv, 2, 1, 4)),
              ElementsAre(50, 60));
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("UYVY", BayerUse::kGrey, yuyv, 2, 1, 4)),
              ElementsAre(128, 128));
  const std::vector<std::uint8_t> rgb{255, 0, 0, 0, 0, 255};
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("RGB3", BayerUse::kGrey, rgb, 2, 1, 6)),
              ElementsAre(76, 29));
  EXPECT_THAT((grey_of<std::uint8_t, std::uint8_t>("BGR3", BayerUse::kGrey, rgb, 2, 1, 6)),
              ElementsAre(29, 76));
}

std::string message(const CameraSetup& setup) {
  return refusal_of([&] { shape_of(setup); });
}

TEST(CameraSetup, ThatMakesNoSenseIsRefused) {
  const CameraSetup good{.where = "lab.toml", .device = "x", .format = "Y12", .width = 4, .height = 4};
  EXPECT_EQ(message(good), "no error");
  CameraSetup setup = good;
  setup.format = "MJPG";
  EXPECT_THAT(message(setup), HasSubstr("lab.toml: format: expected one of GREY, Y10, "));
  EXPECT_THAT(message(setup), HasSubstr("found MJPG"));
  setup = good;
  setup.width = 0;
  EXPECT_THAT(message(setup), HasSubstr("size: expected at least 1 x 1 px, found 0 x 4"));
  setup = good;
  setup.bits = 14;
  EXPECT_THAT(message(setup), HasSubstr("bits: expected 9 to 12, as format Y12 has, found 14"));
  setup.bits = 8;
  EXPECT_THAT(message(setup), HasSubstr("found 8"));
}

TEST(CameraSetup, BitsThatTheSensorFillsAreItsWhiteLevel) {
  const GreyShape shape = shape_of({.format = "Y16", .width = 4, .height = 4, .bits = 12});
  EXPECT_EQ(shape.white_level, 4095);
  EXPECT_EQ(shape.format, PixelFormat::kGrey16);
}

}  // namespace
}  // namespace omma
