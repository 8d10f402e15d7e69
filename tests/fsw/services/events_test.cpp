// Events: throttled per id, in order, never lost uncounted; their sentences made from the declaration.
#include "fsw/services/events.hpp"

#include <gtest/gtest.h>

#include <map>
#include <thread>
#include <vector>

#include "fsw/services/event_text.hpp"

namespace omma {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

inline constexpr EventDescriptor kCameraLost{.id = 7,
                                             .severity = EventSeverity::kFailure,
                                             .name = "camera_lost",
                                             .text = "camera {0} gave no frame for {1}",
                                             .values = {{{"camera"}, {"time", "s"}}},
                                             .burst = 3};
inline constexpr EventDescriptor kOften{.id = 8, .name = "often", .text = "often", .burst = 1'000'000};
inline constexpr EventDescriptor kRare{.id = 9, .name = "rare", .text = "rare"};

// What must not compile does not: the checks behind the static_asserts say no.
static_assert(are_unique(std::array{kCameraLost, kOften, kRare}));
static_assert(!are_unique(std::array{kCameraLost, EventDescriptor{.id = 7, .name = "other", .text = ""}}));
static_assert(!are_unique(std::array{kCameraLost,
                                     EventDescriptor{.id = 1, .name = "camera_lost", .text = ""}}));
static_assert(!is_well_formed({.id = 0, .name = "n", .text = ""}));
static_assert(!is_well_formed({.id = limits::kEventIds, .name = "n", .text = ""}));
static_assert(!is_well_formed({.id = 1, .name = "", .text = ""}));
static_assert(!is_well_formed({.id = 1, .name = "n", .text = "{1}", .values = {{{"only"}}}}));
static_assert(!is_well_formed({.id = 1, .name = "n", .text = "{0", .values = {{{"only"}}}}));
static_assert(!is_well_formed({.id = 1, .name = "n", .text = "", .burst = 0}));

std::vector<EventRecord> take_all(Events& events) {
  std::vector<EventRecord> all;
  EventRecord record;
  while (events.take(record)) all.push_back(record);
  return all;
}

TEST(Events, CarryTickNumbersAndSeverity) {
  Events events;
  events.raise<kCameraLost>(Tick{12, 5 * kSecond}, 2, 1.5);
  const auto all = take_all(events);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].id, 7);
  EXPECT_EQ(all[0].tick, 12U);
  EXPECT_EQ(all[0].time_ns, 5 * kSecond);
  EXPECT_EQ(all[0].severity, EventSeverity::kFailure);
  EXPECT_EQ(all[0].value_count, 2);
  EXPECT_EQ(event_text(kCameraLost, all[0]), "camera 2 gave no frame for 1.5 s");
}

TEST(Events, ABurstPassesThenOneAnIntervalAndTheRestIsCounted) {
  Events events;
  for (std::uint64_t i = 0; i < 10; ++i) events.raise<kCameraLost>(Tick{i, 0}, i, 0);
  EXPECT_EQ(take_all(events).size(), 3U);
  // The three used up three intervals: after 1 s one place is free again.
  events.raise<kCameraLost>(Tick{10, kSecond - 1}, 10, 0);
  EXPECT_TRUE(take_all(events).empty());
  events.raise<kCameraLost>(Tick{11, kSecond}, 11, 0);
  const auto all = take_all(events);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].held_back, 8U);
  EXPECT_EQ(event_text(kCameraLost, all[0]), "camera 11 gave no frame for 0 s (and 8 before it)");
  // At one an interval all pass.
  for (std::uint64_t i = 2; i < 50; ++i)
    events.raise<kCameraLost>(Tick{i, static_cast<TimeNs>(i) * kSecond}, i, 0);
  EXPECT_EQ(take_all(events).size(), 48U);
}

TEST(Events, OneChattyEventDoesNotSilenceAnother) {
  Events events;
  for (std::uint64_t i = 0; i < 100; ++i) events.raise<kCameraLost>(Tick{i, 0}, 0, 0);
  events.raise<kRare>(Tick{100, 0});
  const auto all = take_all(events);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[3].id, 9);
}

TEST(Events, AFullRingDropsTheNewAndCountsThem) {
  Events events;
  for (std::uint64_t i = 0; i < Events::kCapacity + 20; ++i) events.raise<kOften>(Tick{i, 0});
  EXPECT_EQ(events.dropped(), 20U);
  const auto all = take_all(events);
  ASSERT_EQ(all.size(), Events::kCapacity);
  for (std::uint64_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].tick, i);
  events.raise<kOften>(Tick{999, 0});
  EXPECT_EQ(take_all(events).size(), 1U) << "the ring works on after it was full";
}

TEST(Events, FromManyThreadsAllArriveOnceOrAreCountedAsDropped) {
  Events events;
  constexpr int kThreads = 4;
  constexpr std::uint64_t kEach = 20000;
  std::vector<std::thread> producers;
  std::atomic<int> running{kThreads};
  for (int t = 0; t < kThreads; ++t) {
    producers.emplace_back([&events, &running, t] {
      for (std::uint64_t i = 0; i < kEach; ++i)
        events.raise<kOften>(Tick{static_cast<std::uint64_t>(t) * kEach + i, 0});
      running.fetch_sub(1);
    });
  }
  std::map<std::uint64_t, std::uint64_t> last;  // by thread: its events come in its order
  std::uint64_t received = 0;
  EventRecord record;
  bool ended = false;
  while (!ended) {
    ended = running.load() == 0;
    while (events.take(record)) {
      const std::uint64_t thread = record.tick / kEach;
      const auto [at, first] = last.try_emplace(thread, record.tick);
      if (!first) {
        ASSERT_GT(record.tick, at->second);
        at->second = record.tick;
      }
      ++received;
    }
    std::this_thread::yield();
  }
  for (std::thread& producer : producers) producer.join();
  EXPECT_EQ(received + events.dropped(), events.raised());
  EXPECT_GT(received, 0U);
}

TEST(EventText, TellsAChoiceByItsWord) {
  constexpr EventDescriptor kTurned{
      .id = 10, .name = "turned", .text = "turned {0}", .values = {{{"side", "", "left|right"}}}};
  EXPECT_EQ(event_text(kTurned, {.id = 10, .value_count = 1, .values = {1.0}}), "turned right");
  EXPECT_EQ(event_text(kTurned, {.id = 10, .value_count = 1, .values = {2.0}}), "turned 2");
}

TEST(EventText, SaysWhenARecordLacksANumber) {
  EventRecord record{.id = 7, .value_count = 1, .values = {3.0}};
  EXPECT_EQ(event_text(kCameraLost, record), "camera 3 gave no frame for ?");
}

}  // namespace
}  // namespace omma
