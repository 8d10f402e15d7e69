// From the components' messages through the telemetry component and its thread into a recording.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <latch>
#include <memory>
#include <thread>

#include "components/telemetry/log_sink.hpp"
#include "components/telemetry/telemetry_output.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "ground/recording.hpp"
#include "tests/components/telemetry/telemetry_source.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using telemetry::LogSink;
using telemetry::ReportQueue;

constexpr EventDescriptor kTested{.id = 77,
                                  .severity = EventSeverity::kActivity,
                                  .name = "tested",
                                  .text = "frame {0} was tested",
                                  .values = {{{"frame"}}},
                                  .burst = 1000};

telemetry::TelemetryNames names() {
  telemetry::TelemetryNames result;
  for (const char* name : {"cam0", "cam1", "cam2"}) result.cameras.push_back(Name(name));
  result.bodies.push_back(Name("card"));
  return result;
}

/// All messages of a frame set, made from its number alone, as their components would write them.
class VisionChain final : public TelemetrySource {
 public:
  Events events;

  std::string_view name() const override { return "vision_chain"; }
  void step(const Tick& tick) noexcept override {
    const std::uint64_t n = tick.number;
    const TimeNs time = tick.time_ns;
    frames->cameras.resize(3);
    dots->frame = n;
    dots->time_ns = time;
    dots->cameras.resize(3);
    pairings->sky.pairs.clear();
    for (std::uint8_t c = 0; c < 3; ++c) {
      frames->cameras[c].status = FrameStatus::kFresh;
      DotList& list = dots->cameras[c];
      list.status = FrameStatus::kFresh;
      list.time_ns = time;
      list.dots.resize(c == 2 ? limits::kDotsPerCamera : 10 + n % 7);
      for (std::size_t i = 0; i < list.dots.size(); ++i)
        list.dots[i].pixel = {static_cast<double>(i), static_cast<double>(n)};
      Pairing pair;
      pair.camera = c;
      pair.dot = static_cast<std::uint16_t>(n % 10);
      pair.entry = 1000;
      pairings->sky.pairs.push_back(pair);
    }
    attitude->frame = n;
    attitude->time_ns = time;
    attitude->valid = true;
    attitude->solution.chi2 = static_cast<double>(n);
    poses->bodies.resize(1);
    poses->bodies[0].frame = n;
    poses->bodies[0].time_ns = time;
    poses->bodies[0].valid = poses->bodies[0].position_valid = n % 2 == 0;
    image->valid = n % 3 == 0;
    image->frame = n;
    image->width = 64;
    image->rows = 4;
    image->bytes = 256;
    image->pixels[255] = static_cast<std::uint8_t>(n);
    if (n % 10 == 0) {
      health->time_ns = time;
      health->valid = true;
      timing->valid = true;
      timing->time_ns = time;
      timing->steps.resize(1);
      timing->steps[0].name = "vision_chain";
      timing->steps[0].max_ns = std::chrono::steady_clock::now().time_since_epoch().count();  // never twice
    }
    events.raise<kTested>(tick, n);
  }
};

/// The chain with its telemetry.
struct Flight {
  VisionChain chain;
  Telemetry telemetry{names(), chain.events};
  TelemetryOutput output{telemetry, {kTested}};

  Flight() { chain.feed(telemetry); }
  void step(std::uint64_t frame) {
    const Tick tick{frame, static_cast<TimeNs>(frame) * 100'000'000};
    chain.step(tick);
    telemetry.step(tick);
  }
};

/// Takes its time with some of the samples, as a disk does.
class SlowSink final : public telemetry::Sink {
 public:
  explicit SlowSink(int every) : every_(every) {}
  void write(telemetry::TopicId, const void*, std::span<const std::byte>) override {
    if (++count_ % every_ == 0) std::this_thread::sleep_for(2ms);
  }
  std::uint64_t lost() const override { return 0; }
  std::string failure() const override { return {}; }

 private:
  int every_;
  int count_ = 0;
};

