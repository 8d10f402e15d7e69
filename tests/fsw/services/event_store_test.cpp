// The event store: what one run leaves for the next, whatever became of the file in between.
#include "fsw/services/event_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <random>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr EventDescriptor kTold{.id = 80,
                                .severity = EventSeverity::kActivity,
                                .name = "told",
                                .text = "number {0}",
                                .values = {{{"number"}}},
                                .burst = 100'000};
constexpr std::array kDescriptors{kRunBegan, kTold};

using Bytes = std::vector<char>;

class EventStoreTest : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// One run of the program, which tells these numbers.
  void run(int first, int last, std::size_t records = 64) const {
    Events events;
    EventStore store(file, events, records);
    store.begin({});
    for (int n = first; n <= last; ++n) events.raise<kTold>(Tick{1, 1'500'000'000}, n);
    store.serve();
  }
  std::vector<StoredEvent> kept(std::size_t records = 64) const {
    Events events;
    return EventStore(file, events, records).earlier();
  }
  Bytes bytes() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const Bytes& content) const {
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }

  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("event_store_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
       std::to_string(getpid()));
  const std::filesystem::path file = folder / "events.ring";
};

TEST_F(EventStoreTest, NextRunReadsWhatTheLastOneTold) {
  run(1, 2);
  run(3, 3);
  const std::vector<StoredEvent> events = kept();
  ASSERT_EQ(events.size(), 5U);  // each run also tells that it began
  EXPECT_EQ(events[0].run, 1U);
  EXPECT_EQ(events[4].run, 2U);
  EXPECT_EQ(
      stored_events_text(events, kDescriptors),
      "run 1             0.000 s  activity   run 1 began; 0 events of earlier runs are kept, 0 records of "
      "the event store were damaged\n"
      "run 1             1.500 s  activity   number 1\n"
      "run 1             1.500 s  activity   number 2\n"
      "run 2             0.000 s  activity   run 2 began; 3 events of earlier runs are kept, 0 records of "
      "the event store were damaged\n"
      "run 2             1.500 s  activity   number 3\n");
}

TEST_F(EventStoreTest, OldestAreOverwritten) {
  run(1, 20, 8);
  const std::vector<StoredEvent> events = kept(8);
  ASSERT_EQ(events.size(), 8U);
  EXPECT_EQ(events.front().moment.record.values[0], 13);
  EXPECT_EQ(events.back().moment.record.values[0], 20);
  run(21, 21, 8);
  EXPECT_EQ(kept(8).back().run, 2U);
}

/// Power cut while the last record is written: any beginning of it may have reached the disk, in front of
/// what stood there before.
TEST_F(EventStoreTest, PowerCutAtAnyByteLosesAtMostTheRecordBeingWritten) {
  run(1, 10, 8);  // the ring is full: the record overwrites another
  const Bytes before = bytes();
  const std::vector<StoredEvent> kept_before = kept(8);
  {
    Events events;
    EventStore store(file, events, 8);
    events.raise<kTold>({}, 11);
    store.serve();
  }
  const Bytes after = bytes();
  ASSERT_EQ(before.size(), after.size());
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] == after[i]) continue;
    if (first == 0) first = i;
    last = i;
  }
  ASSERT_GT(last, first);
  ASSERT_LT(last - first, sizeof(StoredEvent)) << "only one record was written";
  for (std::size_t cut = first; cut <= last + 1; ++cut) {
    Bytes torn = before;
    std::copy_n(after.begin() + static_cast<std::ptrdiff_t>(first), cut - first,
                torn.begin() + static_cast<std::ptrdiff_t>(first));
    write(torn);
    const std::vector<StoredEvent> events = kept(8);
    // The one overwritten, and the one being written, may be gone; the other seven are there.
    ASSERT_GE(events.size(), 7U) << cut;
    for (std::size_t i = 1; i < kept_before.size(); ++i) {
      const StoredEvent& here = events[events.size() == 8 && cut == first ? i : i - 1];
      ASSERT_EQ(here.number, kept_before[i].number) << cut;
    }
    if (cut == last + 1) {
      ASSERT_EQ(events.back().moment.record.values[0], 11);
    }
  }
}

TEST_F(EventStoreTest, ChangedBytesCostOnlyTheirRecords) {
  run(1, 30);
  const Bytes sound = bytes();
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes changed = sound;
    std::uniform_int_distribution<std::size_t> place(4096, changed.size() - 1);
    changed[place(random)] ^= static_cast<char>(1 + trial % 255);
    write(changed);
    Events events;
    const EventStore store(file, events, 64);
    EXPECT_EQ(store.notice(), "");
    EXPECT_GE(store.earlier().size(), 30U);
    EXPECT_LE(store.damaged(), 1U);
    for (const StoredEvent& event : store.earlier()) EXPECT_EQ(event.run, 1U);
  }
}

TEST_F(EventStoreTest, FileOfAnotherKindIsMovedAsideAndSaid) {
  write(Bytes(100, 'x'));
  Events events;
  const EventStore store(file, events, 64);
  EXPECT_EQ(store.notice(), file.string() + " is no event store of this program: moved to " + file.string() +
                                ".bad, a new one begins.");
  EXPECT_TRUE(store.earlier().empty());
  EXPECT_EQ(std::filesystem::file_size(file.string() + ".bad"), 100U);
}

TEST_F(EventStoreTest, StoreOfAnotherSizeIsMovedAside) {
  run(1, 3, 8);
  Events events;
  EXPECT_NE(EventStore(file, events, 16).notice(), "");
}

TEST_F(EventStoreTest, FileThatCannotBeMadeIsRefused) {
  Events events;
  try {
    const EventStore store(folder / "nowhere" / "events.ring", events);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        (folder / "nowhere" / "events.ring").string() +
            ": event store: expected a file that can be read and written, found No such file or directory");
  }
}

}  // namespace
}  // namespace omma
