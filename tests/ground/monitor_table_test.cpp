// The monitor's table: what each topic's newest sample reads like, and what is marked as good, bad or stale.
#include "ground/monitor/monitor_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "components/telemetry/cdr.hpp"
#include "components/telemetry/samples.hpp"

namespace omma::ground {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;
using telemetry::TopicId;

class MonitorTable : public ::testing::Test {
 protected:
  template <class Sample>
  void heard(TopicId topic, const Sample& sample) {
    samples.take(topic, cdr.write(topic, &sample), now);
  }
  /// The first line that holds the text; fails where there is none.
  TableLine line_with(const std::string& text, SteadyClock::duration later = 0s) const {
    const std::vector<TableLine> table = monitor_table(samples, {.spacecraft = "testsat"}, now + later);
    const auto at = std::find_if(table.begin(), table.end(), [&](const TableLine& line) {
      return line.text.find(text) != std::string::npos;
    });
    EXPECT_NE(at, table.end()) << text;
    return at == table.end() ? TableLine{} : *at;
  }

  telemetry::CdrWriter cdr;
  NewestSamples samples;
  const SteadyClock::time_point now = SteadyClock::now();
};

omma_Status status_in(omma_Mode mode) {
  omma_Status status{};
  status.sample_number = 1;
  status.valid = true;
  status.mode = mode;
  status.mode_since_ns = 2'500'000'000;
  status.parameter_set = 4;
  status.parameters_staged = 2;
  status.commands_accepted = 7;
  status.commands_rejected = 3;
  status.acks_dropped = 1;
  return status;
}

TEST_F(MonitorTable, TellsModeCommandsAndParameters) {
  heard(TopicId::kStatus, status_in(omma_MODE_TRACK));
  EXPECT_EQ(line_with("mode track since 2.500 s").style, LineStyle::kGood);
  EXPECT_THAT(line_with("commands accepted 7, rejected 3").text, HasSubstr("untold answers 1"));
  line_with("parameter set 4, 2 staged");
}

TEST_F(MonitorTable, MarksSafeModeAndAlarms) {
  heard(TopicId::kStatus, status_in(omma_MODE_SAFE));
  EXPECT_EQ(line_with("mode SAFE").style, LineStyle::kBad);
  omma_Status status = status_in(omma_MODE_TRACK);
  status.limits_warned = 1;
  heard(TopicId::kStatus, status);
  EXPECT_EQ(line_with("1 warned, 0 in alarm").style, LineStyle::kWarning);
  status.limits_alarmed = 1;
  heard(TopicId::kStatus, status);
  EXPECT_EQ(line_with("1 warned, 1 in alarm").style, LineStyle::kBad);
}

TEST_F(MonitorTable, NothingThatIsOldLooksGood) {
  heard(TopicId::kStatus, status_in(omma_MODE_TRACK));
  EXPECT_EQ(line_with("mode track", 2s).style, LineStyle::kGood);
  EXPECT_EQ(line_with("mode track", 4s).style, LineStyle::kStale);
}

TEST_F(MonitorTable, TellsHowACameraWasExposedWhereThatIsKnown) {
  omma_CameraStatus cameras[2]{};
  telemetry::set_text(cameras[0].name, "cam0");
  telemetry::set_text(cameras[1].name, "cam1");
  cameras[0].state = cameras[1].state = omma_FRAME_FRESH;
  cameras[0].exposure_ms = 12.5;
  cameras[0].gain = 2;
  cameras[0].black_level_levels = 10;
  cameras[0].full_share = 0.0125;
  omma_FrameSet frame_set{};
  frame_set.valid = true;
  frame_set.cameras = {2, 2, cameras, false};
  heard(TopicId::kFrameSet, frame_set);
  const TableLine line = line_with("exposed 12.500 ms, gain 2.00, black level 10.0");
  EXPECT_EQ(line.style, LineStyle::kPlain);
  EXPECT_THAT(line.text, HasSubstr("fixed, 1.25 % full"));
  line_with("cam1");
  cameras[0].exposures_refused = 3;
  heard(TopicId::kFrameSet, frame_set);
  EXPECT_EQ(line_with("refused 3").style, LineStyle::kWarning);
}

TEST_F(MonitorTable, TellsEachStageOfAFrameSetAndMarksTheLateOne) {
  omma_StageTiming stages[2]{};
  telemetry::set_text(stages[0].name, "frame");
  telemetry::set_text(stages[1].name, "dots");
  for (omma_StageTiming& stage : stages) {
    stage.reached = true;
    stage.latency_ns = 5'250'000;
    stage.budget_ns = 6'000'000;
  }
  stages[1].budget_ns = 5'000'000;
  stages[1].over_budget = 12;
  stages[1].reached = false;
  omma_FrameTiming timing{};
  timing.valid = true;
  timing.stages = {2, 2, stages, false};
  heard(TopicId::kFrameTiming, timing);
  EXPECT_EQ(line_with("frame               5.250").style, LineStyle::kPlain);
  const TableLine dots = line_with("dots                5.250");
  EXPECT_EQ(dots.style, LineStyle::kWarning);
  EXPECT_THAT(dots.text, HasSubstr("5.0     12   left out"));
}

TEST_F(MonitorTable, TellsTheStepsOfEachComponent) {
  omma_StepTiming step{};
  telemetry::set_text(step.name, "tracker");
  step.steps = 100;
  step.mean_ns = 1'500'000;
  step.max_ns = 16'000'000;
  step.budget_ns = 15'000'000;
  step.over_budget = 1;
  omma_Timing timing{};
  timing.valid = true;
  timing.steps = {1, 1, &step, false};
  heard(TopicId::kTiming, timing);
  const TableLine line = line_with("tracker");
  EXPECT_EQ(line.style, LineStyle::kWarning);
  EXPECT_THAT(line.text, HasSubstr("100     1.500"));
}

TEST_F(MonitorTable, TellsUtcWithItsSourceAndError) {
  omma_UtcCorrelation utc{};
  utc.valid = true;
  utc.source = omma_UTC_DISCIPLINED_CLOCK;
  utc.utc_ns = 1'775'174'399'500'000'000;
  utc.time_ns = 3'000'000'000;
  utc.uncertainty_ns = 2'000'000;
  heard(TopicId::kUtc, utc);
  EXPECT_THAT(line_with("UTC 2026-04-02T23:59:59.500Z").text,
              HasSubstr("on-board time 3.000 s, within 0.002000 s (the system's clock, kept by NTP or PPS)"));
  utc.valid = false;
  utc.uncertainty_ns = -1;
  heard(TopicId::kUtc, utc);
  EXPECT_EQ(line_with("error not known").style, LineStyle::kWarning);
}

TEST_F(MonitorTable, TellsTheAxesAndALostServoBoard) {
  omma_AxisCommand axis{};
  telemetry::set_text(axis.name, "yaw");
  axis.angle_rad = -0.5;
  axis.pulse_quarter_us = 6001;
  omma_Motion motion{};
  motion.valid = true;
  motion.axes = {1, 1, &axis, false};
  heard(TopicId::kMotion, motion);
  EXPECT_THAT(line_with("yaw").text, HasSubstr("-28.648 deg"));
  EXPECT_THAT(line_with("yaw").text, HasSubstr("1500.25 us"));
  motion.board_lost = true;
  heard(TopicId::kMotion, motion);
  EXPECT_EQ(line_with("BOARD LOST").style, LineStyle::kBad);
}

TEST_F(MonitorTable, KeepsTheNewestEventsAndTheAnswersToCommands) {
  for (int i = 0; i < 12; ++i) {
    omma_Event event{};
    event.valid = true;
    event.severity = omma_EVENT_FAILURE;
    event.runs_ago = i == 11 ? 1 : 0;
    telemetry::set_text(event.text, "number " + std::to_string(i));
    heard(TopicId::kEvent, event);
  }
  EXPECT_EQ(samples.events().size(), NewestSamples::kEvents);
  const TableLine newest = line_with("(1 runs ago) number 11", 60s);
  EXPECT_EQ(newest.style, LineStyle::kBad) << "an event stays true";
  omma_CommandAck ack{};
  ack.valid = true;
  ack.stage = omma_COMMAND_REJECTED;
  telemetry::set_text(ack.text, "set_mode track: rejected");
  heard(TopicId::kCommandAck, ack);
  line_with("set_mode track: rejected");
}

TEST_F(MonitorTable, BytesOfAnotherTypeAreCountedAndPassedOver) {
  const std::array<std::byte, 5> few{};
  samples.take(TopicId::kStatus, few, now);
  EXPECT_EQ(samples.undecodable(), 1U);
  EXPECT_EQ(samples.status(), nullptr);
}

}  // namespace
}  // namespace omma::ground