/// Does not return from writing until it is let go.
class BlockedSink final : public telemetry::Sink {
 public:
  explicit BlockedSink(std::latch& gate) : gate_(gate) {}
  void write(telemetry::TopicId, const void*, std::span<const std::byte>) override {
    blocked.store(true);
    gate_.wait();
    ++written;
  }
  std::uint64_t lost() const override { return 0; }
  std::string failure() const override { return {}; }
  std::atomic<bool> blocked{false};
  int written = 0;

 private:
  std::latch& gate_;
};

class TelemetryTest : public ::testing::Test {
 protected:
  ~TelemetryTest() override {
    for (const std::string& path : {path_, second_}) {
      std::filesystem::remove(path);
      std::filesystem::remove(telemetry::timing_path(path));
    }
  }
  static std::string file(const std::string& suffix) {
    return (std::filesystem::path(::testing::TempDir()) /
            ("omma_telemetry_" +
             std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + suffix))
        .string();
  }
  const std::string path_ = file(".mcap");
  const std::string second_ = file("_2.mcap");
};

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Runs the scheduler in lockstep for so many frame sets with a sink that is now and then slow.
void replay(const std::string& path, std::uint64_t frames, int slow_every) {
  const auto flight = std::make_unique<Flight>();
  flight->output.add(std::make_unique<LogSink>(path, "testsat", true));
  flight->output.add(std::make_unique<SlowSink>(slow_every));
  LockstepClock clock;
  clock.before_each_tick([&] { flight->output.wait_for_room(); });
  const RateGroupTable table{
      .base_period = 100ms,
      .groups = {{.name = "vision", .components = {{flight->chain}, {flight->telemetry}}}}};
  Scheduler scheduler(table, clock);
  flight->output.start();
  scheduler.run(frames);
  flight->output.stop();
  EXPECT_EQ(flight->telemetry.reports().dropped(), 0U);
  EXPECT_TRUE(flight->output.failures().empty());
}

TEST_F(TelemetryTest, EverySampleOfALockstepRunIsInTheLogInOrder) {
  constexpr std::uint64_t kFrames = 3 * ReportQueue::kReports;
  replay(path_, kFrames, 50);
  ground::Recording recording(path_);
  EXPECT_EQ(recording.spacecraft(), "testsat");
  std::uint64_t next = 0;
  recording.for_each<omma_Attitude>([&](const omma_Attitude& sample) {
    EXPECT_EQ(sample.frame, next++);
    EXPECT_EQ(sample.sample_number, next);
    EXPECT_EQ(sample.chi2, static_cast<double>(sample.frame));
  });
  EXPECT_EQ(next, kFrames);
  std::uint64_t dots = 0;
  recording.for_each<omma_CameraDots>([&](const omma_CameraDots& sample) {
    EXPECT_EQ(sample.camera, dots % 3);
    EXPECT_EQ(sample.sample_number, dots / 3 + 1) << "counted per camera";
    EXPECT_EQ(sample.dots._length, sample.camera == 2 ? limits::kDotsPerCamera : 10 + sample.frame % 7);
    EXPECT_EQ(sample.dots._buffer[sample.frame % 10].role, omma_DOT_STAR);
    ++dots;
  });
  EXPECT_EQ(dots, 3 * kFrames);
  std::uint64_t poses = 0;
  recording.for_each<omma_RelativePose>([&](const omma_RelativePose& sample) {
    EXPECT_STREQ(sample.body_name, "card");
    EXPECT_EQ(sample.valid, sample.frame % 2 == 0);
    ++poses;
  });
  EXPECT_EQ(poses, kFrames);
  std::uint64_t chunks = 0;
  recording.for_each<omma_ImageChunk>([&](const omma_ImageChunk& sample) {
    ASSERT_EQ(sample.pixels._length, 256U);
    EXPECT_EQ(sample.pixels._buffer[255], sample.frame & 0xffU);
    EXPECT_EQ(sample.sample_number, ++chunks);
  });
  EXPECT_EQ(chunks, kFrames / 3);
  std::uint64_t events = 0;
  recording.for_each<omma_Event>([&](const omma_Event& sample) {
    EXPECT_STREQ(sample.name, "tested");
    EXPECT_EQ(std::string(sample.text), "frame " + std::to_string(events) + " was tested");
    ASSERT_EQ(sample.values._length, 1U);
    EXPECT_EQ(sample.values._buffer[0], static_cast<double>(events));
    ++events;
  });
  EXPECT_EQ(events, kFrames);
  std::uint64_t reports = 0;
  recording.for_each<omma_Health>([&](const omma_Health& sample) {
    EXPECT_EQ(sample.frame, 10 * reports++);
    EXPECT_EQ(sample.telemetry_dropped, 0U);
  });
  EXPECT_EQ(reports, (kFrames + 9) / 10) << "once a report, not once a frame set";
}

