#include <gtest/gtest.h>

#include <fitsio.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "components/sensor/black_frame.hpp"
#include "components/sensor/black_frame_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 80, kHeight = 60;

// Dark frames with a pattern, noise, two bright pixels and a noisy one.
Image dark_frame(std::mt19937_64& random) {
  Image image;
  image.resize(kWidth, kHeight, PixelFormat::kGrey8);
  std::normal_distribution<double> normal(0, 1);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      double grey = 20 + (u % 2) + 1.2 * normal(random);
      if ((u == 10 && v == 5) || (u == 79 && v == 59)) grey += 60;
      if (u == 40 && v == 30) grey += 12 * normal(random);
      image.pixels[static_cast<std::size_t>(v * kWidth + u)] =
          static_cast<std::byte>(static_cast<int>(std::clamp(std::round(grey), 0.0, 255.0)));
    }
  }
  return image;
}

BlackFrame made(HotPixelCounts& counts, int frames = 40) {
  std::mt19937_64 random(3);
  BlackFrameBuilder builder;
  for (int k = 0; k < frames; ++k) EXPECT_TRUE(builder.add(dark_frame(random).view()));
  return builder.build({}, counts);
}

std::string message_of(const fs::path& file) {
  return refusal_of([&] { read_black_frame(file); });
}

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("omma_black_" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

TEST(BlackFrame, HasMeanAndNoiseOfEachPixelAndTheHotOnes) {
  HotPixelCounts counts;
  const BlackFrame black = made(counts);
  EXPECT_EQ(black.frames, 40);
  EXPECT_NEAR(black.mean[0], 20, 0.8);
  EXPECT_NEAR(black.mean[1], 21, 0.8);
  EXPECT_NEAR(black.typical_noise(), std::sqrt(1.2 * 1.2 + 1.0 / 12), 0.1);
  EXPECT_EQ(counts.bright, 2);
  EXPECT_EQ(counts.noisy, 1);
  EXPECT_EQ(counts.all, 3);
  EXPECT_TRUE(black.hot.at(10, 5) && black.hot.at(79, 59) && black.hot.at(40, 30));
}

TEST(BlackFrame, OfOneFrameHasNoNoise) {
  HotPixelCounts counts;
  const BlackFrame black = made(counts, 1);
  EXPECT_EQ(black.typical_noise(), 0);
  EXPECT_TRUE(black.hot.at(10, 5));
}

TEST(BlackFrame, RefusesAFrameOfAnotherSize) {
  std::mt19937_64 random(3);
  BlackFrameBuilder builder;
  EXPECT_TRUE(builder.add(dark_frame(random).view()));
  Image other;
  other.resize(kWidth, kHeight - 1, PixelFormat::kGrey8);
  EXPECT_FALSE(builder.add(other.view()));
  EXPECT_EQ(builder.frames(), 1);
}

TEST(BlackFrameFile, GivesBackWhatWasWritten) {
  const Folder folder;
  HotPixelCounts counts;
  const BlackFrame black = made(counts);
  write_black_frame(folder.path / "black.fits", black);
  write_black_frame(folder.path / "black.fits", black);  // over an older one
  const BlackFrame read = read_black_frame(folder.path / "black.fits");
  EXPECT_EQ(read.width, kWidth);
  EXPECT_EQ(read.frames, black.frames);
  EXPECT_EQ(read.mean, black.mean);
  EXPECT_EQ(read.noise, black.noise);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(read.hot.at(u, v), black.hot.at(u, v));
}

TEST(BlackFrameFile, SaysWhatIsWrongWithAFile) {
  const Folder folder;
  HotPixelCounts counts;
  const fs::path good = folder.path / "black.fits";
  write_black_frame(good, made(counts));
  EXPECT_NE(message_of(folder.path / "none.fits").find("found no such file"), std::string::npos);
  const fs::path text = folder.path / "text.fits";
  std::ofstream(text) << "not FITS at all";
  EXPECT_NE(message_of(text).find("FITS: expected a FITS file"), std::string::npos) << message_of(text);
  const fs::path cut = folder.path / "cut.fits";
  fs::copy_file(good, cut);
  fs::resize_file(cut, 2880 + 8000);
  EXPECT_NE(message_of(cut).find("cut.fits"), std::string::npos);
  const fs::path part = folder.path / "part.fits";  // the mean alone
  fs::copy_file(good, part);
  fs::resize_file(part, 2880 + (kWidth * kHeight * 4 + 2879) / 2880 * 2880);
  EXPECT_NE(message_of(part).find("NOISE and HOT"), std::string::npos) << message_of(part);
  const fs::path other = folder.path / "other.fits";
  {
    fitsfile* fits = nullptr;
    int status = 0;
    long sides[] = {4, 4};
    fits_create_diskfile(&fits, other.c_str(), &status);
    fits_create_img(fits, BYTE_IMG, 2, sides, &status);
    fits_close_file(fits, &status);
    ASSERT_EQ(status, 0);
  }
  EXPECT_NE(message_of(other).find("another FITS file"), std::string::npos) << message_of(other);
}

TEST(BlackFrameFile, SaysWhereItCannotBeWritten) {
  HotPixelCounts counts;
  EXPECT_THROW(write_black_frame("/nowhere/at/all.fits", made(counts, 1)), InputError);
}

}  // namespace
}  // namespace omma
