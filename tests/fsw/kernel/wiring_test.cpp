// What is wrong with a wiring is said at start-up, in a sentence that names component and port.
#include "fsw/kernel/wiring.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fsw/kernel/graph.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Number;
using testing::Scripted;
using testing::Sink;
using testing::Source;

RateGroupTable together(std::initializer_list<std::reference_wrapper<Component>> components) {
  RateGroup group{.name = "vision"};
  for (Component& component : components) group.components.push_back({component, 0ns});
  return {.base_period = 1ms, .groups = {group}};
}

RateGroupTable apart(Component& one, Component& other) {
  return {.base_period = 1ms,
          .groups = {{.name = "vision", .components = {{one}}}, {.name = "motion", .components = {{other}}}}};
}

/// Reads what a later component wrote in the tick before.
class Predictor final : public Component {
 public:
  Previous<Number> estimate;
  int seen = -1;
  std::string_view name() const override { return "predictor"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.input("estimate", estimate); }
  void step(const Tick&) noexcept override { seen = estimate->value; }
};

/// Sends every tick into a queue.
class Sender final : public Component {
 public:
  OutQueue<Number> numbers;
  std::string_view name() const override { return "sender"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("numbers", numbers); }
  void step(const Tick& tick) noexcept override {
    numbers.send({tick.number, 1});
    numbers.send({tick.number, 2});
  }
};

class Receiver final : public Component {
 public:
  explicit Receiver(std::string name = "receiver") : name_(std::move(name)) {}
  InQueue<Number> numbers;
  std::vector<int> seen;
  std::string_view name() const override { return name_; }
  void visit_ports(PortVisitor& visitor) const override { visitor.input("numbers", numbers); }
  void step(const Tick&) noexcept override {
    Number number;
    while (numbers.receive(number)) seen.push_back(static_cast<int>(number.tick) * 10 + number.value);
  }

 private:
  std::string name_;
};

TEST(Wiring, AcceptsAReaderAfterItsWriter) {
  Source source;
  Sink sink;
  sink.number.bind(source.number);
  EXPECT_THAT(trace_wiring(together({source, sink})).faults, IsEmpty());
}

TEST(Wiring, AnUnboundInputStopsTheProgram) {
  Source source;
  Sink sink;
  LockstepClock clock;
  try {
    const Scheduler scheduler(together({source, sink}), clock);
    FAIL() << "started";
  } catch (const WiringError& error) {
    EXPECT_STREQ(error.what(), "the program cannot start: input sink.number is not bound.");
  }
}

TEST(Wiring, AReaderBeforeItsWriterStopsTheProgram) {
  Source source;
  Sink sink;
  sink.number.bind(source.number);
  EXPECT_THAT(
      trace_wiring(together({sink, source})).faults,
      ElementsAre("sink.number reads source.number but runs before it in rate group 'vision'; place it "
                  "after, or declare the input Previous if the value of the tick before is meant."));
}

TEST(Wiring, FeedbackStandsBeforeItsWriterAndReadsTheTickBefore) {
  Source source;
  Predictor predictor;
  predictor.estimate.bind(source.number);
  EXPECT_THAT(trace_wiring(together({predictor, source})).faults, IsEmpty());
  EXPECT_THAT(trace_wiring(together({source, predictor})).faults, ElementsAre(HasSubstr("runs after it")));
  LockstepClock clock;
  Scheduler scheduler(together({predictor, source}), clock);
  scheduler.run(3);
  EXPECT_EQ(predictor.seen, 2);
}

TEST(Wiring, AnotherRateGroupIsReadThroughACrossingOnly) {
  Source source;
  Sink sink;
  sink.number.bind(source.number);
  EXPECT_THAT(
      trace_wiring(apart(source, sink)).faults,
      ElementsAre("sink.number reads source.number of another rate group ('vision'); lead it through a "
                  "crossing, Latest or Queue."));
  Latest<Number> number_for_sink(source.number);
  sink.number.bind(number_for_sink);
  EXPECT_THAT(trace_wiring(apart(source, sink)).faults, IsEmpty());
}

TEST(Wiring, AnOutputNobodySchedulesIsNotAWriter) {
  Source source;
  Sink sink;
  sink.number.bind(source.number);
  EXPECT_THAT(trace_wiring(together({sink})).faults,
              ElementsAre(HasSubstr("sink.number reads an output that no")));
}

