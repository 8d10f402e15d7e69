// What `omma solve` says to bad input: exit code 2 and one sentence that names file, line, field, what was
// expected and what was found. And to images with nothing to solve: exit code 1, "no solution" and why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "hal/recorded/image_file.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

class SolveInput : public ::testing::Test {
 protected:
  SolveInput() {
    folder_.write("lens.txt", good_lens());
    write_image("sky.png", [](int, int) { return 20; });
    folder_.write("rig.toml", good_rig());
  }

  static std::string good_lens() {
    return OperatorsFolder::text_of(OMMA_SOURCE_DIR "/config/lenses/cam2_f1.27mm_7.4um_640x480.txt");
  }
  static std::string good_rig() {
    return "name = \"two\"\n"
           "[[camera]]\n"
           "name = \"cam0\"\n"
           "lens = \"lens.txt\"\n"
           "rig_from_camera = { quaternion_xyzw = [0, 0, 0, 1], translation_m = [0, 0, 0] }\n"
           "[[camera]]\n"
           "name = \"cam1\"\n"
           "lens = \"lens.txt\"\n"
           "rig_from_camera = { quaternion_xyzw = [0, 1, 0, 0], translation_m = [0, 0, 0] }\n";
  }

  template <class Grey>
  void write_image(const std::string& name, Grey&& grey, int width = kWidth, int height = kHeight) const {
    Image image;
    image.resize(width, height, PixelFormat::kGrey8);
    auto pixel = image.pixels.begin();
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) *pixel++ = static_cast<std::byte>(grey(u, v));
    }
    write_png(folder_ / name, image.view());
  }

  /// The lens file with `old`, which must be there, replaced.
  void write_lens_with(const std::string& old, const std::string& fresh) const {
    std::string text = good_lens();
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    folder_.write("lens.txt", text.replace(at, old.size(), fresh));
  }

  /// Exit code 2, nothing on standard output, and one sentence with all the parts.
  template <class Matcher>
  void expect_refused(const std::string& arguments, const Matcher& says) const {
    const Told run = folder_.omma("solve " + arguments);
    EXPECT_EQ(run.exit_code, 2) << run.out << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, says);
    EXPECT_THAT(run.err, AllOf(HasSubstr("omma: "), HasSubstr(": expected "), HasSubstr(", found ")));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }

  void expect_no_solution(const std::string& image, const std::string& why) const {
    const std::string arguments = "solve " + image + " --lens lens.txt";
    const Told text = folder_.omma(arguments);
    EXPECT_EQ(text.exit_code, 1) << text.err;
    EXPECT_THAT(text.out, HasSubstr("no solution: " + why));
    const Told json = folder_.omma(arguments + " --json");
    EXPECT_EQ(json.exit_code, 1) << json.err;
    const auto object = nlohmann::json::parse(json.out);
    EXPECT_FALSE(object.at("solved").get<bool>());
    EXPECT_THAT(object.at("reason").get<std::string>(), HasSubstr(why));
    EXPECT_TRUE(object.at("rig_from_j2000").is_null());
    EXPECT_EQ(object.at("stars_used").get<int>(), 0);
  }

  OperatorsFolder folder_;
};

TEST_F(SolveInput, NamesAnImageThatIsMissing) {
  expect_refused("nowhere.png --lens lens.txt",
                 HasSubstr("nowhere.png: file: expected an image, found no such file"));
}

TEST_F(SolveInput, NamesATruncatedImageWhereverItIsCut) {
  const std::string whole = folder_.read("sky.png");
  for (const std::size_t length : {whole.size() - 13, whole.size() / 2, std::size_t{40}}) {
    folder_.write("sky.png", whole.substr(0, length));
    expect_refused("sky.png --lens lens.txt", HasSubstr("sky.png: PNG: expected a whole image"));
  }
}

TEST_F(SolveInput, NamesAnImageThatIsNone) {
  folder_.write("sky.png", "not an image at all, but long enough to look at");
  expect_refused("sky.png --lens lens.txt", HasSubstr("sky.png: file: expected a PNG, JPEG or FITS image"));
}

TEST_F(SolveInput, NamesAnImageOfADepthThatDoesNotExist) {
  std::string bytes = folder_.read("sky.png");
  bytes[24] = 7;  // bits of a sample, in the header chunk: its checksum no longer fits either
  folder_.write("sky.png", bytes);
  expect_refused("sky.png --lens lens.txt", HasSubstr("sky.png: PNG: expected a whole image"));
}

TEST_F(SolveInput, NamesAFitsFileWithADepthThatIsNotAnImage) {
  const auto card = [](std::string text) { return text.append(80 - text.size(), ' '); };
  std::string fits = card("SIMPLE  =                    T") + card("BITPIX  =                   12") +
                     card("NAXIS   =                    2") + card("NAXIS1  =                  640") +
                     card("NAXIS2  =                  480") + card("END");
  fits.resize(2880, ' ');
  fits.resize(2880 + 2880 * 161, '\0');
  folder_.write("sky.fits", fits);
  expect_refused("sky.fits --lens lens.txt", HasSubstr("sky.fits: FITS: expected a whole image"));
}

TEST_F(SolveInput, NamesAnImageWhoseSizeIsNotTheLenss) {
  write_image(
      "small.png", [](int, int) { return 20; }, 320, 240);
  expect_refused("small.png --lens lens.txt",
                 HasSubstr("small.png: image size: expected 640x480 as the lens file says, found 320x240"));
  expect_refused("--rig rig.toml cam0=sky.png cam1=small.png",
                 HasSubstr("small.png: image size: expected 640x480 as the lens file says, found 320x240"));
}

TEST_F(SolveInput, NamesALensFileThatIsMissing) {
  expect_refused("sky.png --lens nowhere.txt", HasSubstr("nowhere.txt: file: expected"));
}

