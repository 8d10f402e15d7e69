// Image files: each format gives the right pixels; what is damaged is refused whole.
#include "hal/recorded/image_file.hpp"

#include <fitsio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spng.h>

#include <cstdio>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 37;
constexpr int kHeight = 23;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

std::string temporary(const std::string& name) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  return testing::TempDir() + "/omma_" + test->test_suite_name() + "_" + test->name() + "_" + name;
}

template <class Pixel>
Image pattern(int factor) {
  Image image;
  image.resize(kWidth, kHeight, sizeof(Pixel) == 1 ? PixelFormat::kGrey8 : PixelFormat::kGrey16);
  auto* pixels = reinterpret_cast<Pixel*>(image.pixels.data());
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) pixels[v * kWidth + u] = static_cast<Pixel>(factor * (3 * u + 5 * v));
  }
  return image;
}

std::vector<std::byte> png_of(int color_type, int bit_depth, const std::vector<std::uint8_t>& raw, int width,
                              int height, const std::vector<std::uint8_t>& palette = {}) {
  spng_ctx* const context = spng_ctx_new(SPNG_CTX_ENCODER);
  spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.color_type = static_cast<std::uint8_t>(color_type);
  header.bit_depth = static_cast<std::uint8_t>(bit_depth);
  spng_set_ihdr(context, &header);
  if (!palette.empty()) {
    spng_plte entries{};
    entries.n_entries = static_cast<std::uint32_t>(palette.size() / 3);
    for (std::uint32_t i = 0; i < entries.n_entries; ++i) {
      entries.entries[i] = {palette[std::size_t{3} * i], palette[std::size_t{3} * i + 1],
                            palette[std::size_t{3} * i + 2], 255};
    }
    spng_set_plte(context, &entries);
  }
  EXPECT_EQ(spng_encode_image(context, raw.data(), raw.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  std::size_t size = 0;
  int error = 0;
  auto* const buffer = static_cast<std::byte*>(spng_get_png_buffer(context, &size, &error));
  std::vector<std::byte> bytes(buffer, buffer + size);
  std::free(buffer);
  spng_ctx_free(context);
  return bytes;
}

template <class Value>
std::string fits_of(const std::string& name, int image_type, int value_type, const std::vector<Value>& values,
                    const char* order) {
  std::string path = temporary(name);
  std::remove(path.c_str());
  fitsfile* fits = nullptr;
  int status = 0;
  long sides[2] = {kWidth, kHeight};
  fits_create_diskfile(&fits, path.c_str(), &status);
  fits_create_img(fits, image_type, 2, sides, &status);
  if (order != nullptr) fits_write_key(fits, TSTRING, "ROWORDER", const_cast<char*>(order), nullptr, &status);
  fits_write_img(fits, value_type, 1, static_cast<LONGLONG>(values.size()), const_cast<Value*>(values.data()),
                 &status);
  fits_close_file(fits, &status);
  EXPECT_EQ(status, 0);
  return path;
}

std::vector<std::byte> bytes_of(const std::string& path) {
  std::vector<std::byte> bytes;
  read_bytes(path, bytes);
  return bytes;
}

std::string written(const std::string& name, std::span<const std::byte> bytes) {
  std::string path = temporary(name);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return path;
}

std::string error_of(const std::string& path) {
  return refusal_of([&] { read_image(path); });
}

TEST(PngFile, GreyComesBackExactlyInEightAndSixteenBits) {
  for (const PngEffort effort : {PngEffort::kFast, PngEffort::kSmall}) {
    for (const Image& image : {pattern<std::uint8_t>(1), pattern<std::uint16_t>(257)}) {
      const std::string path = temporary("grey.png");
      write_png(path, image.view(), effort);
      const Image back = read_image(path);
      EXPECT_EQ(back.width, kWidth);
      EXPECT_EQ(back.height, kHeight);
      EXPECT_EQ(back.format, image.format);
      EXPECT_EQ(back.white_level, image.white_level);
      EXPECT_EQ(back.pixels, image.pixels);
    }
  }
}

TEST(PngFile, WhiteLevelOfATwelveBitSensorComesBack) {
  Image image = pattern<std::uint16_t>(20);
  image.white_level = 4095;
  const std::string path = temporary("twelve.png");
  write_png(path, image.view());
  EXPECT_EQ(read_image(path).white_level, 4095);
}

TEST(PngFile, RowsWithAStrideArePacked) {
  const Image image = pattern<std::uint8_t>(1);
  ImageView view = image.view();
  view.width = 20;
  view.data += 5;
  Image back;
  read_png(encode_png(view), "memory", back);
  EXPECT_EQ(back.width, 20);
  EXPECT_EQ(back.view().row<std::uint8_t>(7)[3], view.row<std::uint8_t>(7)[3]);
}

TEST(PngFile, ColourBecomesLuminance) {
  const std::vector<std::uint8_t> rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 200, 200, 200};
  const std::vector<int> expected = {76, 150, 29, 200};  // 0.299, 0.587, 0.114
  Image image;
  read_png(encode_png_rgb(4, 1, rgb), "memory", image);
  ASSERT_EQ(image.format, PixelFormat::kGrey8);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::to_integer<int>(image.pixels[i]), expected[i]);

  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 0; i < 4; ++i) {
    rgba.insert(rgba.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], static_cast<std::uint8_t>(40 * i)});
  }
  read_png(png_of(SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 8, rgba, 4, 1), "memory", image);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::to_integer<int>(image.pixels[i]), expected[i]);

  read_png(png_of(SPNG_COLOR_TYPE_INDEXED, 8, {3, 2, 1, 0}, 4, 1, rgb), "memory", image);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::to_integer<int>(image.pixels[i]), expected[3 - i]);

  std::vector<std::uint8_t> deep;  // 16 bits: the upper eight count
  for (const std::uint8_t value : rgb) deep.insert(deep.end(), {value, value});
  read_png(png_of(SPNG_COLOR_TYPE_TRUECOLOR, 16, deep, 4, 1), "memory", image);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::to_integer<int>(image.pixels[i]), expected[i]);
}

