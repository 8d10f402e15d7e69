// Angle to pulse and back, in quarters of a microsecond.
#include "components/motion/pulse_calibration.hpp"
#include "tests/refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace omma {
namespace {

TEST(PulseCalibration, PassesThroughItsPointsInQuartersOfAMicrosecond) {
  const PulseCalibration pulses(std::vector<PulsePoint>{{-1, 600}, {0, 1480.3}, {1.2, 2400}});
  EXPECT_EQ(pulses.pulse(-1), 2400);
  EXPECT_EQ(pulses.pulse(0), 5921);  // 1480.25 us is nearest
  EXPECT_EQ(pulses.pulse(1.2), 9600);
  EXPECT_EQ(pulses.pulse(0.6), std::lround(4 * (1480.3 + 2400) / 2));
}

TEST(PulseCalibration, AnglesBeyondThePointsGetTheLastPulse) {
  const PulseCalibration pulses(std::vector<PulsePoint>{{-1, 2400}, {1, 600}});
  EXPECT_EQ(pulses.pulse(-3), 9600);
  EXPECT_EQ(pulses.pulse(3), 2400);
}

TEST(PulseCalibration, TheWayBackIsWithinHalfAStep) {
  for (const bool falling : {false, true}) {
    const double sign = falling ? -1 : 1;
    const PulseCalibration pulses(
        std::vector<PulsePoint>{{-1.5, 1500 - sign * 900}, {0.1, 1500}, {1.5, 1500 + sign * 850}});
    const double step = 0.25 / 560;  // of the angle, at the flatter piece
    for (double angle = -1.5; angle <= 1.5; angle += 0.0137)
      EXPECT_NEAR(pulses.angle(pulses.pulse(angle)), angle, 0.51 * step) << angle;
  }
}

std::string refusal(const std::vector<PulsePoint>& points) {
  return refusal_of<std::invalid_argument>([&] { const PulseCalibration pulses(points); });
}

TEST(PulseCalibration, BadPointsAreNamed) {
  EXPECT_EQ(refusal({{0, 1500}}), "expected at least 2 points, found 1");
  EXPECT_NE(refusal({{0, 1500}, {0, 1600}}).find("point 2: expected an angle above"), std::string::npos);
  EXPECT_NE(refusal({{0, 1500}, {1, 1600}, {2, 1550}}).find("point 3: expected pulses that all rise"),
            std::string::npos);
  EXPECT_NE(refusal({{0, 63}, {1, 1600}}).find("point 1: expected a pulse of 64 to 4080 us"),
            std::string::npos);
}

}  // namespace
}  // namespace omma
