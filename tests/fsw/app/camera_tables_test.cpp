// The tables of one camera are read whole or refused with one sentence: file, line, field, expected, found.
#include "fsw/app/camera_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "components/sensor/black_frame_file.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/components/geometry/temporary_file.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

const Lens kLens = Lens::equidistant(120, 80, 40, {59.5, 39.5}, 1.6);

struct Tables {
  ExtractorCamera dots;
  double read_noise_e = 5;
  ExposureParameters exposure;
};

Tables read(const std::string& text) {
  const TemporaryFile file("camera.toml", text);
  const TomlTable table = TomlTable::read(file.path());
  Tables tables;
  tables.dots.width = kLens.width();
  tables.dots.height = kLens.height();
  read_extractors(table, tables.dots);
  read_sensor(table, kLens, tables.dots, tables.read_noise_e);
  read_mask(table, kLens, tables.dots);
  tables.exposure = read_exposure(table);
  return tables;
}

void expect_refused(const std::string& text, const std::string& sentence) {
  const std::string message = refusal_of([&] { read(text); });
  EXPECT_THAT(message, HasSubstr(sentence)) << text;
  EXPECT_THAT(message, HasSubstr("camera.toml:1: ")) << text;
}

TEST(CameraTables, AreAllOptional) {
  const Tables tables = read("");
  EXPECT_FALSE(tables.dots.mask.any());
  EXPECT_FALSE(tables.dots.glare.has_value());
  EXPECT_TRUE(tables.dots.sensor.black.empty());
  EXPECT_FALSE(tables.exposure.automatic);
}

TEST(CameraTables, ChooseTheExtractorByWhatIsLookedFor) {
  EXPECT_LT(read("extractor = { for = \"stars\" }").dots.parameters.max_diameter,
            read("extractor = { for = \"targets\" }").dots.parameters.max_diameter);
  EXPECT_EQ(read("extractor = { for = \"targets\", polarity = \"dark\", max_diameter_px = 33 }")
                .dots.parameters.max_diameter,
            33);
  expect_refused("extractor = { for = \"planes\" }",
                 "extractor.for: expected \"stars\", \"targets\" or \"all\", found planes");
  expect_refused("extractor = { polarity = \"grey\" }", "extractor.polarity: expected \"bright\"");
  expect_refused("extractor = { threshold = 0.5 }", "extractor.threshold: expected a number from 1 to 100");
  expect_refused("extractor = { sharpness = 3 }", "extractor.sharpness: expected one of");
}

TEST(CameraTables, ChooseAPipelineForEachKindOfThing) {
  const Tables tables = read(
      "extractor = { for = \"stars\", algorithm = \"stars\", gain_e_per_level = 2 }\n"
      "[[also_extractor]]\nfor = \"targets\"\nalgorithm = \"mlas\"\nlocal_window_px = 41\n");
  EXPECT_EQ(tables.dots.parameters.algorithm, ExtractorAlgorithm::kStars);
  EXPECT_EQ(tables.dots.parameters.classical.deviations, 3.5);
  ASSERT_EQ(tables.dots.also.size(), 1U);
  EXPECT_EQ(tables.dots.also[0].algorithm, ExtractorAlgorithm::kMlas);
  EXPECT_EQ(tables.dots.also[0].classical.window, 41);
  EXPECT_GT(tables.dots.also[0].max_diameter, tables.dots.parameters.max_diameter);
  EXPECT_EQ(read("extractor = { algorithm = \"omma\" }").dots.parameters.algorithm,
            ExtractorAlgorithm::kMatched);
}

TEST(CameraTables, RefuseAPipelineThatIsNoneOrKeysOfAnother) {
  expect_refused(
      "extractor = { algorithm = \"sobel\" }",
      "extractor.algorithm: expected \"omma\", \"mlas\", \"small-target\" or \"stars\", found sobel");
  expect_refused("extractor = { algorithm = 4 }", "extractor.algorithm: expected");
  expect_refused(
      "extractor = { local_window_px = 31 }",
      "extractor.local_window_px: expected an algorithm of \"mlas\", \"small-target\" or \"stars\" with "
      "it, found algorithm = \"omma\"");
  expect_refused(
      "extractor = { algorithm = \"mlas\", threshold = 5 }",
      "extractor.threshold: expected an algorithm of \"omma\" with it, found algorithm = \"mlas\"");
  expect_refused("extractor = { algorithm = \"mlas\", local_window_px = 30 }",
                 "extractor.local_window_px: expected an odd number of pixels, found 30");
  expect_refused("extractor = { algorithm = \"mlas\", local_deviations = 99 }",
                 "extractor.local_deviations: expected a number from -5 to 50");
  expect_refused("also_extractor = [ { gain_e_per_level = 2 } ]",
                 "also_extractor[0].gain_e_per_level: expected it in the camera's `extractor` table");
  expect_refused("also_extractor = [ {}, {}, {}, {} ]", "also_extractor: expected at most 3 tables, found 4");
  expect_refused("also_extractor = { for = \"stars\" }",
                 "also_extractor: expected [[also_extractor]] tables");
}

TEST(CameraTables, PutMasksTogether) {
  const Tables tables = read(
      "[mask]\nbeyond_deg = 60\nboxes = [100, 0, 119, 10, 0, 70, 20, 79]\ngrow_px = 1\nglare = { margin = 1 "
      "}\n"
      "[[mask.polygon]]\ncorners = [50, 30, 70, 30, 60, 50]\n");
  const PixelMask& mask = tables.dots.mask;
  EXPECT_TRUE(mask.at(99, 11) && mask.at(21, 69) && mask.at(60, 40) && mask.at(0, 0));
  EXPECT_FALSE(mask.at(40, 40));
  ASSERT_TRUE(tables.dots.glare.has_value());
  EXPECT_EQ(tables.dots.glare->margin, 1);
}

