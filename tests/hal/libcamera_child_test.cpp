// The process that libcamera runs in, as far as it goes without libcamera: lines there and back, what happens
// when it ends, and the setup that is handed over. With cameras: `./test hil libcamera`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/child_process.hpp"
#include "hal/libcamera/setup_words.hpp"

namespace omma {
namespace {

TEST(ChildProcess, AnswersLinesUntilItIsEnded) {
  ChildProcess cat;
  ASSERT_EQ(cat.start("cat"), 0);
  for (const std::string line : {"one", "two\tand three", ""}) {
    ASSERT_TRUE(cat.write_line(line));
    EXPECT_EQ(cat.read_line(10'000), line);
  }
  EXPECT_FALSE(cat.read_line(10));  // nothing more comes
  cat.end();
  EXPECT_FALSE(cat.write_line("four"));
}

TEST(ChildProcess, ThatEndsByItselfIsNoticedAndAnotherMayBeStarted) {
  ChildProcess process;
  ASSERT_EQ(process.start("true"), 0);
  EXPECT_FALSE(process.read_line(10'000));
  process.write_line("is it there");  // no signal ends this program
  ASSERT_EQ(process.start("cat"), 0);
  ASSERT_TRUE(process.write_line("again"));
  EXPECT_EQ(process.read_line(10'000), "again");
}

TEST(ChildProcess, OfAProgramThatIsNotThereSaysSo) {
  EXPECT_EQ(ChildProcess().start("omma-no-such-program"), ENOENT);
}

TEST(CameraSetupWords, GiveTheSameSetup) {
  CameraSetup setup{.where = "lab.toml: camera[1]",
                    .device = "/base/i2c0/imx219@10",
                    .format = "BG10",
                    .width = 640,
                    .height = 480};
  setup.bayer = BayerUse::kGreen;
  setup.bits = 10;
  setup.buffers = 6;
  setup.controls = {{"exposure", "500"}, {"trigger", "a=b"}};
  setup.control_names = {{"exposure", "ExposureTime"}};
  const CameraSetup back = setup_of_words(words_of(setup));
  EXPECT_EQ(words_of(back), words_of(setup));
  EXPECT_EQ(back.where, setup.where);
  EXPECT_EQ(back.device, setup.device);
  EXPECT_EQ(back.width, 640);
  EXPECT_EQ(back.bayer, BayerUse::kGreen);
  EXPECT_EQ(back.controls[1].value, "a=b");
  EXPECT_EQ(back.control_names[0].value, "ExposureTime");
}

TEST(CameraSetupWords, ThatAreNoneOfASetupAreNamed) {
  for (const std::string word : {"zoom=3", "width=12px", "width", "control=gain"}) {
    try {
      setup_of_words({word});
      ADD_FAILURE() << word;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "omma-libcamera: setup: expected key=value of a camera's setup, found " + word);
    }
  }
}

}  // namespace
}  // namespace omma
