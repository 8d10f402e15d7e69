// Frames of a ROS 2 recording that software of others wrote: the public MCAP writer and ROS 2 serialiser from
// npm. Needs node, and the modules in <build>/ros2_modules or a network to fetch them once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fsw/app/mcap_frames.hpp"
#include "hal/recorded/image_file.hpp"
#include "hal/recorded/recorded_camera.hpp"
#include "tests/ground/run_program.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

constexpr const char* kModules =
    "@mcap/core@2.2.2 @foxglove/rosmsg@5.0.5 @foxglove/rosmsg2-serialization@3.1.0 @foxglove/wasm-zstd@1.0.1";

class Ros2Recording : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::run_program("node --version").exit_code != 0) GTEST_SKIP() << "node is not installed";
    const std::filesystem::path modules = std::filesystem::path(OMMA_BINARY_DIR) / "ros2_modules";
    std::filesystem::create_directories(modules);
    // One after the other: both tests may run at once, and each wants the modules.
    const test::ProgramRun install = test::run_program(
        "cd " + modules.string() + " && flock lock sh -c 'test -e complete || { " +
        "timeout 60 npm install --no-save --no-audit --prefix . " + kModules + " && touch complete; }'");
    if (install.exit_code != 0)
      GTEST_SKIP() << "the public writer's modules are not to be had: " << install.output;
    Image image;
    image.resize(16, 8, PixelFormat::kGrey8);
    for (std::byte& pixel : image.pixels) pixel = std::byte{77};
    const std::vector<std::byte> png = encode_png(image.view());
    std::ofstream(png_, std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    modules_ = modules.string();
  }
  ~Ros2Recording() override {
    std::filesystem::remove(path_);
    std::filesystem::remove(png_);
  }
  void write(const std::string& compression) const {
    const test::ProgramRun run =
        test::run_program("node " OMMA_SOURCE_DIR "/tests/ground/write_ros2_recording.mjs " + modules_ + " " +
                          path_.string() + " " + compression + " " + png_.string());
    ASSERT_EQ(run.exit_code, 0) << run.output;
  }
  /// Every pixel of every frame of a raw camera: `scale` times (frame + x + y).
  void expect_frames(const std::string& camera, unsigned scale) const {
    McapFrames frames(path_, camera, 10);
    ASSERT_EQ(frames.count(), 10U);
    for (std::size_t n = 0; n < 10; ++n) {
      Image image;
      frames.read(n, image);
      EXPECT_EQ(frames.number(n), n);
      ASSERT_EQ(image.width, 32);
      ASSERT_EQ(image.height, 24);
      const ImageView view = image.view();
      for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 32; ++x) {
          const std::byte* const at = view.data + y * view.stride + x * image.bytes_per_pixel();
          const unsigned value = std::to_integer<unsigned>(at[0]) +
                                 (image.bytes_per_pixel() == 2 ? std::to_integer<unsigned>(at[1]) << 8 : 0U);
          ASSERT_EQ(value, scale * (static_cast<unsigned>(n) + static_cast<unsigned>(x + y)))
              << camera << " frame " << n << " at " << x << ", " << y;
        }
      }
    }
  }

  std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) / ("omma_ros2_" + std::to_string(getpid()) + ".mcap");
  std::filesystem::path png_ = path_.string() + ".png";
  std::string modules_;
};

TEST_F(Ros2Recording, OfTheirWriterIsPlayedPixelForPixelWithAndWithoutCompression) {
  for (const char* const compression : {"none", "zstd"}) {
    SCOPED_TRACE(compression);
    write(compression);
    expect_frames("cam0", 1);
    expect_frames("cam1", 1000);
    RecordedCamera cam2(std::make_unique<McapFrames>(path_, "cam2", 10), {});
    for (std::uint64_t n = 0; n < 10; ++n) {
      const Frame frame = cam2.grab(n, 0);
      EXPECT_EQ(frame.status, n == 4 ? FrameStatus::kMissing : FrameStatus::kFresh) << n;
      if (frame.status != FrameStatus::kFresh) continue;
      EXPECT_EQ(frame.image.width, 16);
      EXPECT_EQ(std::to_integer<int>(frame.image.data[5]), 77);
    }
  }
}

TEST_F(Ros2Recording, InAnotherCompressionIsRefused) {
  write("lz4");
  EXPECT_EQ(refusal_of([&] { McapFrames(path_, "cam0", 10); }),
            path_.string() +
                ": chunk: expected no compression or zstd (mcap compress --compression zstd), found lz4");
}

}  // namespace
}  // namespace omma
