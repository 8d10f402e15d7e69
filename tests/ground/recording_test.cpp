// Recordings: written, read back, cut off, damaged.
#include "ground/recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "fsw/kernel/input_error.hpp"
#include "tests/ground/sample_recording.hpp"

namespace omma::ground {
namespace {

std::string path_for(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("omma_recording_test_" + name)).string();
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<long>(bytes.size()));
}

// Small chunks: several of them in a small file.
const mcap::WriterOptions kSmallChunks{.chunk_bytes = 600};

class RecordingTest : public testing::Test {
 protected:
  ~RecordingTest() override {
    std::filesystem::remove(path_);
    std::filesystem::remove(damaged_);
  }
  const std::string name_ = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string path_ = path_for(name_ + ".mcap");
  const std::string damaged_ = path_for(name_ + ".damaged.mcap");
};

int count_attitudes(Recording& recording) {
  int count = 0;
  recording.for_each<omma_Attitude>([&](const omma_Attitude& sample) {
    const omma_Attitude truth = test::attitude_sample(static_cast<int>(sample.frame));
    EXPECT_EQ(sample.time_ns, truth.time_ns);
    EXPECT_EQ(sample.chi2, truth.chi2);
    ++count;
  });
  return count;
}

TEST_F(RecordingTest, GivesBackEverySampleInOrder) {
  test::write_recording(path_, 20, kSmallChunks);
  Recording recording(path_);
  EXPECT_EQ(recording.spacecraft(), "testsat");
  const std::vector<omma_Attitude> attitudes = recording.all<omma_Attitude>();
  ASSERT_EQ(attitudes.size(), 20U);
  for (int i = 0; i < 20; ++i) {
    const omma_Attitude truth = test::attitude_sample(i);
    const omma_Attitude& sample = attitudes[static_cast<std::size_t>(i)];
    EXPECT_EQ(sample.frame, truth.frame);
    EXPECT_EQ(sample.valid, truth.valid);
    EXPECT_EQ(sample.state, truth.state);
    EXPECT_EQ(sample.rig_from_j2000.w, 0.8);
    EXPECT_EQ(sample.covariance_rad2[8], truth.covariance_rad2[8]);
    EXPECT_EQ(sample.stars_used, truth.stars_used);
  }
  int frames = 0;
  recording.for_each<omma_CameraDots>([&](const omma_CameraDots& sample) {
    ASSERT_EQ(sample.dots._length, 3U);
    EXPECT_EQ(sample.dots._buffer[2].u_px, 31.5F);
    EXPECT_EQ(sample.dots._buffer[2].entry, 1002);
    ++frames;
  });
  EXPECT_EQ(frames, 20);
  EXPECT_EQ(recording.damage(), "");
  EXPECT_EQ(recording.undecodable(), 0U);
}

TEST_F(RecordingTest, SameSamplesGiveTheSameBytes) {
  test::write_recording(path_, 20, kSmallChunks);
  test::write_recording(damaged_, 20, kSmallChunks);
  EXPECT_EQ(bytes_of(path_), bytes_of(damaged_));
}

TEST_F(RecordingTest, WithoutCompressionGivesTheSameSamples) {
  mcap::WriterOptions options = kSmallChunks;
  options.compression_level = 0;
  test::write_recording(path_, 7, options);
  Recording recording(path_);
  EXPECT_EQ(count_attitudes(recording), 7);
  EXPECT_EQ(recording.damage(), "");
}

TEST_F(RecordingTest, WithoutSamplesIsAWholeFile) {
  test::write_recording(path_, 0);
  Recording recording(path_);
  EXPECT_EQ(count_attitudes(recording), 0);
  EXPECT_EQ(recording.damage(), "");
}

TEST_F(RecordingTest, ProgramThatDiesLosesOnlyTheOpenChunk) {
  telemetry::RecordingWriter writer(path_, "testsat", false, kSmallChunks);
  telemetry::CdrWriter cdr;
  for (int i = 0; i < 20; ++i) {
    const omma_Attitude sample = test::attitude_sample(i);
    writer.write(telemetry::TopicId::kAttitude, cdr.write(telemetry::TopicId::kAttitude, &sample));
  }
  // The writer is not closed: the file is what a dead program leaves.
  write_bytes(damaged_, bytes_of(path_));
  Recording recording(damaged_);
  const int kept = count_attitudes(recording);
  EXPECT_EQ(static_cast<std::uint64_t>(kept), writer.samples_written());
  EXPECT_GE(kept, 16);
  EXPECT_NE(recording.damage().find("cut off"), std::string::npos) << recording.damage();
}

TEST_F(RecordingTest, CutOffAnywhereGivesItsCompleteChunksAndOneSentence) {
  test::write_recording(path_, 8, kSmallChunks);
  int most = 8;
  for (std::size_t size = std::filesystem::file_size(path_) - 1; size >= 8;
       size -= size % 3000 < 40 ? 1 : 40) {
    std::filesystem::resize_file(path_, size);
    Recording recording(path_);
    const int kept = count_attitudes(recording);
    EXPECT_LE(kept, most) << "shorter files hold less, at " << size;
    most = kept;
    EXPECT_FALSE(recording.damage().empty()) << size;
    EXPECT_EQ(recording.damage().find('\n'), std::string::npos);
  }
  EXPECT_EQ(most, 0);
}