TEST_F(TelemetryTest, ReplayTwiceGivesTheSameBytesAndDurationsAreElsewhere) {
  replay(path_, 70, 30);
  replay(second_, 70, 1000000);
  EXPECT_EQ(bytes_of(path_), bytes_of(second_));
  EXPECT_NE(bytes_of(telemetry::timing_path(path_)), bytes_of(telemetry::timing_path(second_)));
  int timings = 0;
  ground::for_each<omma_Timing>(telemetry::timing_path(path_), [&](const omma_Timing& sample) {
    ASSERT_EQ(sample.steps._length, 1U);
    EXPECT_STREQ(sample.steps._buffer[0].name, "vision_chain");
    ++timings;
  });
  EXPECT_EQ(timings, 7);
}

TEST_F(TelemetryTest, FrameSetsBeyondTheQueueAreCountedAndLeaveAGap) {
  const auto flight = std::make_unique<Flight>();
  // The thread is not started yet: nothing is taken out.
  for (std::uint64_t frame = 0; frame < ReportQueue::kReports + 5; ++frame) flight->step(frame);
  EXPECT_EQ(flight->telemetry.reports().dropped(), 5U);
  flight->output.add(std::make_unique<LogSink>(path_, "testsat", false));
  flight->output.start();
  flight->output.wait_for_room();
  flight->step(40);  // a health report, which says what was lost
  flight->output.stop();
  ground::Recording recording(path_);
  const std::vector<omma_Attitude> attitudes = recording.all<omma_Attitude>();
  ASSERT_EQ(attitudes.size(), ReportQueue::kReports + 1);
  EXPECT_EQ(attitudes.back().sample_number - attitudes[attitudes.size() - 2].sample_number, 6U);
  std::uint64_t dropped = 0;
  recording.for_each<omma_Health>([&](const omma_Health& sample) { dropped = sample.telemetry_dropped; });
  EXPECT_EQ(dropped, 5U);
  int events = 0;
  recording.for_each<omma_Event>([&](const omma_Event&) { ++events; });
  EXPECT_EQ(events, ReportQueue::kReports + 6) << "events wait in their own ring";
}

// Ten seconds of flight, on a clock that stands still while a step waits: a step that waited for the sink
// would never return.
TEST_F(TelemetryTest, BlockedSinkMakesNoRealTimeGroupLate) {
  constexpr std::uint64_t kBeats = 100;
  const auto flight = std::make_unique<Flight>();
  std::latch gate(1);
  auto owned = std::make_unique<BlockedSink>(gate);
  const BlockedSink& sink = *owned;
  flight->output.add(std::move(owned));
  testing::FakeClock clock;
  Scheduler scheduler(
      {.base_period = 100ms,
       .groups = {{.name = "vision", .components = {{flight->chain, 1ms}, {flight->telemetry, 1ms}}}}},
      clock);
  flight->step(0);
  flight->output.start();
  flight->output.wait_for_room();
  while (!sink.blocked.load()) std::this_thread::yield();
  scheduler.run(kBeats);
  EXPECT_EQ(scheduler.group(0).timing().latency.count(), kBeats);
  EXPECT_EQ(scheduler.group(0).timing().missed.load(), 0U);
  EXPECT_EQ(scheduler.group(0).timing().latency.snapshot().max_ns, 0);
  EXPECT_EQ(scheduler.group(0).component_timing(1).over_budget.load(), 0U);
  EXPECT_EQ(sink.written, 0);
  EXPECT_GE(flight->telemetry.reports().dropped(), kBeats - ReportQueue::kReports);
  gate.count_down();
  flight->output.stop();
  EXPECT_GT(sink.written, 0);
}

