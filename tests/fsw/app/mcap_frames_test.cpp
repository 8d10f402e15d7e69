// Frames out of an MCAP file of ROS 2 images: the right picture under the number of its instant; what is none
// is named.
#include "fsw/app/mcap_frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "components/telemetry/mcap_writer.hpp"
#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/recorded_camera.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriod = 100'000'000;

/// CDR by the rules of the standard, not by the reader's code.
class Message {
 public:
  explicit Message(std::int64_t stamp_ns) {
    number(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
    number(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
    text("cam0_optical");
  }
  Message& number(std::uint32_t value) {
    while ((bytes_.size() - 4) % 4 != 0) bytes_.push_back(std::byte{0});
    for (int i = 0; i < 4; ++i) bytes_.push_back(static_cast<std::byte>(value >> (8 * i)));
    return *this;
  }
  Message& byte(std::uint8_t value) {
    bytes_.push_back(std::byte{value});
    return *this;
  }
  Message& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    for (const char c : value) bytes_.push_back(static_cast<std::byte>(c));
    return byte(0);
  }
  Message& data(const std::vector<std::byte>& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    return *this;
  }
  std::vector<std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
};

/// 8 x 4 px, rows of 10 bytes, every pixel `level`.
std::vector<std::byte> raw(std::int64_t stamp_ns, std::uint8_t level, const std::string& encoding = "mono8") {
  return Message(stamp_ns)
      .number(4)
      .number(8)
      .text(encoding)
      .byte(0)
      .number(10)
      .data(std::vector<std::byte>(40, std::byte{level}))
      .bytes();
}

std::vector<std::byte> compressed(std::int64_t stamp_ns, std::uint8_t level) {
  Image image;
  image.resize(8, 4, PixelFormat::kGrey8);
  for (std::byte& pixel : image.pixels) pixel = std::byte{level};
  return Message(stamp_ns).text("png").data(encode_png(image.view())).bytes();
}

class McapRecording : public ::testing::Test {
 protected:
  McapRecording() : writer_(path_.string(), {.chunk_bytes = 200}) {
    const auto image = writer_.add_schema("sensor_msgs/msg/Image", "ros2msg", "");
    const auto png = writer_.add_schema("sensor_msgs/msg/CompressedImage", "ros2msg", "");
    const auto other = writer_.add_schema("std_msgs/msg/String", "ros2msg", "");
    cam0_ = writer_.add_channel(image, "/cam0/image_raw", "cdr");
    cam1_ = writer_.add_channel(png, "/cam1/image_raw/compressed", "cdr");
    cam1_again_ = writer_.add_channel(image, "/cam1/image_raw", "cdr");
    words_ = writer_.add_channel(other, "/cam0/words", "cdr");
  }
  ~McapRecording() override { std::filesystem::remove(path_); }

  void write(std::uint16_t channel, const std::vector<std::byte>& message) {
    writer_.write(channel, 0, kStart, kStart, message);
  }
  McapFrames open(const std::string& camera, double rate_hz = 10) {
    writer_.close();
    return {path_, camera, rate_hz};
  }
  std::string refusal(const std::string& camera) {
    return refusal_of([&] {
      McapFrames frames = open(camera);
      Image image;
      for (std::size_t i = 0; i < frames.count(); ++i) frames.read(i, image);
    });
  }

