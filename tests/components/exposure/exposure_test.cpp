// Automatic exposure in a closed loop with a made camera: it takes light, rounds and clips it, and takes up
// settings some frames late.
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "components/exposure/exposure.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

constexpr int kWidth = 128, kHeight = 96;

class MadeCamera final : public CameraDriver {
 public:
  double light = 2;       // of the sky [grey levels a ms at gain 1]
  double lamp_share = 0;  // of the image, so bright that it is full at any setting but a fiftieth
  int delay = 2;          // frames until settings are in effect
  bool tells = true;      // which settings a frame was taken with
  SettingsResult answer = SettingsResult::kAccepted;
  int asked = 0;
  CameraSettingsRange range{{100'000, 1, 0}, {50'000'000, 16, 60}};

  std::string_view driver_name() const override { return "made"; }
  CameraSettingsRange settings_range() const noexcept override { return range; }
  SettingsResult apply(const CameraSettings& settings) noexcept override {
    ++asked;
    EXPECT_GE(settings.exposure_ns, range.least.exposure_ns);
    EXPECT_LE(settings.exposure_ns, range.most.exposure_ns);
    EXPECT_GE(settings.gain, range.least.gain);
    EXPECT_LE(settings.gain, range.most.gain);
    EXPECT_GE(settings.black_level, range.least.black_level);
    EXPECT_LE(settings.black_level, range.most.black_level);
    if (answer == SettingsResult::kAccepted) coming_.push_back({delay, settings});
    return answer;
  }
  Frame grab(std::uint64_t number, TimeNs time_ns) noexcept override {
    for (auto& [left, settings] : coming_) {
      if (left-- == 0) now_ = settings;
    }
    while (!coming_.empty() && coming_.front().first < 0) coming_.pop_front();
    render();
    return {image_.view(), number, time_ns, FrameStatus::kFresh, tells ? now_ : CameraSettings{}};
  }
  const CameraSettings& settings() const { return now_; }

 private:
  void render() {
    image_.resize(kWidth, kHeight, PixelFormat::kGrey8);
    const double amplification =
        1e-6 * static_cast<double>(now_.exposure_ns) * static_cast<double>(now_.gain);
    std::normal_distribution<double> noise(0, 0.5 * std::sqrt(static_cast<double>(now_.gain)));
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const bool lamp = i % kWidth < lamp_share * kWidth;
      const double grey =
          static_cast<double>(now_.black_level) + amplification * (lamp ? 400 : light) + noise(random_);
      image_.pixels[static_cast<std::size_t>(i)] =
          static_cast<std::byte>(static_cast<int>(std::clamp(std::round(grey), 0.0, 255.0)));
    }
  }

  std::mt19937_64 random_{5};
  std::deque<std::pair<int, CameraSettings>> coming_;
  CameraSettings now_{1'000'000, 1, 0};
  Image image_;
};

struct Loop {
  explicit Loop(MadeCamera& made, ExposureParameters parameters = {}) : camera(made) {
    parameters.automatic = parameters.bracket_ns.empty();
    CameraDriver* driver = &camera;
    exposure = std::make_unique<Exposure>(std::span(&driver, 1), std::span(&parameters, 1), events);
    frames->cameras.resize(1);
    exposure->frames.bind(frames);
  }
  void run(int count) {
    for (int k = 0; k < count; ++k, ++number) {
      frames->number = number;
      frames->cameras[0] = camera.grab(number, 0);
      exposure->step({number, 0});
    }
  }
  const CameraExposure& told() const { return exposure->report->cameras[0]; }
  double background() const {
    return (told().seen.level - static_cast<double>(told().settings.black_level)) / 255;
  }