TEST_F(TelemetryTest, EventsAfterTheLastFrameSetAreSentAtTheEnd) {
  const auto flight = std::make_unique<Flight>();
  flight->output.add(std::make_unique<LogSink>(path_, "testsat", false));
  flight->output.start();
  flight->step(0);
  for (std::uint64_t i = 1; i <= 100; ++i) flight->chain.events.raise<kTested>(Tick{i, 0}, i);
  flight->output.stop();
  int events = 0;
  ground::for_each<omma_Event>(path_, [&](const omma_Event& sample) {
    EXPECT_EQ(sample.sample_number, static_cast<std::uint32_t>(++events));
    EXPECT_EQ(sample.frame, 0U);
  });
  EXPECT_EQ(events, 101);
}

TEST_F(TelemetryTest, EventsOfTheRunBeforeAreToldFirst) {
  {
    Flight flight;
    std::vector<EarlierEvent> earlier;
    for (int n = 0; n < 20; ++n)  // more than one report holds
      earlier.push_back({{.time_ns = 5, .id = kTested.id, .value_count = 1, .values = {100.0 + n}}, 1});
    flight.telemetry.tell_earlier(std::move(earlier));
    flight.output.add(std::make_unique<LogSink>(path_, "testsat", false));
    flight.output.start();
    for (std::uint64_t frame = 0; frame < 2; ++frame) flight.step(frame);
    flight.output.stop();
  }
  ground::Recording recording(path_);
  std::vector<double> numbers;
  recording.for_each<omma_Event>([&](const omma_Event& sample) {
    EXPECT_EQ(sample.runs_ago, numbers.size() < 20 ? 1U : 0U);
    EXPECT_EQ(sample.sample_number, numbers.size() + 1);
    numbers.push_back(sample.values._buffer[0]);
  });
  ASSERT_EQ(numbers.size(), 22U);
  EXPECT_EQ(numbers[19], 119);
  EXPECT_EQ(numbers[20], 0);
}

TEST_F(TelemetryTest, EventNobodyDeclaredIsSentWithItsNumber) {
  const auto flight = std::make_unique<Flight>();
  TelemetryOutput output(flight->telemetry, {});
  output.add(std::make_unique<LogSink>(path_, "testsat", false));
  output.start();
  flight->step(0);
  output.stop();
  int events = 0;
  ground::for_each<omma_Event>(path_, [&](const omma_Event& sample) {
    EXPECT_STREQ(sample.name, "event_77");
    EXPECT_STREQ(sample.text, "");
    ++events;
  });
  EXPECT_EQ(events, 1);
}

TEST_F(TelemetryTest, StepTouchesNoMemoryManagementWhetherThereIsRoomOrNot) {
  if (!memory_guard::installed()) GTEST_SKIP() << "the guard is off under this sanitizer";
  const auto flight = std::make_unique<Flight>();
  const std::uint64_t before = memory_guard::violations().total();
  for (std::uint64_t frame = 0; frame < ReportQueue::kReports + 5; ++frame) {
    const RealTimeScope real_time;
    flight->step(frame);
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_EQ(flight->telemetry.reports().dropped(), 5U);
}

TEST_F(TelemetryTest, FullDiskIsCountedInHealthAndTheRestGoesOn) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const auto flight = std::make_unique<Flight>();
  flight->output.add(
      std::make_unique<LogSink>("/dev/full", "testsat", false, mcap::WriterOptions{.chunk_bytes = 1000}));
  flight->output.add(std::make_unique<LogSink>(path_, "testsat", false));
  flight->output.start();
  for (std::uint64_t frame = 0; frame <= 100; ++frame) {
    flight->output.wait_for_room();
    flight->step(frame);
  }
  flight->output.stop();
  ASSERT_EQ(flight->output.failures().size(), 1U);
  EXPECT_NE(flight->output.failures()[0].find("No space left"), std::string::npos);
  std::uint64_t lost = 0;
  ground::for_each<omma_Health>(path_, [&](const omma_Health& sample) { lost = sample.log_lost; });
  EXPECT_GT(lost, 0U);
}

}  // namespace
}  // namespace omma
