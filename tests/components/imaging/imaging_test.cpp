// The imaging component: pictures in chunks over many frame sets, without a single allocation.
#include "components/imaging/imaging.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/components/imaging/imaging_bench.hpp"

namespace omma {
namespace {

using testing::smooth_sky;
using Bench = testing::ImagingBench;

ImagingParameters small_panorama() {
  ImagingParameters parameters;
  parameters.panorama.width = 512;
  parameters.footprint = Footprint::kMean;
  return parameters;
}

TEST(Imaging, DegradedMakesTheSamePictureOfSmallerChunks) {
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const int level : {0, 1, 2, 30}) {
    Bench bench(small_panorama());
    bench.take(1, Eigen::Quaterniond::Identity());
    bench.imaging.degrade(level);
    const int most = std::max(1, 16 >> level);
    std::vector<std::uint8_t> picture(512 * 256);
    for (int rows = 0; rows < 256; rows += bench.imaging.chunk->rows) {
      bench.imaging.step({});
      ASSERT_EQ(bench.imaging.chunk->rows, most);
      std::memcpy(picture.data() + rows * 512, bench.imaging.chunk->pixels.data(),
                  static_cast<std::size_t>(most) * 512);
    }
    pictures.push_back(picture);
  }
  for (const std::vector<std::uint8_t>& picture : pictures) EXPECT_EQ(picture, pictures[0]);
}

TEST(Imaging, LeftOutWithdrawsItsChunk) {
  Bench bench(small_panorama());
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  ASSERT_TRUE(bench.imaging.chunk->valid);
  bench.imaging.skipped({});
  EXPECT_FALSE(bench.imaging.chunk->valid);
  bench.imaging.step({});
  EXPECT_EQ(bench.imaging.chunk->first_row, 16);
}

TEST(Imaging, ChunksTakenWhileTheRigTurnsMakeOnePictureOfTheSky) {
  Bench bench(small_panorama());
  std::vector<std::uint8_t> picture(512 * 256);
  int rows = 0;
  for (std::uint64_t number = 1; rows < 256; ++number) {
    ASSERT_LT(number, 100U);
    bench.take(number, rotation_exp(Eigen::Vector3d(0.02 * static_cast<double>(number), 0.3, 0.1)));
    bench.imaging.step({});
    const ImageChunk& chunk = *bench.imaging.chunk;
    ASSERT_TRUE(chunk.valid);
    EXPECT_EQ(chunk.frame, number);
    EXPECT_EQ(chunk.image, 1U);
    EXPECT_EQ(chunk.first_row, rows);
    EXPECT_EQ(chunk.height, 256);
    std::memcpy(picture.data() + rows * 512, chunk.pixels.data(), std::size_t{chunk.rows} * chunk.width);
    rows += chunk.rows;
  }
  EXPECT_EQ(rows, 256);
  for (int v = 0; v < 256; ++v) {
    for (int u = 0; u < 512; ++u) {
      const int grey = picture[v * 512 + u];
      if (grey == 0) continue;
      const double truth = smooth_sky(panorama_direction(Eigen::Vector2d(u, v), 512));
      ASSERT_NEAR(grey, companded(truth, PanoramaSettings{}.white), 2) << u << ", " << v;
    }
  }
  bench.take(200, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  EXPECT_EQ(bench.imaging.chunk->image, 2U);
  EXPECT_EQ(bench.imaging.chunk->first_row, 0);
}

TEST(Imaging, RowsWaitWhileThereIsNoAttitude) {
  Bench bench(small_panorama());
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  const int next = bench.imaging.chunk->rows;
  bench.take(2, Eigen::Quaterniond::Identity());
  bench.attitude->valid = false;
  bench.imaging.step({});
  EXPECT_FALSE(bench.imaging.chunk->valid);
  EXPECT_EQ(bench.imaging.chunk->rows, 0);
  EXPECT_EQ(bench.imaging.chunk->frame, 2U) << "an old chunk is not taken for a new one";
  bench.take(3, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  EXPECT_TRUE(bench.imaging.chunk->valid);
  EXPECT_EQ(bench.imaging.chunk->first_row, next);
}

TEST(Imaging, APanoramaFixedToTheRigNeedsNoAttitude) {
  ImagingParameters parameters = small_panorama();
  parameters.kind = ImageKind::kPanoramaRig;
  Bench bench(parameters);
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.attitude->valid = false;
  bench.imaging.step({});
  EXPECT_TRUE(bench.imaging.chunk->valid);
}

TEST(Imaging, StaleFramesAreNotShown) {
  Bench bench(small_panorama());
  bench.take(1, Eigen::Quaterniond::Identity());
  for (Frame& frame : bench.frames->cameras) frame.status = FrameStatus::kStuck;
  bench.imaging.step({});
  EXPECT_FALSE(bench.imaging.chunk->valid);
}

TEST(Imaging, PausesBetweenPicturesForItsPeriod) {
  ImagingParameters parameters = small_panorama();
  parameters.period = 40;
  Bench bench(parameters);
  bench.take(1, Eigen::Quaterniond::Identity());
  int first_of_second = 0;
  for (int step = 0; step < 60 && first_of_second == 0; ++step) {
    bench.imaging.step({});
    if (bench.imaging.chunk->valid && bench.imaging.chunk->image == 2) first_of_second = step;
  }
  EXPECT_EQ(first_of_second, 40);
}

TEST(Imaging, SubtractsEachCamerasOwnBackground) {
  ImagingParameters parameters = small_panorama();
  Bench bench(parameters);
  bench.take(1, Eigen::Quaterniond::Identity());
  for (std::size_t camera = 0; camera < 3; ++camera) {
    std::fill(bench.images.pixels[camera].begin(), bench.images.pixels[camera].end(), 300 + 100 * camera);
    bench.dots->cameras[camera].background = static_cast<float>(300 + 100 * camera);
  }
  bench.imaging.step({});
  const ImageChunk& chunk = *bench.imaging.chunk;
  ASSERT_TRUE(chunk.valid);
  for (int i = 0; i < chunk.rows * chunk.width; ++i) ASSERT_LE(chunk.pixels[i], 1);
}

TEST(Imaging, AViewIsSentInChunksToo) {
  ImagingParameters parameters;
  parameters.kind = ImageKind::kView;
  parameters.view = {100, 100, 0.8, 0.5};
  parameters.pan = 1.0;
  Bench bench(parameters);
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  EXPECT_EQ(bench.imaging.chunk->rows, 81) << "as many rows of 100 as fit 8192 bytes";
  bench.imaging.step({});
  EXPECT_EQ(bench.imaging.chunk->first_row, 81);
  EXPECT_EQ(bench.imaging.chunk->rows, 19);
}

TEST(Imaging, StepsAllocateNothing) {
  if (!memory_guard::installed()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  Bench bench(small_panorama());
  bench.take(1, rotation_exp(Eigen::Vector3d(0.2, 0.3, 0.1)));
  const std::uint64_t before = memory_guard::violations().total();
  for (int step = 0; step < 40; ++step) {  // more than one picture
    const RealTimeScope scope;
    bench.imaging.step({});
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_EQ(bench.imaging.chunk->image, 3U);
}

/// Steps until a picture is sent; its pixels.
std::vector<std::uint8_t> whole_picture(Bench& bench) {
  std::vector<std::uint8_t> picture;
  for (int step = 0; step < 2000; ++step) {
    bench.imaging.step({});
    const ImageChunk& chunk = *bench.imaging.chunk;
    if (!chunk.valid) continue;
    picture.resize(std::size_t{chunk.width} * chunk.height);
    const std::span<std::uint8_t> rows(picture.data() + std::size_t{chunk.first_row} * chunk.width,
                                       std::size_t{chunk.rows} * chunk.width);
    const std::span<const std::uint8_t> bytes(chunk.pixels.data(), chunk.bytes);
    if (chunk.encoding == ImageEncoding::kGrey)
      std::copy(bytes.begin(), bytes.end(), rows.begin());
    else
      EXPECT_TRUE(decode_rows(bytes, chunk.width, chunk.rows, rows));
    if (chunk.first_row + chunk.rows == chunk.height) return picture;
  }
  ADD_FAILURE() << "no picture";
  return picture;
}

TEST(Imaging, CompressedIsTheSamePictureInFewerChunks) {
  std::vector<std::vector<std::uint8_t>> pictures;
  std::vector<int> steps;
  for (const bool compress : {false, true}) {
    ImagingParameters parameters = small_panorama();
    parameters.compress = compress;
    Bench bench(parameters);
    bench.take(1, Eigen::Quaterniond::Identity());
    pictures.push_back(whole_picture(bench));
    int count = 1;
    do {
      bench.imaging.step({});
      ++count;
    } while (bench.imaging.chunk->first_row + bench.imaging.chunk->rows < 256);
    steps.push_back(count);
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_LT(steps[1], steps[0] / 2);
}

TEST(Imaging, ADarkestCompositeLosesALightThatPasses) {
  ImagingParameters parameters = small_panorama();
  parameters.composite = ImageComposite::kDarkest;
  parameters.composed = 3;
  parameters.composed_rows = 64;
  Bench bench(parameters);
  bench.take(1, Eigen::Quaterniond::Identity());
  std::vector<std::uint8_t> plain;
  {
    Bench single(small_panorama());
    single.take(1, Eigen::Quaterniond::Identity());
    plain = whole_picture(single);
  }
  // A light over the whole second pass: the second camera full.
  const std::vector<std::uint16_t> kept = bench.images.pixels[1];
  for (int step = 0; step < 12; ++step) {
    if (step == 4)
      std::fill(bench.images.pixels[1].begin(), bench.images.pixels[1].end(), std::uint16_t{4095});
    if (step == 8) bench.images.pixels[1] = kept;
    bench.imaging.step({});
    EXPECT_FALSE(bench.imaging.chunk->valid) << step;
  }
  EXPECT_EQ(whole_picture(bench), plain);
  EXPECT_EQ(bench.imaging.chunk->composite, ImageComposite::kDarkest);
  EXPECT_EQ(bench.imaging.chunk->composed, 3);
}

TEST(Imaging, APictureAskedForIsMadeOnceThenTheMissionsAgain) {
  Bench bench(small_panorama());
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  EXPECT_TRUE(bench.imaging.request({ImageKind::kFisheyeJ2000, 0.3, -0.2, 2.0}));
  EXPECT_TRUE(bench.imaging.request({ImageKind::kView, 0.3, -0.2, 3.5}));  // wider than a pinhole sees
  whole_picture(bench);
  EXPECT_EQ(bench.imaging.chunk->kind, ImageKind::kPanoramaJ2000) << "the one begun is ended first";
  const std::vector<std::uint8_t> fisheye = whole_picture(bench);
  EXPECT_EQ(bench.imaging.chunk->kind, ImageKind::kFisheyeJ2000);
  EXPECT_EQ(bench.imaging.chunk->width, 512);
  const Eigen::Vector3d ahead = pan_tilt(0.3, -0.2) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(fisheye[256 * 512 + 256], companded(smooth_sky(ahead), FisheyeSettings{}.white), 2);
  EXPECT_EQ(fisheye[0], 0) << "outside the disc";
  whole_picture(bench);
  EXPECT_EQ(bench.imaging.chunk->kind, ImageKind::kPanoramaJ2000);
  EXPECT_EQ(bench.imaging.refused_requests(), 1U);
}

TEST(Imaging, TakesCommandsForAViewAndRefusesWhatAPinholeCannotSee) {
  Bench bench(small_panorama());
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.imaging.step({});
  Command command;
  command.opcode = kRequestPicture.id;
  command.argument_count = 4;
  command.arguments = {2, 17.2, -11.5, 57.3};  // a view; degrees
  EXPECT_EQ(bench.imaging.receive(command, {}).state, CommandOutcome::State::kDone);
  command.arguments[3] = 179;
  const CommandOutcome wide = bench.imaging.receive(command, {});
  EXPECT_EQ(wide.state, CommandOutcome::State::kRefused);
  EXPECT_EQ(wide.reason, CommandReason::kArgumentRange);
  EXPECT_EQ(wide.argument, 3);
  whole_picture(bench);
  const std::vector<std::uint8_t> view = whole_picture(bench);
  EXPECT_EQ(bench.imaging.chunk->kind, ImageKind::kView);
  const auto width = std::size_t{bench.imaging.chunk->width};
  const std::size_t middle = view.size() / 2 + width / 2;
  const double degree = std::numbers::pi / 180;
  const Eigen::Vector3d ahead = pan_tilt(17.2 * degree, -11.5 * degree) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(view[middle], companded(smooth_sky(ahead), ViewSettings{}.white), 2);
  command.arguments[3] = 0;  // the mission's
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(bench.imaging.receive(command, {}).state, CommandOutcome::State::kDone) << k;
  EXPECT_EQ(bench.imaging.receive(command, {}).reason, CommandReason::kBusy);
}

TEST(Imaging, APartOfACamerasImageIsItsPixels) {
  ImagingParameters parameters;
  parameters.kind = ImageKind::kCamera;
  parameters.region = {1, 100, 120, 64, 48};
  Bench bench(parameters);
  bench.take(1, Eigen::Quaterniond::Identity());
  bench.images.pixels[1][130U * 341U + 110U] = 4095;
  bench.attitude->valid = false;  // none is needed
  const std::vector<std::uint8_t> part = whole_picture(bench);
  ASSERT_EQ(part.size(), 64U * 48U);
  EXPECT_EQ(part[10 * 64 + 10], 255);
  EXPECT_EQ(part[0], companded(bench.images.pixels[1][120U * 341U + 100U] / 4095.0, 1.0));
  EXPECT_EQ(bench.imaging.chunk->camera, 1);
  EXPECT_EQ(bench.imaging.chunk->left, 100);
  parameters.region.left = 300;
  EXPECT_THROW(Bench{parameters}, std::invalid_argument);
}

TEST(Imaging, CompositesRequestsAndCompressionAllocateNothing) {
  if (!memory_guard::installed()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  ImagingParameters parameters = small_panorama();
  parameters.composite = ImageComposite::kMean;
  parameters.composed = 2;
  parameters.composed_rows = 64;
  parameters.compress = true;
  Bench bench(parameters);
  bench.take(1, rotation_exp(Eigen::Vector3d(0.2, 0.3, 0.1)));
  const std::uint64_t before = memory_guard::violations().total();
  for (int step = 0; step < 60; ++step) {
    const RealTimeScope scope;
    if (step == 5) bench.imaging.request({ImageKind::kView, 0.1, 0.2, 1.0});
    bench.imaging.step({});
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_GT(bench.imaging.chunk->image, 2U);
}

TEST(Imaging, RefusesARowLongerThanAChunk) {
  ImagingParameters parameters;
  parameters.panorama.width = 16384;
  EXPECT_THROW(Bench{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace omma
