// Pictures of more than 8 bits: exposures fused in flight, and a camera's own pixels at full depth.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/components/imaging/imaging_bench.hpp"

namespace omma {
namespace {

using testing::ImagingBench;

constexpr double kWhite = 4095;
constexpr double kBlack = 64;
constexpr double kElectrons = 2;   // a grey level
constexpr double kReadNoise = 5;   // [electrons]
constexpr double kShort = 0.0005;  // [s]
constexpr double kLong = 0.05;
const Eigen::Vector3d kLamp = Eigen::Vector3d(1, 0.2, 0.3).normalized();
const Eigen::Vector3d kVeil = Eigen::Vector3d(-0.2, 1, -0.3).normalized();

/// Shares of white a second: a lamp that fills the long exposure 25 times over, a patch that is three grey
/// levels in the long one and none in the short, nothing else.
double light(const Eigen::Vector3d& d) {
  if (d.dot(kLamp) > std::cos(0.15)) return 500;
  if (d.dot(kVeil) > std::cos(0.15)) return 3 / kWhite / kLong;
  return 0;
}

/// What a noisy, linear sensor gives of it.
testing::PaintedSky sensor(double exposure, std::mt19937_64& random) {
  return [exposure, &random](const Eigen::Vector3d& d) {
    const double electrons = kElectrons * kWhite * light(d) * exposure;
    std::normal_distribution<double> noise(0, std::sqrt(electrons + kReadNoise * kReadNoise) / kElectrons);
    return std::clamp(std::round(kBlack + electrons / kElectrons + noise(random)), 0.0, kWhite) / kWhite;
  };
}

CameraSettings exposed(double exposure) {
  return {.exposure_ns = std::llround(1e9 * exposure), .gain = 1, .black_level = kBlack};
}

ImagingParameters fused_panorama() {
  ImagingParameters parameters;
  parameters.panorama.width = 256;
  parameters.composite = ImageComposite::kFused;
  parameters.composed_rows = 128;
  parameters.compress = true;
  for (CameraSensor& one : parameters.sensors) one = {.electrons = kElectrons, .black_level = kBlack};
  return parameters;
}

struct Whole {
  std::vector<std::uint16_t> levels;
  ImageChunk chunk;  // the last
  GreyScale scale;
  double mean_about(const Eigen::Vector3d& direction, double angle) const {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < chunk.height; ++v) {
      for (int u = 0; u < chunk.width; ++u) {
        if (panorama_direction(Eigen::Vector2d(u, v), chunk.width).dot(direction) < std::cos(angle)) continue;
        sum += scale.light(levels[static_cast<std::size_t>(v * chunk.width + u)]);
        ++count;
      }
    }
    return sum / count;
  }
};

/// Flies until a picture is whole; the rig turns by 1.1 degrees a frame set.
/// @param seen  what the sensors give in an exposure of so many seconds
Whole fly(ImagingBench& bench, const std::function<testing::PaintedSky(double)>& seen) {
  Whole whole;
  for (std::uint64_t number = 1; number < 60; ++number) {
    const double exposure = number % 2 == 0 ? kShort : kLong;
    const Eigen::Quaterniond attitude =
        rotation_exp(Eigen::Vector3d(0.02 * static_cast<double>(number), 0.3, 0.1));
    if (number < 14) bench.take(number, attitude, seen(exposure), exposed(exposure));
    bench.imaging.step({});
    const ImageChunk& chunk = *bench.imaging.chunk;
    if (!chunk.valid) continue;
    whole.levels.resize(std::size_t{chunk.width} * chunk.height);
    EXPECT_TRUE(testing::levels_of(chunk, std::span(whole.levels)
                                              .subspan(std::size_t{chunk.first_row} * chunk.width,
                                                       std::size_t{chunk.rows} * chunk.width)));
    whole.chunk = chunk;
    whole.scale = {chunk.scale, chunk.bits, chunk.light_most, chunk.light_soft};
    if (chunk.first_row + chunk.rows == chunk.height) return whole;
  }
  ADD_FAILURE() << "no picture";
  return whole;
}

Whole fly(ImagingBench& bench, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return fly(bench, [&random](double exposure) { return sensor(exposure, random); });
}

TEST(FusedPicture, HoldsALampAndAVeilThatNoOneExposureDoes) {
  ImagingBench bench(fused_panorama());
  const Whole whole = fly(bench, 3);
  ASSERT_EQ(whole.chunk.composite, ImageComposite::kFused);
  EXPECT_EQ(whole.chunk.composed, 4);
  EXPECT_EQ(whole.chunk.bits, 12);
  EXPECT_EQ(whole.chunk.scale, ImageScale::kAsinh);
  const double lamp = whole.mean_about(kLamp, 0.12);
  const double veil = whole.mean_about(kVeil, 0.12);
  const double dark = whole.mean_about(Eigen::Vector3d(-1, 0, 0), 0.12);
  RecordProperty("lamp", std::to_string(lamp / 500));
  RecordProperty("veil", std::to_string(veil * kWhite * kLong / 3));
  std::printf("lamp %.4f, veil %.4f of the truth, dark sky %.4f veils, the lamp %.0f times the veil\n",
              lamp / 500, veil * kWhite * kLong / 3, dark * kWhite * kLong / 3, lamp / veil);
  EXPECT_NEAR(lamp / 500, 1, 0.01);
  EXPECT_NEAR(veil * kWhite * kLong / 3, 1, 0.05);
  EXPECT_NEAR(dark * kWhite * kLong / 3, 0, 0.05);
  // Neither exposure alone: the long one is full, the short one a thirtieth of a grey level of the veil.
  EXPECT_GT(500 * kLong, 1);
  EXPECT_LT(light(kVeil) * kWhite * kShort, 0.5);
}

// The same sky by sensors whose levels rise with the logarithm of light: grey = black + c ln(1 + even / c).
TEST(FusedPicture, TakesSensorsThatAreNotLinear) {
  constexpr double kCurve = 600;
  const auto grey = [](double even) { return kBlack + kCurve * std::log1p(even / kCurve); };
  std::vector<ResponsePoint> points;
  for (double level = 0; level <= kWhite; level += 16)
    points.push_back({level, kCurve * std::expm1((level - kBlack) / kCurve)});
  ImagingParameters parameters = fused_panorama();
  for (CameraSensor& one : parameters.sensors) {
    one.response = ResponseCurve(points);
    one.relative_noise = one.response.relative_noise(kReadNoise / kElectrons, kBlack);
  }
  ImagingBench bench(parameters);
  std::mt19937_64 random(6);
  const Whole whole = fly(bench, [&](double exposure) -> testing::PaintedSky {
    return [exposure, &random, &grey](const Eigen::Vector3d& d) {
      const double electrons = kElectrons * kWhite * light(d) * exposure;
      std::normal_distribution<double> photons(0, std::sqrt(electrons));
      std::normal_distribution<double> reading(0, kReadNoise / kElectrons);
      const double even = std::max(0.0, electrons + photons(random)) / kElectrons;
      return std::clamp(std::round(grey(even) + reading(random)), 0.0, kWhite) / kWhite;
    };
  });
  const double lamp = whole.mean_about(kLamp, 0.12) / 500;
  const double veil = whole.mean_about(kVeil, 0.12) * kWhite * kLong / 3;
  std::printf("lamp %.4f, veil %.4f of the truth\n", lamp, veil);
  EXPECT_NEAR(lamp, 1, 0.02);
  EXPECT_NEAR(veil, 1, 0.1);
}

TEST(FusedPicture, IsTheSameEveryTime) {
  ImagingBench a(fused_panorama());
  ImagingBench b(fused_panorama());
  EXPECT_EQ(fly(a, 5).levels, fly(b, 5).levels);
}

TEST(FusedPicture, WaitsAndTellsWhereNoCameraTellsItsExposure) {
  ImagingBench bench(fused_panorama());
  bench.take(1, Eigen::Quaterniond::Identity());
  for (int step = 0; step < 20; ++step) {
    bench.imaging.step({});
    EXPECT_FALSE(bench.imaging.chunk->valid);
  }
  EventRecord record;
  ASSERT_TRUE(bench.events.take(record));
  EXPECT_EQ(record.id, kNothingToFuse.id);
  EXPECT_FALSE(bench.events.take(record)) << "once";
}

TEST(FusedPicture, IsMadeByCommandBesideTheMissionsPicture) {
  ImagingParameters parameters = fused_panorama();
  parameters.composite = ImageComposite::kSingle;
  parameters.view = {120, 90, 0.8, 0.25};
  ImagingBench bench(parameters);
  std::mt19937_64 random(4);
  Command command;
  command.opcode = kRequestFused.id;
  command.argument_count = 4;
  const double degree = std::numbers::pi / 180;
  command.arguments = {2, std::atan2(kLamp.y(), kLamp.x()) / degree, std::asin(kLamp.z()) / degree, 20};
  EXPECT_EQ(bench.imaging.receive(command, {}).state, CommandOutcome::State::kDone);
  bool seen = false;
  for (std::uint64_t number = 1; number < 200 && !seen; ++number) {
    const double exposure = number % 2 == 0 ? kShort : kLong;
    bench.take(number, Eigen::Quaterniond::Identity(), sensor(exposure, random), exposed(exposure));
    bench.imaging.step({});
    const ImageChunk& chunk = *bench.imaging.chunk;
    if (!chunk.valid || chunk.composite != ImageComposite::kFused) continue;
    seen = chunk.first_row + chunk.rows > 45;
    if (!seen) continue;
    EXPECT_EQ(chunk.kind, ImageKind::kView);
    EXPECT_NEAR(chunk.field, 20 * degree, 1e-12);
    std::vector<std::uint16_t> levels(std::size_t{chunk.rows} * chunk.width);
    ASSERT_TRUE(testing::levels_of(chunk, levels));
    const GreyScale scale{chunk.scale, chunk.bits, chunk.light_most, chunk.light_soft};
    EXPECT_NEAR(scale.light(levels[static_cast<std::size_t>((45 - chunk.first_row) * 120 + 60)]) / 500, 1,
                0.1);
  }
  EXPECT_TRUE(seen);
}

TEST(FusedPicture, AllocatesNothing) {
  if (!memory_guard::installed()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  ImagingBench bench(fused_panorama());
  bench.take(1, Eigen::Quaterniond::Identity(), testing::smooth_sky, exposed(kLong));
  const std::uint64_t before = memory_guard::violations().total();
  for (int step = 0; step < 60; ++step) {
    const RealTimeScope scope;
    if (step == 5) bench.imaging.request({.kind = ImageKind::kCamera, .region = {1, 10, 20, 200, 150}});
    bench.imaging.step({});
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_GT(bench.imaging.chunk->image, 1U);
}

Command region(double camera, double left, double top, double size) {
  Command command;
  command.opcode = kRequestRegion.id;
  command.argument_count = 4;
  command.arguments = {camera, left, top, size};
  return command;
}

TEST(RegionOfACamera, IsItsPixelsOfOneInstantAtFullDepth) {
  for (const bool compress : {false, true}) {
    ImagingParameters parameters;
    parameters.panorama.width = 64;
    parameters.compress = compress;
    ImagingBench bench(parameters);
    bench.take(7, Eigen::Quaterniond::Identity());
    ASSERT_EQ(bench.imaging.receive(region(1, 100, 120, 150), {}).state, CommandOutcome::State::kDone);
    const std::vector<std::uint16_t> pixels = bench.images.pixels[1];
    std::vector<std::uint16_t> levels(150 * 150);
    int rows = 0;
    for (int step = 0; step < 60 && rows < 150; ++step) {
      bench.imaging.step({});
      const ImageChunk& chunk = *bench.imaging.chunk;
      if (!chunk.valid || chunk.kind != ImageKind::kCamera) continue;
      ASSERT_EQ(chunk.first_row, rows);
      EXPECT_EQ(chunk.bits, 12);
      EXPECT_EQ(chunk.scale, ImageScale::kLinear);
      EXPECT_EQ(chunk.frame, 7U);
      ASSERT_TRUE(testing::levels_of(
          chunk, std::span(levels).subspan(std::size_t(rows) * 150, std::size_t{chunk.rows} * 150)));
      rows += chunk.rows;
      bench.take(8, rotation_exp(Eigen::Vector3d(1, 0, 0)));  // what comes later is not in it
    }
    ASSERT_EQ(rows, 150);
    for (int v = 0; v < 150; ++v)
      for (int u = 0; u < 150; ++u)
        ASSERT_EQ(levels[static_cast<std::size_t>(v * 150 + u)],
                  pixels[static_cast<std::size_t>((v + 120) * 341 + u + 100)]);
  }
}

TEST(RegionOfACamera, IsRefusedWithTheValueAtFault) {
  ImagingBench bench(ImagingParameters{});
  const auto fault = [&](const Command& command) {
    const CommandOutcome outcome = bench.imaging.receive(command, {});
    EXPECT_EQ(outcome.state, CommandOutcome::State::kRefused);
    EXPECT_EQ(outcome.reason, CommandReason::kArgumentRange);
    return static_cast<int>(outcome.argument);
  };
  EXPECT_EQ(fault(region(3, 0, 0, 0)), 0) << "there are three cameras";
  EXPECT_EQ(fault(region(0, 256, 0, 10)), 1);
  EXPECT_EQ(fault(region(0, 0, 192, 10)), 2);
  EXPECT_EQ(fault(region(0, 200, 100, 57)), 3);
  EXPECT_EQ(bench.imaging.receive(region(0, 200, 100, 56), {}).state, CommandOutcome::State::kDone);
  EXPECT_EQ(bench.imaging.receive(region(0, 0, 0, 0), {}).state, CommandOutcome::State::kDone) << "all of it";
}

TEST(GreyScale, GivesLightBackWithinHalfALevel) {
  for (const GreyScale& scale :
       {GreyScale{ImageScale::kSquareRoot, 8, 0.25, 0.01}, GreyScale{ImageScale::kLinear, 12, 1, 0},
        GreyScale{ImageScale::kAsinh, 12, 1e4, 0.01}}) {
    for (int level = 1; level <= scale.largest(); ++level)
      ASSERT_EQ(scale.level(scale.light(level)), level) << static_cast<int>(scale.scale);
    EXPECT_EQ(scale.level(10 * scale.most), scale.largest());
    EXPECT_EQ(scale.level(std::numeric_limits<double>::quiet_NaN()), 0);
  }
  // Six decades in 12 bits: a level is a step of less than 0.5 %.
  const GreyScale deep{ImageScale::kAsinh, 12, 1e4, 0.01};
  EXPECT_LT(deep.light(3000) / deep.light(2999) - 1, 0.005);
}

}  // namespace
}  // namespace omma