TEST(Wiring, ACrossingHasOneReadingGroup) {
  Source source;
  Sink one("one");
  Sink other("other");
  Latest<Number> shared(source.number);
  one.number.bind(shared);
  other.number.bind(shared);
  RateGroupTable table = apart(one, other);
  table.groups.push_back({.name = "source", .components = {{source}}});
  EXPECT_THAT(
      trace_wiring(table).faults,
      ElementsAre("one.number and other.number read one crossing from two rate groups; give each group "
                  "its own."));
}

TEST(Wiring, AQueueIsBoundAtBothEndsAndHasOneReader) {
  Sender sender;
  Receiver one("one");
  Receiver other("other");
  EXPECT_THAT(trace_wiring(together({sender})).faults,
              ElementsAre("output sender.numbers is not bound to a queue."));
  Queue<Number, 8> queue;
  one.numbers.bind(queue);
  EXPECT_THAT(trace_wiring(together({one})).faults,
              ElementsAre("input one.numbers reads a queue that no output is bound to."));
  sender.numbers.bind(queue);
  EXPECT_THAT(trace_wiring(together({sender, one})).faults, IsEmpty());
  other.numbers.bind(queue);
  EXPECT_THAT(trace_wiring(together({sender, one, other})).faults,
              ElementsAre("one.numbers and other.numbers read one queue; give each a queue of its own."));
}

TEST(Wiring, AQueueBringsEveryMessageInOrderAndCountsWhatItDropped) {
  Sender sender;
  Receiver receiver;
  Queue<Number, 8> queue;
  sender.numbers.bind(queue);
  receiver.numbers.bind(queue);
  LockstepClock clock;
  Scheduler scheduler({.base_period = 1ms,
                       .groups = {{.name = "fast", .components = {{sender}}},
                                  {.name = "slow", .divisor = 6, .offset = 5, .components = {{receiver}}}}},
                      clock);
  scheduler.run(6);
  EXPECT_EQ(receiver.seen, (std::vector<int>{1, 2, 11, 12, 21, 22, 31, 32}));
  EXPECT_EQ(queue.dropped(), 4U);
}

TEST(Wiring, EveryFaultOfATableIsNamed) {
  Scripted component("twice");
  Scripted namesake("twice");
  const RateGroupTable table{
      .base_period = 0ms,
      .groups = {{.name = "a", .divisor = 0, .priority = 100, .components = {{component}}},
                 {.name = "b", .divisor = 2, .offset = 2, .components = {{component}}},
                 {.name = "b", .components = {{namesake}}},
                 {.name = "empty"}}};
  EXPECT_THAT(
      trace_wiring(table).faults,
      ElementsAre("the base period is not positive.", "rate group 'a' has divisor 0; it must be at least 1.",
                  "rate group 'a' has priority 100; it must be 0 to 99.",
                  "rate group 'b' has offset 2, which is not less than its divisor 2.",
                  "two rate groups are named 'b'.", "rate group 'empty' has no components.",
                  "component 'twice' is scheduled twice, in rate groups 'a' and 'b'.",
                  "two components are named 'twice'.", "two components are named 'twice'."));
}

TEST(Graph, DrawsGroupsConnectionsAndCrossings) {
  Source source;
  Sink sink;
  Sink far("far");
  sink.number.bind(source.number);
  Latest<Number> number_for_far(source.number);
  far.number.bind(number_for_far);
  const std::string dot = wiring_graph({.base_period = 5ms,
                                        .groups = {{.name = "vision",
                                                    .divisor = 20,
                                                    .priority = 50,
                                                    .core = 1,
                                                    .components = {{source, 3ms}, {sink}}},
                                                   {.name = "motion", .components = {{far}}}}});
  EXPECT_THAT(dot, HasSubstr("label=\"vision\\n10 Hz, offset 0, priority 50, core 1\""));
  EXPECT_THAT(dot, HasSubstr("c0 [label=\"source\\n3 ms\"]"));
  EXPECT_THAT(dot, HasSubstr("c0 -> c1 [label=\"number\"]"));
  EXPECT_THAT(dot, HasSubstr("c0 -> c2 [label=\"number\\nlatest\", style=dashed]"));
}

}  // namespace
}  // namespace omma
