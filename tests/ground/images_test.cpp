// `omma images` and `omma composite` as an operator runs them.
#include <gmock/gmock.h>

#include <array>
#include <vector>

#include "components/imaging/grey_scale.hpp"
#include "components/imaging/image_coder.hpp"
#include "components/sensor/fits_handle.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/ground/sample_recording.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 40;
constexpr int kHeight = 30;

std::uint8_t grey(int row, int column) {
  return static_cast<std::uint8_t>(1 + 3 * row + column);
}

/// A picture in chunks of ten rows, the first as it is, the others compressed; `lost` does not come down.
void write_pictures(const std::string& path, int lost, bool damaged = false) {
  telemetry::RecordingWriter recording(path, "testsat", false, {});
  telemetry::CdrWriter cdr;
  ImageCoder coder(kWidth * kHeight);
  for (int part = 0; part < 3; ++part) {
    if (part == lost) continue;
    std::vector<std::uint8_t> rows;
    for (int row = 10 * part; row < 10 * part + 10; ++row)
      for (int column = 0; column < kWidth; ++column) rows.push_back(grey(row, column));
    std::vector<std::uint8_t> bytes = rows;
    if (part > 0) {
      bytes.resize(8192);
      bytes.resize(coder.encode(rows, kWidth, bytes));
    }
    if (damaged) bytes.resize(bytes.size() / 2);
    omma_ImageChunk chunk{};
    chunk.frame = static_cast<std::uint64_t>(part);
    chunk.sample_number = static_cast<std::uint32_t>(part + 1);
    chunk.valid = true;
    chunk.kind = omma_IMAGE_FISHEYE_RIG;
    chunk.composite = omma_COMPOSITE_DARKEST;
    chunk.composed = 12;
    chunk.image = 7;
    chunk.bits = 8;
    chunk.light_most = 0.25;
    chunk.width_px = kWidth;
    chunk.height_px = kHeight;
    chunk.first_row = static_cast<std::uint16_t>(10 * part);
    chunk.rows = 10;
    chunk.encoding = part > 0 ? omma_ENCODING_PREDICTED_ZSTD : omma_ENCODING_GREY;
    const auto size = static_cast<std::uint32_t>(bytes.size());
    chunk.pixels = {size, size, bytes.data(), false};
    recording.write(telemetry::TopicId::kImageChunk, cdr.write(telemetry::TopicId::kImageChunk, &chunk));
  }
  recording.close();
}

TEST(ImagesCommand, PutsAPictureTogetherFromItsChunks) {
  const OperatorsFolder folder;
  write_pictures((folder / "pass.mcap").string(), -1);
  const Told told = folder.omma("images pass.mcap --out pictures");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("fisheye_rig"));
  EXPECT_THAT(told.out, HasSubstr("darkest   12"));
  const Image image = read_image(folder / "pictures/00007_fisheye_rig_darkest.png");
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      ASSERT_EQ(image.view().row<std::uint8_t>(row)[column], grey(row, column)) << row << ", " << column;
}

TEST(ImagesCommand, AFusedPictureComesWithItsLightAsNumbers) {
  const OperatorsFolder folder;
  const GreyScale scale{ImageScale::kAsinh, 12, 500, 0.01};
  {
    telemetry::RecordingWriter recording((folder / "pass.mcap").string(), "testsat", false, {});
    telemetry::CdrWriter cdr;
    std::vector<std::uint8_t> bytes;
    for (const double light : {0.0, 0.02, 3.0, 450.0}) {
      const std::uint16_t level = scale.level(light);
      bytes.push_back(static_cast<std::uint8_t>(level));
      bytes.push_back(static_cast<std::uint8_t>(level >> 8));
    }
    omma_ImageChunk chunk{};
    chunk.valid = true;
    chunk.kind = omma_IMAGE_VIEW_RIG;
    chunk.composite = omma_COMPOSITE_FUSED;
    chunk.composed = 4;
    chunk.image = 1;
    chunk.width_px = chunk.height_px = chunk.rows = 2;
    chunk.bits = 12;
    chunk.scale = omma_SCALE_ASINH;
    chunk.light_most = scale.most;
    chunk.light_soft = scale.soft;
    chunk.pixels = {8, 8, bytes.data(), false};
    recording.write(telemetry::TopicId::kImageChunk, cdr.write(telemetry::TopicId::kImageChunk, &chunk));
    recording.close();
  }
  const Told told = folder.omma("images pass.mcap --out pictures");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("00001_view_rig_fused.png .fits"));
  FitsFile fits((folder / "pictures/00001_view_rig_fused.fits").string());
  fits.open();
  std::array<float, 4> light{};
  std::array<long, 2> first{1, 1};
  fits.call(
      [&](int* status) {
        fits_read_pix(fits.get(), TFLOAT, first.data(), 4, nullptr, light.data(), nullptr, status);
      },
      "four pixels");
  EXPECT_NEAR(light[0], 0, 1e-4);
  EXPECT_NEAR(light[1], 0.02, 1e-4);
  EXPECT_NEAR(light[2], 3, 0.02);
  EXPECT_NEAR(light[3], 450, 2);
  EXPECT_EQ(read_image(folder / "pictures/00001_view_rig_fused.png").width, 2);
}