TEST(CameraTables, RefuseMasksThatAreNone) {
  expect_refused("mask = { boxes = [1, 2, 3] }", "mask.boxes: expected an array of numbers, 4 to each");
  expect_refused("mask = { boxes = [9, 0, 3, 5] }", "mask.boxes: expected left, top, right and bottom");
  expect_refused("mask = { boxes = [\"a\", 2, 3, 4] }", "mask.boxes: expected an array of numbers");
  expect_refused("mask = { polygon = [ { corners = [1, 2, 3, 4] } ] }", "corners: expected u and v of three");
  expect_refused("mask = { beyond_deg = 0 }", "mask.beyond_deg: expected a number from 1 to 180");
  expect_refused("mask = { boxes = [0, 0, 119, 79] }", "mask: expected a camera that still sees something");
  expect_refused("mask = { glare = { bright = 2 } }", "mask.glare.bright: expected a number from 0.05 to 1");
  expect_refused("mask = { shadow = 1 }", "mask.shadow: expected one of");
  EXPECT_THAT(refusal_of([] { read("mask = { picture = \"none.png\" }"); }), HasSubstr("none.png"));
}

TEST(CameraTables, TakePicturesAndBlackFramesOfTheLensesSizeOnly) {
  Image picture;
  picture.resize(16, 16, PixelFormat::kGrey8);
  const std::filesystem::path folder = testing::TempDir();
  write_png(folder / "camera_tables_mask.png", picture.view());
  BlackFrame black;
  black.width = black.height = 4;
  black.frames = 3;
  black.mean.assign(16, 20);
  black.noise.assign(16, 1);
  black.hot = PixelMask(4, 4);
  write_black_frame(folder / "camera_tables_black.fits", black);
  expect_refused("mask = { picture = \"" + (folder / "camera_tables_mask.png").string() + "\" }",
                 "mask.picture: expected 120 x 80 pixels, as the lens, found 16 x 16 pixels");
  expect_refused("sensor = { black_frame = \"" + (folder / "camera_tables_black.fits").string() + "\" }",
                 "sensor.black_frame: expected 120 x 80 pixels, as the lens, found 4 x 4 pixels");
}

TEST(CameraTables, TakeAResponseWithItsNoise) {
  std::string curve;
  for (int grey = 0; grey <= 255; grey += 5)
    curve += std::to_string(grey) + " " + std::to_string(std::exp(grey / 40.0)) + "\n";
  const TemporaryFile file("response.tsv", curve);
  const Tables tables = read("sensor = { response = \"" + file.path() + "\", fill_factor = 0.5 }");
  EXPECT_FALSE(tables.dots.sensor.response.empty());
  EXPECT_GT(tables.dots.parameters.relative_noise, 0.01F);
  EXPECT_EQ(tables.dots.parameters.fill_factor, 0.5F);
}

TEST(CameraTables, RefuseSensorsThatAreNone) {
  expect_refused("sensor = { fill_factor = 0 }", "sensor.fill_factor: expected a number from 0.01 to 1");
  expect_refused("sensor = { relative_illumination = [0.9, 0.5] }",
                 "sensor.relative_illumination: expected shares");
  expect_refused("sensor = { relative_illumination = [] }",
                 "sensor.relative_illumination: expected an array");
  expect_refused("sensor = { dark = 1 }", "sensor.dark: expected one of");
  EXPECT_THAT(refusal_of([] { read("sensor = { black_frame = \"none.fits\" }"); }), HasSubstr("none.fits"));
  EXPECT_THAT(refusal_of([] { read("sensor = { response = \"none.tsv\" }"); }), HasSubstr("none.tsv"));
}

TEST(CameraTables, LimitTheExposure) {
  const ExposureParameters p = read("exposure = { longest_ms = 20, most_gain = 8 }").exposure;
  EXPECT_TRUE(p.automatic);
  EXPECT_EQ(p.longest_ns, 20'000'000);
  expect_refused("exposure = { shortest_ms = 5, longest_ms = 1 }",
                 "exposure.longest_ms: expected no less than");
  expect_refused("exposure = { target = 0.5 }", "exposure.target: expected a number between dark and bright");
  expect_refused("exposure = { automatic = 3 }", "exposure.automatic: expected true or false");
  expect_refused("exposure = { iso = 100 }", "exposure.iso: expected one of");
}

TEST(CameraTables, TakeABracketAndRefuseOneThatIsNone) {
  const Tables tables = read("exposure = { bracket_ms = [0.5, 20] }\nsensor = { read_noise_e = 3 }");
  ASSERT_EQ(tables.exposure.bracket_ns.size(), 2U);
  EXPECT_EQ(tables.exposure.bracket_ns[0], 500'000);
  EXPECT_FALSE(tables.exposure.automatic);
  EXPECT_EQ(tables.read_noise_e, 3);
  expect_refused("exposure = { bracket_ms = [0.5] }",
                 "exposure.bracket_ms: expected 2 to 4 exposures, found 1");
  expect_refused("exposure = { bracket_ms = [1, 2, 3, 4, 5] }",
                 "exposure.bracket_ms: expected 2 to 4 exposures, found 5");
  expect_refused("exposure = { bracket_ms = [1, 0] }",
                 "exposure.bracket_ms: expected exposures from 0.001 to 60000 ms");
  expect_refused("exposure = { automatic = true, bracket_ms = [1, 2] }",
                 "exposure.bracket_ms: expected automatic exposure or a bracket, not both");
  expect_refused("sensor = { read_noise_e = 0 }", "sensor.read_noise_e: expected a number from 0.1 to 10000");
}

}  // namespace
}  // namespace omma
