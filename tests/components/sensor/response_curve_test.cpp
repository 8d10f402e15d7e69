#include "components/sensor/response_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr double kBlack = 64, kScale = 500;

// A logarithmic sensor: grey = black + c ln(1 + light / c).
ResponseCurve logarithmic() {
  std::vector<ResponsePoint> points;
  for (double grey = 0; grey <= 4095; grey += 16)
    points.push_back({grey, kScale * (std::exp((grey - kBlack) / kScale) - 1)});
  return ResponseCurve(points);
}

TEST(ResponseCurve, MakesALogarithmicSensorEven) {
  std::vector<std::uint16_t> table(5000);
  logarithmic().even_levels(4095, kBlack, table);
  for (const double light : {10.0, 100.0, 1000.0, 20000.0}) {
    const double grey = kBlack + kScale * std::log1p(light / kScale);
    const auto even = static_cast<double>(table[static_cast<std::size_t>(std::lround(grey))]);
    EXPECT_NEAR(even - kBlack, light, 0.02 * light + 1 + light / kScale) << light;
  }
  EXPECT_EQ(table[4095], 65535);
  EXPECT_EQ(table.back(), 65535);
  for (std::size_t i = 1; i < table.size(); ++i) EXPECT_GE(table[i], table[i - 1]);
}

TEST(ResponseCurve, TellsHowNoiseGrowsWithLight) {
  // Noise σ of the raw level is σ (1 + L / c) on the even scale: a share σ / c of the light where that is
  // large.
  EXPECT_GT(logarithmic().relative_noise(2, kBlack), 2 / kScale);
  EXPECT_LT(logarithmic().relative_noise(2, kBlack), 1.6 * 2 / kScale);
  const ResponseCurve even({{0, 0}, {255, 10}});
  EXPECT_NEAR(even.relative_noise(2, 10), 0, 1e-6);
}

std::string message_of(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / ("omma_response_" + std::to_string(::getpid()));
  std::ofstream(file) << text;
  std::string message = "nothing was wrong";
  try {
    read_response_curve(file);
  } catch (const InputError& error) {
    message = error.what();
  }
  std::filesystem::remove(file);
  return message;
}

TEST(ResponseCurve, ReadsAFileAndSaysWhatIsWrongWithIt) {
  EXPECT_EQ(message_of("# grey light\n0\t0\n100 3.5 # a comment\n\n255\t99\n"), "nothing was wrong");
  EXPECT_NE(message_of("0 0\n1 x\n").find(":2: response: expected two numbers"), std::string::npos);
  EXPECT_NE(message_of("0 0\n1 1 1\n").find(":2: response: expected two numbers"), std::string::npos);
  EXPECT_NE(message_of("0 0\n5 1\n5 2\n").find(":3: response: expected both columns rising"),
            std::string::npos);
  EXPECT_NE(message_of("0 0\n").find("at least two points, found 1"), std::string::npos);
  EXPECT_THROW(read_response_curve("/nowhere/at/all"), InputError);
  EXPECT_THROW(ResponseCurve({{0, 0}}), std::invalid_argument);
  EXPECT_THROW(ResponseCurve({{0, 0}, {1, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace omma
