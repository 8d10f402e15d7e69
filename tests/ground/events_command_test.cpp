// `omma events` as an operator runs it.
#include <gmock/gmock.h>

#include "fsw/services/event_store.hpp"
#include "tests/ground/run_omma.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr EventDescriptor kSlip{.id = 90,
                                .severity = EventSeverity::kWarning,
                                .name = "slip",
                                .text = "group {0} slipped by {1}",
                                .values = {{{"group"}, {"time", "ms"}}}};

constexpr const char* kDictionary = R"({"commands": [], "events": [
  {"id": 23, "name": "run_began", "text": "run {0} began", "values": [{"name": "run", "unit": ""}]},
  {"id": 90, "name": "slip", "text": "group {0} slipped by {1}",
   "values": [{"name": "group", "unit": "", "choices": ["vision", "health"]}, {"name": "time", "unit": "ms"}]}]})";

/// Two runs, the second with a slip.
class EventsCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int run = 1; run <= 2; ++run) {
      Events events;
      EventStore store(folder / "events.ring", events, 64);
      store.begin({});
      if (run == 2) events.raise<kSlip>(Tick{7, 1'250'000'000}, 1, 2.5);
      store.serve();
    }
    folder.write("dictionary.json", kDictionary);
  }
  const OperatorsFolder folder;
};

TEST_F(EventsCommand, TellsTheSentencesOfEveryRun) {
  const Told told = folder.omma("events events.ring --dictionary dictionary.json");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_EQ(told.out,
            "run 1             0.000 s  activity   run 1 began\n"
            "run 2             0.000 s  activity   run 2 began\n"
            "run 2             1.250 s  warning    group health slipped by 2.5 ms\n"
            "3 events, 0 damaged records\n");
}

TEST_F(EventsCommand, WithoutADictionaryTellsTheNumbers) {
  const Told told = folder.omma("events events.ring --run 2 --warnings");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_EQ(told.out,
            "run 2             1.250 s  warning    event_90 (1, 2.5)\n"
            "1 events, 0 damaged records\n");
}

TEST_F(EventsCommand, RefusesAFileThatIsNoStoreAndLeavesItAlone) {
  folder.write("note.txt", "nothing of the kind");
  const Told told = folder.omma("events note.txt");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_THAT(told.err,
              HasSubstr("note.txt: event store: expected what `omma-fsw --events FILE` keeps, found"));
  EXPECT_EQ(folder.read("note.txt"), "nothing of the kind");
  EXPECT_THAT(folder.omma("events missing.ring").err, HasSubstr("No such file"));
}

TEST_F(EventsCommand, RefusesADictionaryWhoseSentenceLacksItsValues) {
  folder.write("bad.json",
               R"({"commands": [], "events": [{"id": 9, "name": "n", "text": "{1}", "values": []}]})");
  const Told told = folder.omma("events events.ring --dictionary bad.json");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_THAT(told.err, HasSubstr("bad.json: dictionary: expected what"));
  EXPECT_THAT(told.out, Not(HasSubstr("run")));
}

}  // namespace
}  // namespace omma