TEST(PngFile, GreyWithOpacityKeepsItsGrey) {
  Image image;
  read_png(png_of(SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 8, {10, 0, 200, 255}, 2, 1), "memory", image);
  EXPECT_EQ(std::to_integer<int>(image.pixels[0]), 10);
  EXPECT_EQ(std::to_integer<int>(image.pixels[1]), 200);
  read_png(png_of(SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 16, {0x34, 0x12, 0, 0, 0x78, 0x56, 1, 1}, 2, 1), "memory",
           image);
  ASSERT_EQ(image.format, PixelFormat::kGrey16);
  EXPECT_EQ(image.view().row<std::uint16_t>(0)[0], 0x1234);
  EXPECT_EQ(image.view().row<std::uint16_t>(0)[1], 0x5678);
}

TEST(PngFile, FewBitsFillTheRangeOfEight) {
  Image image;
  read_png(png_of(SPNG_COLOR_TYPE_GRAYSCALE, 1, {0b10100000}, 3, 1), "memory", image);
  EXPECT_EQ(std::to_integer<int>(image.pixels[0]), 255);
  EXPECT_EQ(std::to_integer<int>(image.pixels[1]), 0);
  EXPECT_EQ(std::to_integer<int>(image.pixels[2]), 255);
}

TEST(PngFile, SizeIsReadFromTheHeaderAlone) {
  const std::string path = temporary("size.png");
  write_png(path, pattern<std::uint16_t>(9).view());
  const ImageSize size = read_png_size(path);
  EXPECT_EQ(size.width, kWidth);
  EXPECT_EQ(size.height, kHeight);
  EXPECT_EQ(size.bits, 16);
}

TEST(JpegFile, GreyComesBackWithinItsCompression) {
  const Image image = pattern<std::uint8_t>(1);
  const Image back = read_image(written("grey.jpg", encode_jpeg(image.view(), 98)));
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(std::to_integer<int>(back.pixels[i]), std::to_integer<int>(image.pixels[i]), 6);
  }
}

TEST(FitsFile, EightAndUnsignedSixteenBitsComeBackExactly) {
  const Image eight = pattern<std::uint8_t>(1);
  std::vector<std::uint8_t> bytes(eight.pixels.size());
  std::memcpy(bytes.data(), eight.pixels.data(), bytes.size());
  EXPECT_EQ(read_image(fits_of("a.fits", BYTE_IMG, TBYTE, bytes, "TOP-DOWN")).pixels, eight.pixels);

  const Image sixteen = pattern<std::uint16_t>(300);
  std::vector<std::uint16_t> words(kPixels);
  std::memcpy(words.data(), sixteen.pixels.data(), sixteen.pixels.size());
  const Image back = read_image(fits_of("b.fits", USHORT_IMG, TUSHORT, words, "TOP-DOWN"));
  EXPECT_EQ(back.format, PixelFormat::kGrey16);
  EXPECT_EQ(back.white_level, 65535);
  EXPECT_EQ(back.pixels, sixteen.pixels);
}

TEST(FitsFile, RowsStandUprightWithoutRowOrder) {
  std::vector<std::uint16_t> words(kPixels, 7);
  words[0] = 1000;  // FITS: the first pixel is the lower left
  const Image image = read_image(fits_of("a.fits", USHORT_IMG, TUSHORT, words, nullptr));
  EXPECT_EQ(image.view().row<std::uint16_t>(kHeight - 1)[0], 1000);
  EXPECT_EQ(image.view().row<std::uint16_t>(0)[0], 7);
}