/// A small file of 12 messages whose bytes are their number, in several chunks.
void write_small(const std::string& path) {
  mcap::Writer writer(path, {.chunk_bytes = 100});
  const std::uint16_t channel =
      writer.add_channel(writer.add_schema("S", "omgidl", "struct S {};"), "topic", "cdr");
  for (int i = 0; i < 12; ++i) {
    const std::vector<std::byte> data(16, static_cast<std::byte>(i));
    writer.write(channel, static_cast<std::uint32_t>(i), 10 * i, 10 * i, data);
  }
}

/// Messages read; each must be one of those written.
int count_sound_messages(mcap::Reader& reader) {
  int count = 0;
  reader.for_each_message([](const mcap::Channel&) { return true; },
                          [&](const mcap::MessageView& message) {
                            EXPECT_LT(message.sequence, 12U);
                            EXPECT_EQ(message.log_time_ns, 10 * static_cast<std::int64_t>(message.sequence));
                            EXPECT_EQ(message.data.size(), 16U);
                            for (const std::byte byte : message.data)
                              EXPECT_EQ(std::to_integer<std::uint32_t>(byte), message.sequence);
                            ++count;
                            return true;
                          });
  return count;
}

TEST_F(RecordingTest, CutOffAtEveryByteIsReadUpToThereOrRefusedInASentence) {
  write_small(path_);
  for (std::size_t size = std::filesystem::file_size(path_) - 1; size > 0; --size) {
    std::filesystem::resize_file(path_, size);
    if (size < 8) {
      EXPECT_THROW(mcap::Reader{path_}, InputError) << size;
      continue;
    }
    mcap::Reader reader(path_);
    count_sound_messages(reader);
    EXPECT_FALSE(reader.damage().empty()) << size;
  }
}

TEST_F(RecordingTest, EveryDamagedByteIsSurvivedAndNoMessageIsMadeUp) {
  write_small(path_);
  const std::string whole = bytes_of(path_);
  int sentences = 0;
  int complete = 0;
  std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int change : {0x01, 0x5a, 0xff}) {
      file.seekp(static_cast<long>(i)).put(static_cast<char>(whole[i] ^ change)).flush();
      try {
        mcap::Reader reader(path_);
        const int count = count_sound_messages(reader);
        complete += count == 12 ? 1 : 0;
        EXPECT_TRUE(count == 12 || !reader.damage().empty()) << "byte " << i << ": " << count << " messages";
        sentences += reader.damage().empty() ? 0 : 1;
        EXPECT_EQ(reader.damage().find('\n'), std::string::npos);
      } catch (const InputError& error) {
        ++sentences;
        EXPECT_LT(i, 8U) << error.what();
      }
    }
    file.seekp(static_cast<long>(i)).put(whole[i]).flush();
  }
  EXPECT_GT(sentences, 1000);
  EXPECT_GT(complete, 1000);
}

TEST_F(RecordingTest, SomethingElseIsRefusedInASentence) {
  EXPECT_THROW(Recording{path_for("does_not_exist")}, InputError);
  EXPECT_THROW(Recording{std::filesystem::temp_directory_path().string()}, InputError);
  write_bytes(damaged_, "");
  EXPECT_THROW(Recording{damaged_}, InputError);
  write_bytes(damaged_, "PK\x03\x04 this is another kind of file");
  try {
    const Recording recording(damaged_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              damaged_ + ": recording: expected an MCAP file, found other first bytes");
  }
}

TEST_F(RecordingTest, OfAnotherVersionOfTheTopicIsRefusedInASentence) {
  {
    mcap::Writer writer(path_);
    std::string text(telemetry::idl_text());
    text.replace(text.find("double chi2;"), 12, "float chi2;");
    const std::uint16_t schema = writer.add_schema("omma::Attitude", "omgidl", text);
    const std::uint16_t channel = writer.add_channel(schema, "omma/testsat/attitude", "cdr");
    telemetry::CdrWriter cdr;
    const omma_Attitude sample = test::attitude_sample(1);
    writer.write(channel, 1, 0, 0, cdr.write(telemetry::TopicId::kAttitude, &sample));
  }
  Recording recording(path_);
  EXPECT_THROW(recording.all<omma_Attitude>(), InputError);
}

TEST_F(RecordingTest, OfAnIdlThatOnlyReadsDifferentlyIsTaken) {
  {
    mcap::Writer writer(path_);
    const std::string text = "// another comment\n" + std::string(telemetry::idl_text());
    const std::uint16_t schema = writer.add_schema("omma::Attitude", "omgidl", text);
    const std::uint16_t channel = writer.add_channel(schema, "omma/testsat/attitude", "cdr");
    telemetry::CdrWriter cdr;
    const omma_Attitude sample = test::attitude_sample(1);
    writer.write(channel, 1, 0, 0, cdr.write(telemetry::TopicId::kAttitude, &sample));
  }
  Recording recording(path_);
  EXPECT_EQ(recording.all<omma_Attitude>().size(), 1U);
}

TEST_F(RecordingTest, FullDiskIsCountedAndDoesNotThrow) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  mcap::Writer writer("/dev/full", {.chunk_bytes = 100});
  const std::uint16_t channel = writer.add_channel(writer.add_schema("a", "omgidl", ""), "t", "cdr");
  const std::vector<std::byte> data(64);
  for (int i = 0; i < 10; ++i) writer.write(channel, 0, i, i, data);
  EXPECT_NE(writer.failure().find("No space left"), std::string::npos) << writer.failure();
  EXPECT_EQ(writer.messages_written(), 0U);
  writer.close();
  EXPECT_EQ(writer.messages_lost(), 10U);
  EXPECT_THROW(mcap::Writer("/no/such/folder/a.mcap"), InputError);
}

}  // namespace
}  // namespace omma::ground
