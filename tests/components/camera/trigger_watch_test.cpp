// What became of the frames of fired cameras is named: lost, late, of no trigger; and nothing while all is
// well.
#include "components/camera/trigger_watch.hpp"

#include <gtest/gtest.h>

#include <map>

namespace omma {
namespace {

constexpr TimeNs kPeriod = 100'000'000;

class TriggerWatchTest : public testing::Test {
 protected:
  TriggerWatchTest() : watch_(1, {.tolerance_ns = kPeriod / 4}, events_) {
    watch_.trigger.bind(trigger_);
    watch_.frames.bind(frames_);
    frames_->cameras.resize(1);
  }
  static TimeNs edge(std::uint64_t n) { return 1'000'000'000 + static_cast<TimeNs>(n) * kPeriod; }

  /// Trigger n is sent; then the camera shows the frame with this stamp, or none where it is 0.
  void beat(std::uint64_t n, TimeNs stamp_ns) {
    trigger_->number = n;
    trigger_->time_ns = edge(n);
    trigger_->sent = true;
    Frame& frame = frames_->cameras[0];
    frame.status = stamp_ns == 0 ? FrameStatus::kMissing : FrameStatus::kFresh;
    frame.exposure_midpoint_ns = stamp_ns;
    watch_.step({n, edge(n)});
  }
  /// The frames of a camera that are read out one trigger after they were exposed.
  static TimeNs stamp(std::uint64_t n) { return edge(n) + 14'000'000; }

  std::multimap<int, EventRecord> told() {
    std::multimap<int, EventRecord> events;
    for (EventRecord record; events_.take(record);) events.emplace(record.id, record);
    return events;
  }

  Events events_;
  TriggerWatch watch_;
  Out<Trigger> trigger_;
  Out<Frames> frames_;
};

TEST_F(TriggerWatchTest, SaysNothingOfACameraThatKeepsUpOneTriggerBehind) {
  beat(0, 0);
  for (std::uint64_t n = 1; n < 200; ++n) beat(n, stamp(n - 1));
  EXPECT_TRUE(told().empty());
  EXPECT_EQ(watch_.lost(0), 0U);
}

TEST_F(TriggerWatchTest, NamesTriggersThatGotNoFrame) {
  beat(0, 0);
  for (std::uint64_t n = 1; n < 20; ++n) beat(n, n == 8 || n == 9 ? 0 : stamp(n - 1));
  const auto events = told();
  ASSERT_EQ(events.size(), 1U);
  const EventRecord& lost = events.begin()->second;
  EXPECT_EQ(lost.id, kTriggersWithoutFrame.id);
  EXPECT_EQ(lost.values[1], 2);
  EXPECT_EQ(lost.values[2], 9);
  EXPECT_EQ(watch_.lost(0), 2U);
}

TEST_F(TriggerWatchTest, NamesAFrameThatComesLaterThanUsual) {
  beat(0, 0);
  for (std::uint64_t n = 1; n < 10; ++n) beat(n, stamp(n - 1));
  beat(10, 0);
  beat(11, stamp(9));
  const auto events = told();
  ASSERT_EQ(events.size(), 1U);
  const EventRecord& late = events.begin()->second;
  EXPECT_EQ(late.id, kFrameOfEarlierTrigger.id);
  EXPECT_EQ(late.values[1], 9);
  EXPECT_EQ(late.values[2], 1);
}

TEST_F(TriggerWatchTest, NamesAFrameOfNoTrigger) {
  beat(0, 0);
  for (std::uint64_t n = 1; n < 10; ++n) beat(n, stamp(n - 1));
  beat(10, stamp(9) + 40'000'000);
  const auto events = told();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events.begin()->second.id, kFrameOfNoTrigger.id);
  EXPECT_EQ(events.begin()->second.values[1], 40);
}

}  // namespace
}  // namespace omma