  std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("omma_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".mcap");
  mcap::Writer writer_;
  std::uint16_t cam0_ = 0, cam1_ = 0, cam1_again_ = 0, words_ = 0;
};

TEST_F(McapRecording, FramesOfOneInstantHaveOneNumberAlsoWhereACameraLostSome) {
  for (int n = 0; n < 9; ++n) {
    const std::int64_t stamp = kStart + n * kPeriod;
    if (n > 0) write(cam0_, raw(stamp + 3'000'000, static_cast<std::uint8_t>(n)));
    write(words_, Message(stamp).bytes());
    if (n % 3 != 1) write(cam1_, compressed(stamp, static_cast<std::uint8_t>(100 + n)));
  }
  McapFrames cam0 = open("cam0");
  ASSERT_EQ(cam0.count(), 8U);
  EXPECT_EQ(cam0.number(0), 1U);
  Image image;
  for (const std::size_t i : {7U, 0U, 3U}) {  // in any order
    cam0.read(i, image);
    EXPECT_EQ(image.width, 8);
    EXPECT_EQ(std::to_integer<std::uint64_t>(image.pixels[31]), cam0.number(i));
  }
  RecordedCamera cam1(std::make_unique<McapFrames>(path_, "cam1", 10), {});
  for (std::uint64_t n = 0; n < 9; ++n) {
    const Frame frame = cam1.grab(n, 0);
    EXPECT_EQ(frame.status, n % 3 == 1 ? FrameStatus::kMissing : FrameStatus::kFresh) << n;
    if (frame.status == FrameStatus::kFresh) {
      EXPECT_EQ(std::to_integer<std::uint64_t>(frame.image.data[0]), 100 + n);
    }
  }
}

TEST_F(McapRecording, JpegFramesAreTakenToo) {
  for (int n = 0; n < 3; ++n) {
    Image image;
    image.resize(16, 8, PixelFormat::kGrey8);
    for (std::byte& pixel : image.pixels) pixel = static_cast<std::byte>(40 * (n + 1));
    write(cam1_, Message(kStart + n * kPeriod).text("jpeg").data(encode_jpeg(image.view(), 98)).bytes());
  }
  McapFrames cam1 = open("cam1");
  ASSERT_EQ(cam1.count(), 3U);
  EXPECT_EQ(cam1.size(1).width, 16);
  EXPECT_EQ(cam1.size(1).bits, 8);
  for (std::size_t i = 0; i < 3; ++i) {
    Image image;
    cam1.read(i, image);
    EXPECT_EQ(cam1.number(i), i);
    EXPECT_NEAR(std::to_integer<int>(image.pixels[100]), 40 * (static_cast<int>(i) + 1), 1);
  }
}

TEST_F(McapRecording, AJpegThatIsCutShortIsRefused) {
  Image image;
  image.resize(64, 64, PixelFormat::kGrey8);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::byte>(i * 7919 % 251);
  std::vector<std::byte> jpeg = encode_jpeg(image.view(), 98);
  jpeg.resize(jpeg.size() / 2);
  write(cam1_, Message(kStart).text("jpeg").data(jpeg).bytes());
  EXPECT_THAT(refusal("cam1"), HasSubstr("JPEG: expected a whole image"));
}

TEST_F(McapRecording, ACameraWithoutImagesIsNamed) {
  write(cam0_, raw(kStart, 1));
  EXPECT_THAT(refusal("cam"),
              HasSubstr("expected images (sensor_msgs/msg/Image or CompressedImage) on a topic of /cam,"));
}

TEST_F(McapRecording, TwoFramesInOnePeriodAreRefused) {
  write(cam0_, raw(kStart, 1));
  write(cam0_, raw(kStart + 20'000'000, 2));
  EXPECT_THAT(refusal("cam0"),
              HasSubstr("at most one image of a camera in 1/frame_rate_hz = 0.100000 s, found two at 0.02"));
}

TEST_F(McapRecording, TwoTopicsOfOneCameraAreRefused) {
  write(cam1_, compressed(kStart, 1));
  write(cam1_again_, raw(kStart + kPeriod, 2));
  EXPECT_THAT(refusal("cam1"),
              HasSubstr("images of cam1 on one topic, found /cam1/image_raw/compressed and /cam1/image_raw"));
}

TEST_F(McapRecording, AnEncodingThatIsNotUnderstoodIsNamed) {
  write(cam0_, raw(kStart, 1, "32FC1"));
  EXPECT_THAT(refusal("cam0"),
              HasSubstr("image 1: encoding: expected mono8, mono16, rgb8 or bgr8, found 32FC1"));
}

TEST_F(McapRecording, AMessageThatIsCutShortIsRefused) {
  std::vector<std::byte> message = raw(kStart, 1);
  message.pop_back();
  write(cam0_, message);
  EXPECT_THAT(refusal("cam0"), HasSubstr("expected a whole image, found one that is cut short"));
}

TEST_F(McapRecording, RowsThatAreNotThereAreRefused) {
  write(cam0_, Message(kStart)
                   .number(4)
                   .number(8)
                   .text("mono8")
                   .byte(0)
                   .number(10)
                   .data(std::vector<std::byte>(39))
                   .bytes());
  EXPECT_THAT(refusal("cam0"),
              HasSubstr("data: expected all rows of the image, found 39 bytes in rows of 10"));
}

TEST_F(McapRecording, AnotherByteOrderIsRefused) {
  std::vector<std::byte> message = raw(kStart, 1);
  message[1] = std::byte{0};
  write(cam0_, message);
  EXPECT_THAT(refusal("cam0"),
              HasSubstr("/cam0/image_raw: message: expected little-endian CDR, found another encoding"));
}

}  // namespace
}  // namespace omma