TEST(FitsFile, FractionsFillSixteenBitsAndBlanksBecomeTheLowest) {
  std::vector<float> values(kPixels, 0.5F);
  values[0] = 0.0F;
  values[1] = 1.0F;
  values[2] = std::numeric_limits<float>::quiet_NaN();
  const Image image = read_image(fits_of("a.fits", FLOAT_IMG, TFLOAT, values, "TOP-DOWN"));
  const auto* const row = image.view().row<std::uint16_t>(0);
  EXPECT_EQ(row[0], 0);
  EXPECT_EQ(row[1], 65535);
  EXPECT_EQ(row[2], 0);
  EXPECT_NEAR(row[3], 32768, 1);
}

TEST(FitsFile, GreyLevelsInWiderTypesKeepTheirUnits) {
  std::vector<int> values(kPixels, 1234);
  values[5] = 60000;
  const Image image = read_image(fits_of("a.fits", LONG_IMG, TINT, values, "TOP-DOWN"));
  EXPECT_EQ(image.view().row<std::uint16_t>(0)[0], 1234);
  EXPECT_EQ(image.view().row<std::uint16_t>(0)[5], 60000);
}

// Each format, cut at many lengths and with single bytes turned over: an error or a whole image, never a
// crash.
void expect_refused_when_cut(const std::vector<std::byte>& whole, const std::string& name,
                             std::size_t harmless_end) {
  for (std::size_t length = 0; length + harmless_end < whole.size(); length += 1 + length / 40) {
    EXPECT_NE(error_of(written(name, std::span(whole).first(length))), "no error")
        << length << " of " << whole.size();
  }
  for (std::size_t i = 0; i < whole.size(); i += 1 + whole.size() / 500) {
    std::vector<std::byte> damaged = whole;
    damaged[i] ^= std::byte{0x5A};
    try {
      const Image image = image_from_bytes(damaged, name);
      EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) *
                                         static_cast<std::size_t>(image.height) *
                                         static_cast<std::size_t>(image.bytes_per_pixel()));
    } catch (const InputError&) {
    }
  }
}

TEST(DamagedImage, PngIsRefused) {
  constexpr std::size_t kCheckOfEnd = 4;  // the check sum of the empty end record
  expect_refused_when_cut(encode_png(pattern<std::uint8_t>(1).view()), "cut.png", kCheckOfEnd);
  expect_refused_when_cut(encode_png(pattern<std::uint16_t>(77).view()), "cut16.png", kCheckOfEnd);
}

TEST(DamagedImage, JpegIsRefused) {
  expect_refused_when_cut(encode_jpeg(pattern<std::uint8_t>(1).view(), 98), "cut.jpg", 1);
}

TEST(DamagedImage, FitsIsRefused) {
  const std::vector<std::uint16_t> words(kPixels, 300);
  const auto whole = bytes_of(fits_of("whole.fits", USHORT_IMG, TUSHORT, words, nullptr));
  // The last block is filled up with zeros behind the pixels.
  expect_refused_when_cut(whole, "cut.fits", 2880 - (2 * kPixels) % 2880);
}

TEST(ImageFile, WhatIsNoImageIsRefusedInOneSentence) {
  EXPECT_THAT(error_of("/no/such/picture.png"),
              HasSubstr("/no/such/picture.png: file: expected an image, found no such file"));
  EXPECT_THAT(error_of(testing::TempDir()), HasSubstr("found something else of that name"));
  EXPECT_THAT(error_of(written("empty.png", {})),
              HasSubstr("expected a PNG, JPEG or FITS image, found an empty file"));
  const std::vector<std::byte> text(100, std::byte{'x'});
  EXPECT_THAT(error_of(written("text.png", text)), HasSubstr("found another kind of file"));
  EXPECT_THROW(write_png("/no/such/folder/a.png", pattern<std::uint8_t>(1).view()), InputError);
}

TEST(ImageFile, RealPhotographsAreRead) {
  const std::string sky = OMMA_SHARED_DATA "/data/sky/";
  if (!std::filesystem::exists(sky)) GTEST_SKIP() << "needs the shared folder " << sky;
  const Image kho = read_image(sky + "kho/LYR-Sony-111220_200933_gray2.png");
  EXPECT_EQ(kho.width, 1416);
  const Image indi = read_image(sky + "indi/20210421_043940.jpg");
  EXPECT_EQ(indi.width, 1936);
  EXPECT_EQ(indi.height, 1096);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sky)) {
    const std::string ending = entry.path().extension();
    if (ending != ".png" && ending != ".jpg") continue;
    EXPECT_NO_THROW(read_image(entry.path())) << entry.path();
  }
}

}  // namespace
}  // namespace omma