  MadeCamera& camera;
  Events events;
  Out<Frames> frames;
  std::unique_ptr<Exposure> exposure;
  std::uint64_t number = 0;
};

TEST(Exposure, ABracketTakesItsExposuresInTurn) {
  MadeCamera camera;
  ExposureParameters parameters;
  parameters.bracket_ns.push_back(200'000);
  parameters.bracket_ns.push_back(1'000'000);
  parameters.bracket_ns.push_back(20'000'000);
  Loop loop(camera, parameters);
  loop.run(10);
  for (int k = 0; k < 12; ++k) {
    const TimeNs before = camera.settings().exposure_ns;
    loop.run(1);
    const TimeNs now = camera.settings().exposure_ns;
    EXPECT_EQ(now, before == 200'000 ? 1'000'000 : before == 1'000'000 ? 20'000'000 : 200'000);
  }
  EXPECT_EQ(loop.told().state, ExposureState::kBracket);
  camera.answer = SettingsResult::kNoControl;
  loop.run(2);
  EXPECT_EQ(loop.told().state, ExposureState::kGood);
  EXPECT_EQ(loop.told().refused, 1U) << "asked no more";
}

TEST(Exposure, LeadsABrightSkyAndADarkOneIntoTheBoundsAndRests) {
  for (const bool tells : {true, false}) {
    for (const double light : {0.02, 0.3, 3.0, 60.0}) {
      MadeCamera camera;
      camera.light = light;
      camera.tells = tells;
      Loop loop(camera);
      loop.run(60);
      const ExposureParameters p;
      EXPECT_TRUE(loop.told().seen.noise >= p.enough_noise || loop.background() >= p.dark) << light;
      EXPECT_LE(loop.background(), p.bright) << light;
      EXPECT_EQ(loop.told().state, ExposureState::kGood) << light;
      const int asked = camera.asked;
      loop.run(100);
      EXPECT_EQ(camera.asked, asked) << "it hunts at light " << light;
    }
  }
}

TEST(Exposure, FollowsAChangeOfLightAndStaysWithinOneOfAFewPerCent) {
  MadeCamera camera;
  camera.light = 0.3;
  Loop loop(camera);
  loop.run(60);
  const int asked = camera.asked;
  camera.light *= 1.03;
  loop.run(50);
  EXPECT_EQ(camera.asked, asked);
  camera.light *= 40;
  loop.run(60);
  EXPECT_GT(camera.asked, asked);
  EXPECT_LE(loop.background(), ExposureParameters{}.bright);
}

TEST(Exposure, GivesTimeBeforeGain) {
  MadeCamera camera;
  camera.light = 0.3;
  Loop loop(camera);
  loop.run(60);
  EXPECT_EQ(loop.told().settings.exposure_ns, camera.range.most.exposure_ns);
  camera.light = 30;
  loop.run(60);
  EXPECT_EQ(loop.told().settings.gain, camera.range.least.gain);
}

TEST(Exposure, RaisesTheBlackLevelUntilNoiseIsNotCutOff) {
  MadeCamera camera;
  camera.light = 0.001;
  Loop loop(camera);
  loop.run(100);
  EXPECT_LT(loop.told().seen.clipped, 0.01);
  EXPECT_GT(loop.told().seen.level, 3 * loop.told().seen.noise);
}

TEST(Exposure, DoesNotSwingWhereALampIsInView) {
  MadeCamera camera;
  camera.light = 0.01;
  camera.lamp_share = 0.1;
  Loop loop(camera);
  loop.run(60);
  EXPECT_LE(loop.told().seen.full, ExposureParameters{}.most_full);
  const int asked = camera.asked;
  loop.run(2 * ExposureParameters{}.patience);
  EXPECT_LE(camera.asked - asked, 2 * 3);  // once in its patience it tries: up, full, down
}

TEST(Exposure, SaysOnceThatThereIsNothingLeftToTurn) {
  MadeCamera camera;
  camera.light = 5000;
  Loop loop(camera);
  loop.run(80);
  EXPECT_EQ(loop.told().state, ExposureState::kAtLimit);
  int events = 0;
  for (EventRecord record; loop.events.take(record);) events += record.id == kExposureAtLimit.id ? 1 : 0;
  EXPECT_EQ(events, 1);
}

TEST(Exposure, LeavesACameraWithoutControlAloneAndSaysSo) {
  MadeCamera camera;
  camera.answer = SettingsResult::kNoControl;
  Loop loop(camera);
  loop.run(20);
  EXPECT_EQ(camera.asked, 1);
  EXPECT_FALSE(loop.told().automatic);
  EventRecord record;
  ASSERT_TRUE(loop.events.take(record));
  EXPECT_EQ(record.id, kExposureRefused.id);
}

TEST(Exposure, KeepsWhatWasWhereACameraFailsAndGivesUpAfterSomeTimes) {
  MadeCamera camera;
  Loop loop(camera);
  loop.run(40);
  const CameraSettings before = loop.told().settings;
  camera.answer = SettingsResult::kFailed;
  camera.light = 300;
  loop.run(200);
  EXPECT_EQ(loop.told().settings, before);
  EXPECT_EQ(loop.told().refused, 5U);
  EXPECT_FALSE(loop.told().automatic);
}

TEST(Exposure, TakesNothingFromAMissingOrEmptyFrame) {
  MadeCamera camera;
  Loop loop(camera);
  loop.run(30);
  const int asked = camera.asked;
  for (int k = 0; k < 20; ++k) {
    loop.frames->cameras[0] = {};
    loop.exposure->step({loop.number++, 0});
  }
  EXPECT_EQ(camera.asked, asked);
}

}  // namespace
}  // namespace omma
