// Samples to CDR bytes and back.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "components/telemetry/cdr.hpp"
#include "config/limits.hpp"

namespace omma::telemetry {
namespace {

static_assert(omma_MAX_CAMERAS == limits::kCameras);
static_assert(omma_MAX_DOTS == limits::kDotsPerCamera);
static_assert(omma_MAX_NAME == limits::kNameLength);
static_assert(omma_MAX_COMPONENTS == limits::kComponents);
static_assert(omma_MAX_GROUPS == limits::kRateGroups);
static_assert(omma_MAX_EVENT_VALUES == limits::kEventValues);
static_assert(omma_MAX_IMAGE_BYTES == limits::kImageChunkBytes);

omma_CameraDots three_dots(std::vector<omma_Dot>& dots) {
  dots.assign(3, omma_Dot{});
  for (std::size_t i = 0; i < dots.size(); ++i) {
    dots[i].u_px = 10.25F + static_cast<float>(i);
    dots[i].role = omma_DOT_TARGET;
    dots[i].entry = static_cast<std::uint16_t>(100 + i);
    dots[i].culled = i == 1;
  }
  omma_CameraDots sample{};
  sample.frame = 7;
  sample.time_ns = -5;
  sample.sample_number = 42;
  sample.valid = true;
  sample.camera = 2;
  sample.dots = {3, 3, dots.data(), false};
  return sample;
}

std::vector<std::byte> copy(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

TEST(Cdr, GivesBackWhatWasWritten) {
  std::vector<omma_Dot> dots;
  const omma_CameraDots sample = three_dots(dots);
  CdrWriter writer;
  const std::vector<std::byte> bytes = copy(writer.write(TopicId::kDots, &sample));
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(bytes.size() % 4, 0U);
  CdrReader reader(TopicId::kDots);
  const auto* back = reader.read_as<omma_CameraDots>(bytes);
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->frame, 7U);
  EXPECT_EQ(back->time_ns, -5);
  EXPECT_EQ(back->camera, 2);
  ASSERT_EQ(back->dots._length, 3U);
  EXPECT_EQ(back->dots._buffer[2].u_px, 12.25F);
  EXPECT_EQ(back->dots._buffer[2].entry, 102);
  EXPECT_TRUE(back->dots._buffer[1].culled);
  EXPECT_EQ(reader.read_as<omma_Attitude>(bytes), nullptr);
}

TEST(Cdr, HeadOfEveryTopicIsAtTheSamePlace) {
  CdrWriter writer;
  for (const Topic& entry : topics()) {
    std::vector<std::uint64_t> memory(entry.descriptor->m_size / 8 + 1, 0);
    // frame, time_ns, sample_number and valid lead every struct, so any of them can be filled as one of them.
    auto* sample = reinterpret_cast<omma_Health*>(memory.data());
    sample->frame = 0x0102030405060708ULL;
    sample->time_ns = -77;
    sample->sample_number = 9;
    sample->valid = true;
    SampleHead head;
    ASSERT_TRUE(read_head(writer.write(entry.id, memory.data()), head)) << entry.name;
    EXPECT_EQ(head.frame, 0x0102030405060708ULL) << entry.name;
    EXPECT_EQ(head.time_ns, -77) << entry.name;
    EXPECT_EQ(head.sample_number, 9U) << entry.name;
    EXPECT_TRUE(head.valid) << entry.name;
  }
}

TEST(Cdr, TruncatedBytesAreNoSample) {
  std::vector<omma_Dot> dots;
  const omma_CameraDots sample = three_dots(dots);
  CdrWriter writer;
  const std::vector<std::byte> bytes = copy(writer.write(TopicId::kDots, &sample));
  CdrReader reader(TopicId::kDots);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(reader.read(std::span(bytes).first(size)), nullptr) << size;
  }
}

TEST(Cdr, EveryAlteredByteIsRefusedOrReadWithinBounds) {
  std::vector<omma_Dot> dots;
  const omma_CameraDots sample = three_dots(dots);
  CdrWriter writer;
  const std::vector<std::byte> bytes = copy(writer.write(TopicId::kDots, &sample));
  CdrReader reader(TopicId::kDots);
  int refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int value : {0, 1, 0x7f, 0xff}) {
      std::vector<std::byte> altered = bytes;
      altered[i] = static_cast<std::byte>(value);
      const auto* back = reader.read_as<omma_CameraDots>(altered);
      if (back == nullptr) {
        ++refused;
      } else {
        EXPECT_LE(back->dots._length, limits::kDotsPerCamera);
      }
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Cdr, MoreThanTheBoundIsNotWritten) {
  std::vector<omma_Dot> dots(limits::kDotsPerCamera + 1, omma_Dot{});
  omma_CameraDots sample{};
  sample.dots = {static_cast<std::uint32_t>(dots.size()), static_cast<std::uint32_t>(dots.size()),
                 dots.data(), false};
  CdrWriter writer;
  EXPECT_TRUE(writer.write(TopicId::kDots, &sample).empty());
}

TEST(Topics, AreFoundByShortAndWholeName) {
  EXPECT_EQ(find_topic("attitude"), TopicId::kAttitude);
  EXPECT_EQ(find_topic(topic_name("demo", TopicId::kImageChunk)), TopicId::kImageChunk);
  EXPECT_EQ(topic_name("demo", TopicId::kAttitude), "omma/demo/attitude");
  EXPECT_FALSE(find_topic("altitude"));
  for (std::size_t i = 0; i < kTopicCount; ++i) EXPECT_EQ(static_cast<std::size_t>(topics()[i].id), i);
}

}  // namespace
}  // namespace omma::telemetry