TEST_F(SolveInput, NamesTheRecordThatALensFileLacks) {
  const std::string whole = good_lens();
  folder_.write("lens.txt", whole.substr(0, whole.find("#image size")));
  expect_refused("sky.png --lens lens.txt",
                 HasSubstr("lens.txt:16: image height: expected a number, found the end of the file"));
}

TEST_F(SolveInput, NamesANotANumberInALensFile) {
  write_lens_with("237.800000", "nan");
  expect_refused("sky.png --lens lens.txt",
                 HasSubstr("lens.txt:11: centre row: expected a finite number, found \"nan\""));
}

TEST_F(SolveInput, NamesAZeroFocalLength) {
  write_lens_with("-1.716212014627e+02", "0");
  expect_refused("sky.png --lens lens.txt",
                 HasSubstr("lens.txt:3: polynomial a0: expected a focal length other than zero, found 0"));
}

TEST_F(SolveInput, NamesACameraTheRigDoesNotHave) {
  expect_refused("--rig rig.toml cam0=sky.png cam7=sky.png",
                 HasSubstr("cam7=sky.png: camera: expected a camera of the rig rig.toml, found cam7"));
}

TEST_F(SolveInput, NamesAnImageWithoutACamera) {
  expect_refused("--rig rig.toml sky.png",
                 HasSubstr("sky.png: image: expected CAMERA=FILE when a rig is given, found no camera name"));
}

TEST_F(SolveInput, NamesACameraGivenTwice) {
  expect_refused("--rig rig.toml cam0=sky.png cam0=sky.png",
                 HasSubstr("camera: expected one image for each camera, found cam0 again"));
}

TEST_F(SolveInput, NamesAnUnknownKeyOfARigFileWithItsLine) {
  folder_.write("rig.toml", good_rig() + "colour = \"red\"\n");
  expect_refused("--rig rig.toml cam0=sky.png", AllOf(HasSubstr("rig.toml:10: "), HasSubstr("colour")));
}

TEST_F(SolveInput, NamesALensFileTheRigAsksForInVain) {
  std::filesystem::remove(folder_ / "lens.txt");
  expect_refused("--rig rig.toml cam0=sky.png", HasSubstr("lens.txt: file: expected"));
}

TEST_F(SolveInput, NamesAnEpochOrASiteThatCannotBeRead) {
  expect_refused("sky.png --lens lens.txt --epoch yesterday",
                 AllOf(HasSubstr("epoch"), HasSubstr("yesterday")));
  expect_refused("sky.png --lens lens.txt --epoch 2020-12-11T20:09:33Z --site 91,0,0", HasSubstr("91"));
  expect_refused("sky.png --lens lens.txt --site 78,16,0", HasSubstr("--site: expected --epoch with it"));
}

TEST_F(SolveInput, NamesAHintThatCannotBeRead) {
  for (const char* hint : {"orion", "83,-5", "83,-5,10,2", "83,-95,10", "361,0,10", "83,-5,0", "83,-5,nan"})
    expect_refused("sky.png --lens lens.txt --near " + std::string(hint),
                   AllOf(HasSubstr("arguments: --near: expected RA,DEC,RADIUS in degrees"),
                         HasSubstr("found \"" + std::string(hint) + "\"")));
}

TEST_F(SolveInput, AsksForOneSourceOfTheLens) {
  expect_refused("sky.png", HasSubstr("lens: expected one of --lens, --rig and --fov, found none"));
  expect_refused("sky.png --lens lens.txt --fov 60",
                 HasSubstr("lens: expected one of --lens, --rig and --fov, found 2 of them"));
  expect_refused("sky.png sky.png sky.png --lens lens.txt lens.txt",
                 HasSubstr("--lens: expected one lens file, or one for each image, found 2 for 3 images"));
}

TEST_F(SolveInput, RefusesAnOptionItDoesNotKnow) {
  const Told run = folder_.omma("solve sky.png --lens lens.txt --colour");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--colour"));
}

TEST_F(SolveInput, FindsNothingInABlackImage) {
  write_image("sky.png", [](int, int) { return 0; });
  expect_no_solution("sky.png", "too few dots (0)");
}

TEST_F(SolveInput, FindsNothingInAWhiteImage) {
  write_image("sky.png", [](int, int) { return 255; });
  expect_no_solution("sky.png", "too few dots (0)");
}

TEST_F(SolveInput, FindsNothingInPureNoise) {
  std::mt19937 random(5);
  const auto noise = [&](double mean, double sigma) {
    // Box–Muller, so that the test's image is the same with every standard library.
    const double u = (double(random()) + 1) / 4294967297.0;
    const double v = double(random()) / 4294967296.0;
    return std::clamp(mean + sigma * std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v), 0.0, 255.0);
  };
  for (const double sigma : {1.0, 4.0, 25.0}) {
    write_image("sky.png", [&](int, int) { return static_cast<int>(noise(40, sigma)); });
    const Told run = folder_.omma("solve sky.png --lens lens.txt --json");
    EXPECT_EQ(run.exit_code, 1) << run.err;
    const auto object = nlohmann::json::parse(run.out);
    EXPECT_FALSE(object.at("solved").get<bool>());
    EXPECT_NE(object.at("reason").get<std::string>(), "");
  }
}

TEST_F(SolveInput, OneImageOfARigThatShowsNothingIsNoSolution) {
  const Told run = folder_.omma("solve --rig rig.toml cam1=sky.png --json");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  const auto object = nlohmann::json::parse(run.out);
  EXPECT_EQ(object.at("cameras").size(), 2u);
  EXPECT_THAT(object.at("reason").get<std::string>(), HasSubstr("too few dots"));
}

}  // namespace
}  // namespace omma
