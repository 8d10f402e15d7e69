// The flight recorder: what a run leaves in it, how it reads as a trace, and when it is written.
#include "fsw/services/flight_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/schedule_events.hpp"
#include "fsw/services/trace_dump.hpp"
#include "fsw/services/trace_text.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::FakeClock;
using testing::Scripted;

/// Two components at 1 kHz, nine beats; in beat 3 the first takes 2.5 ms, so that two beats are missed.
struct SlippingRun {
  FakeClock clock{1'000'000'000};
  Events events;
  Scripted first{"first", [this](const Tick& tick) { clock.spend(tick.number == 3 ? 2'500'000 : 100'000); }};
  Scripted second{"second", [this](const Tick&) { clock.spend(50'000); }};
  RateGroupTable table{.base_period = 1ms,
                       .groups = {{.name = "fast", .components = {{first, 1ms}, {second}}}}};
  ScheduleEvents schedule_events{events};
  FlightRecorder recorder{table, false};
  ScheduleObservers observers{&schedule_events, &recorder};

  SlippingRun() {
    Scheduler scheduler(table, clock, observers);
    scheduler.run(9);
  }
};

json parsed(const SlippingRun& run) {
  return json::parse(trace_text(run.recorder, run.events, kScheduleEvents).json);
}

/// Those of a phase ("X": spans, "i": marks, "C": counters, "M": names) with this name.
std::vector<json> drawn(const json& trace, const std::string& phase, const std::string& name) {
  std::vector<json> found;
  for (const json& part : trace.at("traceEvents"))
    if (part.at("ph") == phase && part.at("name") == name) found.push_back(part);
  return found;
}

TEST(FlightRecorder, DrawsEachStepFromBeginToEnd) {
  const SlippingRun run;
  const json trace = parsed(run);
  const std::vector<json> first = drawn(trace, "X", "first");
  ASSERT_EQ(first.size(), 7U);  // beats 0 to 3, 6, 7, 8
  EXPECT_EQ(drawn(trace, "X", "second").size(), 7U);
  EXPECT_EQ(first[3].at("args").at("tick"), 3);
  EXPECT_DOUBLE_EQ(first[3].at("dur").get<double>(), 2500);
  // The scheduler's clock stands at one second, and starts its threads two milliseconds later.
  EXPECT_DOUBLE_EQ(first[3].at("ts").get<double>(), 1'005'000);
  const std::vector<json> lateness = drawn(trace, "C", "lateness of fast [us]");
  ASSERT_EQ(lateness.size(), 7U);
  EXPECT_DOUBLE_EQ(lateness[4].at("args").at("us").get<double>(), 0);  // on the grid again
}

TEST(FlightRecorder, DrawsTheJobsOfEveryWorkerOnATrackOfItsOwn) {
  Scripted idle{"idle", [](const Tick&) {}};
  const RateGroupTable table{.base_period = 1ms, .groups = {{.name = "g", .components = {{idle}}}}};
  FlightRecorder recorder(table, false, 3);
  WorkerPool pool(3);
  pool.observe(recorder);
  for (int batch = 0; batch < 10; ++batch) pool.run(4, [](int) {});
  const Events events;
  const json trace = json::parse(trace_text(recorder, events, kScheduleEvents).json);
  std::map<int, std::string> tracks;
  for (const json& name : drawn(trace, "M", "thread_name"))
    tracks[name.at("tid")] = name.at("args").at("name");
  std::map<int, int> times;  // each job was done
  for (const json& job : drawn(trace, "X", "job")) {
    ++times[job.at("args").at("job")];
    EXPECT_THAT(tracks.at(job.at("tid")), ::testing::StartsWith("jobs of "));
    EXPECT_GE(job.at("dur").get<double>(), 0);
  }
  EXPECT_EQ(times, (std::map<int, int>{{0, 10}, {1, 10}, {2, 10}, {3, 10}}));
}

TEST(FlightRecorder, MarksSlipsBreachesAndEvents) {
  const SlippingRun run;
  EXPECT_EQ(run.recorder.slips(), 1U);
  const json trace = parsed(run);
  const std::vector<json> missed = drawn(trace, "i", "missed beats");
  ASSERT_EQ(missed.size(), 1U);
  EXPECT_EQ(missed[0].at("args").at("count"), 2);
  EXPECT_EQ(missed[0].at("args").at("tick"), 4);
  const std::vector<json> breach = drawn(trace, "i", "over budget: first");
  ASSERT_EQ(breach.size(), 1U);
  EXPECT_DOUBLE_EQ(breach[0].at("args").at("budget_us").get<double>(), 1000);
  const std::vector<json> event = drawn(trace, "i", "beats_missed");
  ASSERT_EQ(event.size(), 1U);
  EXPECT_EQ(event[0].at("args").at("text"), "rate group 0 missed 2 beats, the first due at tick 4");
}

// The Trace Event Format: what Perfetto's importer asks of each part.
TEST(FlightRecorder, TraceIsWellFormed) {
  const SlippingRun run;
  const json trace = parsed(run);
  std::map<int, double> end_of_track;
  for (const json& part : trace.at("traceEvents")) {
    const std::string phase = part.at("ph");
    ASSERT_THAT((std::array{"X", "i", "C", "M"}), ::testing::Contains(phase));
    ASSERT_TRUE(part.at("name").is_string() && part.at("pid").is_number_integer() &&
                part.at("args").is_object());
    if (phase == "M") continue;
    ASSERT_TRUE(part.at("ts").is_number());
    if (phase == "i") {
      EXPECT_EQ(part.at("s"), "t");
    }
    if (phase != "X") continue;
    const int track = part.at("tid");
    const double start = part.at("ts");
    EXPECT_GE(start, end_of_track[track]) << "spans of one track overlap";
    end_of_track[track] = start + part.at("dur").get<double>();
  }
  ASSERT_EQ(drawn(trace, "M", "thread_name").size(), 2U);
  EXPECT_EQ(drawn(trace, "M", "thread_name")[1].at("args").at("name"), "fast");
}

TEST(FlightRecorder, KeepsTheNewestWhenItIsFull) {
  FakeClock clock;
  Scripted work("work", [&](const Tick&) { clock.spend(1000); });
  const RateGroupTable table{.base_period = 1ms, .groups = {{.name = "g", .components = {{work}}}}};
  FlightRecorder recorder(table, false, 0, 8);
  Scheduler scheduler(table, clock, recorder);
  scheduler.run(100);
  const json trace = json::parse(trace_text(recorder, Events(), {}).json);
  const std::vector<json> steps = drawn(trace, "X", "work");
  ASSERT_EQ(steps.size(), 4U);  // two records a beat
  EXPECT_EQ(steps.back().at("args").at("tick"), 99);
}

class TraceDumpTest : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                       ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::filesystem::path file = folder / "trace.json";
};

TEST_F(TraceDumpTest, IsWrittenWhenAskedForAndNotBefore) {
  SlippingRun run;
  TraceDump dump(file, SlipDumps::kNone, run.recorder, run.events, kScheduleEvents);
  dump.serve(0);
  EXPECT_FALSE(std::filesystem::exists(file));
  dump.request();
  dump.serve(0);
  dump.serve(0);
  EXPECT_EQ(dump.written(), 1U);
  std::ifstream in(file);
  EXPECT_FALSE(json::parse(in).at("traceEvents").empty());
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_F(TraceDumpTest, IsWrittenAWhileAfterASlip) {
  SlippingRun run;
  TraceDump dump(file, SlipDumps::kWritten, run.recorder, run.events, kScheduleEvents);
  dump.serve(0);
  dump.serve(TraceDump::kAfterSlip - 1);
  EXPECT_EQ(dump.written(), 0U);
  dump.serve(TraceDump::kAfterSlip);
  EXPECT_TRUE(std::filesystem::exists(folder / "trace.slip-1.json"));
  // The next slip comes too soon to have a file of its own; the one after has.
  run.recorder.missed(0, {}, 1);
  dump.serve(TraceDump::kAfterSlip + 1);
  dump.serve(TraceDump::kBetweenSlips);
  EXPECT_EQ(dump.written(), 1U);
  run.recorder.missed(0, {}, 1);
  dump.serve(3 * TraceDump::kBetweenSlips);
  dump.serve(3 * TraceDump::kBetweenSlips + TraceDump::kAfterSlip);
  EXPECT_TRUE(std::filesystem::exists(folder / "trace.slip-2.json"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(TraceDumpTest, FailureIsASentenceAndAnEvent) {
  SlippingRun run;
  EventRecord record;
  while (run.events.take(record)) {
  }
  TraceDump dump("/nowhere/trace.json", SlipDumps::kNone, run.recorder, run.events, kScheduleEvents);
  dump.request();
  dump.serve(0);
  EXPECT_EQ(dump.failure(), "no trace in /nowhere/trace.json: No such file or directory.");
  EXPECT_EQ(dump.write(), dump.failure());
  ASSERT_TRUE(run.events.take(record));
  EXPECT_EQ(record.id, kTraceNotWritten.id);
}

}  // namespace
}  // namespace omma