TEST(ImagesCommand, RowsThatDidNotComeDownAreCountedAndHatched) {
  const OperatorsFolder folder;
  write_pictures((folder / "pass.mcap").string(), 1);
  const Told told = folder.omma("images pass.mcap");
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_THAT(told.out, HasSubstr("    10  "));
  const Image image = read_image(folder / "00007_fisheye_rig_darkest.png");
  EXPECT_EQ(image.view().row<std::uint8_t>(25)[3], grey(25, 3));
  int hatched = 0;
  for (int column = 0; column < kWidth; ++column)
    hatched += image.view().row<std::uint8_t>(15)[column] > 0 ? 1 : 0;
  EXPECT_GT(hatched, 2);
  EXPECT_LT(hatched, kWidth / 2);
}

TEST(ImagesCommand, DamagedChunksAndRecordingsWithoutPicturesAreNamed) {
  const OperatorsFolder folder;
  write_pictures((folder / "damaged.mcap").string(), -1, true);
  EXPECT_THAT(folder.omma("images damaged.mcap").err,
              HasSubstr("damaged.mcap: image_chunk: expected a picture at least, found none"));
  test::write_recording((folder / "other.mcap").string(), 3);
  const Told told = folder.omma("images other.mcap");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_THAT(told.err, HasSubstr("other.mcap: image_chunk: expected a picture at least, found none"));
  EXPECT_EQ(folder.omma("images missing.mcap").exit_code, 2);
}

void write_grey(const std::filesystem::path& file, std::vector<std::uint8_t> pixels) {
  ImageView view;
  view.data = reinterpret_cast<const std::byte*>(pixels.data());
  view.width = static_cast<int>(pixels.size());
  view.height = 1;
  view.stride = view.width;
  write_png(file, view);
}

TEST(CompositeCommand, MakesOneImageOfManyAndFusesExposures) {
  const OperatorsFolder folder;
  write_grey(folder / "a.png", {10, 200, 30});
  write_grey(folder / "b.png", {90, 20, 30});
  const auto level = [&](int column) {
    const Image image = read_image(folder / "out.png");
    return image.view().row<std::uint16_t>(0)[column] / 257.0;
  };
  EXPECT_EQ(folder.omma("composite darkest a.png b.png --out out.png").exit_code, 0);
  EXPECT_NEAR(level(0), 10, 0.01);
  EXPECT_EQ(folder.omma("composite brightest a.png b.png --out out.png").exit_code, 0);
  EXPECT_NEAR(level(1), 200, 0.01);
  EXPECT_EQ(folder.omma("composite mean a.png b.png --out out.png").exit_code, 0);
  EXPECT_NEAR(level(1), 110, 0.01);
  write_grey(folder / "short.png", {2, 40, 100});
  write_grey(folder / "long.png", {20, 255, 255});  // full where the short one measures
  const Told told = folder.omma("composite fuse short.png long.png --exposures 0.1,1 --out out.png");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("65535 is 1000 grey levels a second"));
  EXPECT_NEAR(level(1) / 255, 0.4, 0.001);
  EXPECT_NEAR(level(0) / 255, 0.02, 0.001);
}

TEST(CompositeCommand, SaysWhatDoesNotFit) {
  const OperatorsFolder folder;
  write_grey(folder / "a.png", {10, 200, 30});
  write_grey(folder / "b.png", {90, 20});
  EXPECT_THAT(folder.omma("composite mean a.png b.png --out out.png").err,
              HasSubstr("b.png: image: expected 3 x 1 px as the first, found 2 x 1"));
  EXPECT_THAT(folder.omma("composite fuse a.png a.png --exposures 1 --out out.png").err,
              HasSubstr("--exposures: expected 2 times, one an image, found 1"));
  EXPECT_THAT(folder.omma("composite fuse a.png a.png --exposures 1,-2 --out out.png").err,
              HasSubstr("--exposures: expected seconds above 0"));
  EXPECT_EQ(folder.omma("composite median a.png --out out.png").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

}  // namespace
}  // namespace omma
