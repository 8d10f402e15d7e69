// Telemetry over DDS on this machine alone, without multicast: published here, heard by the ground programs
// in processes of their own.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "components/telemetry/cdr.hpp"
#include "components/telemetry/dds_sink.hpp"
#include "components/telemetry/samples.hpp"
#include "ground/dds/subscriber.hpp"
#include "ground/recording.hpp"
#include "tests/ground/loopback_dds.hpp"
#include "tests/ground/run_program.hpp"
#include "tests/ground/sample_recording.hpp"

namespace omma::ground {
namespace {

using namespace std::chrono_literals;
using telemetry::TopicId;

constexpr auto kPatience = 20s;  // discovery takes well under a second on an idle machine

/// Valid, whichever is the newest when the monitor looks.
omma_Attitude valid_attitude(int i) {
  omma_Attitude attitude = test::attitude_sample(i);
  attitude.valid = true;
  return attitude;
}

/// Publishes a frame set every 20 ms, and one event at the start, until it is destroyed.
class Publisher {
 public:
  explicit Publisher(int domain) : sink_("testsat", domain), thread_([this] { publish(); }) {}
  ~Publisher() {
    ending_ = true;
    thread_.join();
    sink_.close();
    EXPECT_EQ(sink_.lost(), 0U) << sink_.failure();
  }

 private:
  void publish() {
    omma_Event event{};
    event.sample_number = 1;
    event.valid = true;
    event.severity = omma_EVENT_ACTIVITY;
    telemetry::set_text(event.name, "began");
    telemetry::set_text(event.text, "the test began");
    sink_.write(TopicId::kEvent, &event, {});
    omma_Dot dots[3];
    for (int i = 0; !ending_; ++i) {
      omma_FrameSet frame_set{};
      frame_set.frame = static_cast<std::uint64_t>(i);
      frame_set.sample_number = static_cast<std::uint32_t>(i + 1);
      frame_set.valid = true;
      sink_.write(TopicId::kFrameSet, &frame_set, {});
      const omma_CameraDots seen = test::dots_sample(i, dots, 3);
      sink_.write(TopicId::kDots, &seen, {});
      const omma_Attitude attitude = valid_attitude(i);
      sink_.write(TopicId::kAttitude, &attitude, {});
      std::this_thread::sleep_for(20ms);
    }
  }

  telemetry::DdsSink sink_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

class LiveTelemetry : public testing::Test {
 protected:
  static void SetUpTestSuite() { test::use_loopback_dds(); }
  /// A domain of this process's own: several tests may run at once. Their ports lie below 32768, where the
  /// system takes those it hands out itself.
  static int domain() { return 1 + static_cast<int>(getpid() % 90); }

  static std::string in_domain() { return " --domain " + std::to_string(domain()); }
};

TEST_F(LiveTelemetry, SubscriberFindsTheSpacecraftAndGetsTheBytesTheLogWouldHave) {
  const Publisher publisher(domain());
  Subscriber subscriber(domain(), "");
  telemetry::CdrWriter cdr;
  telemetry::CdrReader event_reader(TopicId::kEvent);
  int attitudes = 0;
  int events = 0;
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while ((attitudes < 10 || events < 1) && std::chrono::steady_clock::now() < give_up) {
    subscriber.poll([&](TopicId id, std::span<const std::byte> bytes) {
      telemetry::SampleHead head;
      ASSERT_TRUE(telemetry::read_head(bytes, head));
      if (id == TopicId::kAttitude) {
        const omma_Attitude truth = valid_attitude(static_cast<int>(head.frame));
        const std::span<const std::byte> logged = cdr.write(id, &truth);
        EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), logged.begin(), logged.end()));
        ++attitudes;
      }
      if (id == TopicId::kEvent) {
        const auto* event = event_reader.read_as<omma_Event>(bytes);
        ASSERT_NE(event, nullptr);
        EXPECT_STREQ(event->text, "the test began") << "sent before the subscriber was there";
        ++events;
      }
    });
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_EQ(subscriber.spacecraft(), "testsat");
  EXPECT_GE(attitudes, 10);
  EXPECT_EQ(events, 1);
}

TEST_F(LiveTelemetry, MonitorPrintsATable) {
  const Publisher publisher(domain());
  const test::ProgramRun run = test::run_omma("monitor --once --wait 20" + in_domain());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("testsat"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("ATTITUDE"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("z +0.6000000  w +0.8000000"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("the test began"), std::string::npos) << run.output;
}

TEST_F(LiveTelemetry, RecordWritesWhatItHeard) {
  const std::string path = testing::TempDir() + "omma_live_" + std::to_string(getpid()) + ".mcap";
  {
    const Publisher publisher(domain());
    const test::ProgramRun run = test::run_omma("record " + path + " --seconds 2" + in_domain());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_NE(run.output.find("spacecraft testsat"), std::string::npos) << run.output;
  }
  Recording recording(path);
  EXPECT_EQ(recording.spacecraft(), "testsat");
  EXPECT_EQ(recording.damage(), "");
  int attitudes = 0;
  recording.for_each<omma_Attitude>([&](const omma_Attitude& sample) {
    EXPECT_EQ(sample.chi2, test::attitude_sample(static_cast<int>(sample.frame)).chi2);
    ++attitudes;
  });
  EXPECT_GT(attitudes, 5);
  int dots = 0;
  recording.for_each<omma_CameraDots>([&](const omma_CameraDots& sample) {
    EXPECT_EQ(sample.dots._length, 3U);
    ++dots;
  });
  EXPECT_GT(dots, 5);
  std::filesystem::remove(path);
  std::filesystem::remove(telemetry::timing_path(path));
}

TEST_F(LiveTelemetry, SilenceIsSaidAndNoFileIsLeft) {
  const std::string path = testing::TempDir() + "omma_silence_" + std::to_string(getpid()) + ".mcap";
  const test::ProgramRun record = test::run_omma("record " + path + " --seconds 0.3" + in_domain());
  EXPECT_EQ(record.exit_code, 1);
  EXPECT_NE(record.output.find("nothing was heard"), std::string::npos) << record.output;
  EXPECT_FALSE(std::filesystem::exists(path));
  const test::ProgramRun monitor = test::run_omma("monitor --once --wait 0.3" + in_domain());
  EXPECT_EQ(monitor.exit_code, 1);
  EXPECT_NE(monitor.output.find("nothing was heard"), std::string::npos) << monitor.output;
}

TEST_F(LiveTelemetry, DdsThatIsNotToBeHadIsASentence) {
  const std::string good = std::getenv("CYCLONEDDS_URI");
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"nosuch0\"/></Interfaces>"
         "</General></Domain></CycloneDDS>",
         1);
  try {
    // A domain nobody else has: one that this process already has open would be shared.
    const telemetry::DdsSink sink("testsat", 100 + domain());
    ADD_FAILURE() << "there is no such interface";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("DDS: cannot create a participant"), std::string::npos);
  }
  const test::ProgramRun run = test::run_omma("monitor --once" + in_domain());
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_NE(run.output.find("DDS: cannot create a participant"), std::string::npos) << run.output;
  setenv("CYCLONEDDS_URI", good.c_str(), 1);
}

TEST_F(LiveTelemetry, WrongArgumentsAreRefused) {
  EXPECT_EQ(test::run_omma("record /no/such/folder/a.mcap --spacecraft testsat --seconds 0.1" + in_domain())
                .exit_code,
            2);
  EXPECT_EQ(test::run_omma("monitor --once --domain 900").exit_code, 2);
  EXPECT_EQ(test::run_omma("record").exit_code, 2);
}

}  // namespace
}  // namespace omma::ground
