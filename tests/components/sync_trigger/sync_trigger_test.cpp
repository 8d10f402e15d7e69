// The sync trigger numbers frame sets, fires the line, and names what could not be sent.
#include "components/sync_trigger/sync_trigger.hpp"

#include <gtest/gtest.h>

#include "hal/simulated/simulated_trigger.hpp"

namespace omma {
namespace {

/// Sends all pulses but every third; an edge comes 40 ns after it was due.
class LameTrigger final : public TriggerDriver {
 public:
  std::string_view driver_name() const override { return "lame"; }
  std::optional<TimeNs> pulse(std::uint64_t number, TimeNs due_ns) noexcept override {
    if (number % 3 == 2) return std::nullopt;
    return due_ns + 40;
  }
};

TEST(SyncTrigger, NumbersFrameSetsAndTellsWhenTheEdgeWasMade) {
  LameTrigger line;
  Events events;
  SyncTrigger trigger(&line, events);
  for (std::uint64_t n = 0; n < 9; ++n) {
    trigger.step({n, static_cast<TimeNs>(1000 * n)});
    EXPECT_EQ(trigger.trigger->number, n);
    EXPECT_EQ(trigger.trigger->sent, n % 3 != 2);
    EXPECT_EQ(trigger.trigger->time_ns, static_cast<TimeNs>(1000 * n) + (n % 3 != 2 ? 40 : 0));
  }
  EXPECT_EQ(trigger.failures(), 3U);
  EventRecord record;
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(record.id, kPulseNotSent.id);
  EXPECT_EQ(record.values[0], 2);
}

TEST(SyncTrigger, WithoutALineNothingIsSent) {
  Events events;
  SyncTrigger trigger(nullptr, events);
  trigger.step({0, 17});
  EXPECT_FALSE(trigger.trigger->sent);
  EXPECT_EQ(trigger.trigger->time_ns, 17);
  EXPECT_EQ(trigger.failures(), 0U);
}

}  // namespace
}  // namespace omma
