// Target databases: what is right is read, what is wrong is named with its line and field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "components/catalogue/target_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

std::string error_of(const std::string& text) {
  return refusal_of([&] { targets_from_text(text, "card.tsv"); });
}

TEST(TargetFile, IsReadWithAndWithoutHeader) {
  const std::string rows = "T01\t-0.1071\t0.0758\t0.03\t1\t1\r\n# a remark\n\nT02\t0\t1e-2\t+0.5\t2\t0\n";
  for (const std::string& text : {rows, "id\tx\ty\tz\tgroup\ttype\n" + rows}) {
    const TargetBody body = targets_from_text(text, "card.tsv");
    ASSERT_EQ(body.targets.size(), 2U);
    EXPECT_EQ(body.targets[0].id.view(), "T01");
    EXPECT_DOUBLE_EQ(body.targets[0].position.x(), -0.1071);
    EXPECT_DOUBLE_EQ(body.targets[1].position.z(), 0.5);
    EXPECT_EQ(body.targets[1].group, 2);
    EXPECT_EQ(body.targets[1].type, 0);
  }
}

TEST(TargetFile, WrongEntriesAreNamedWithTheirLine) {
  const std::string good = "T01\t0\t0\t0\t1\t1\n";
  EXPECT_THAT(error_of(good + "\t0\t1\t0\t1\t1\n"),
              HasSubstr("card.tsv:2: id: expected a name, found nothing"));
  EXPECT_THAT(error_of(good + "T01\t0\t1\t0\t1\t1\n"),
              HasSubstr("card.tsv:2: id: expected an id no other target has, found \"T01\""));
  EXPECT_THAT(error_of(good + "T02\tnan\t1\t0\t1\t1\n"),
              HasSubstr("card.tsv:2: x: expected a finite number of metres, found \"nan\""));
  EXPECT_THAT(error_of(good + "T02\t0\t0,1\t0\t1\t1\n"), HasSubstr("card.tsv:2: y"));
  EXPECT_THAT(error_of(good + "T02\t0\t0.1\tinf\t1\t1\n"), HasSubstr("card.tsv:2: z"));
  EXPECT_THAT(error_of(good + "T02\t0\t0.1\t0\t1.5\t1\n"),
              HasSubstr("card.tsv:2: group: expected a whole number"));
  EXPECT_THAT(error_of(good + "T02\t0\t0.1\t0\t1\t7\n"), HasSubstr("card.tsv:2: type"));
  EXPECT_THAT(error_of(good + "T02 0 0.1 0 1 1\n"),
              HasSubstr("card.tsv:2: target: expected 6 fields between tabs: id x y z group type (or 9, with "
                        "a normal nx ny nz; or one more, with a blinking code), found 1"));
  EXPECT_THAT(error_of(good + "T02\t0\t0.1\t0\t1\n"), HasSubstr("found 5"));
  EXPECT_THAT(error_of(std::string(40, 'T') + "\t0\t0.1\t0\t1\t1\n"), HasSubstr("limits::kNameLength"));
  EXPECT_THAT(error_of("id\tx\ty\tz\tgroup\ttype\n"),
              HasSubstr("targets: expected at least one, found none"));
  EXPECT_THAT(error_of(""), HasSubstr("expected at least one"));
}

TEST(TargetFile, MoreTargetsThanTheLimitAreRefusedByItsName) {
  std::string text;
  for (std::size_t i = 0; i <= limits::kTargetsPerBody; ++i)
    text += "T" + std::to_string(i) + "\t0\t0\t0\t1\t1\n";
  EXPECT_THAT(error_of(text),
              HasSubstr("card.tsv:65: targets: expected at most 64 (limits::kTargetsPerBody)"));
}

TEST(TargetFile, FacesMayHaveNormals) {
  const TargetBody body = targets_from_text("A\t0\t0\t1\t1\t1\t0\t0\t2\nB\t0\t0\t0\t1\t1\n", "box.tsv");
  EXPECT_EQ(body.targets[0].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_TRUE(faces(body.targets[0], {0, 0, 3}));
  EXPECT_FALSE(faces(body.targets[0], {0, 0, -3}));
  EXPECT_FALSE(faces(body.targets[0], {50, 0, 2}));  // grazing
  EXPECT_TRUE(faces(body.targets[1], {0, 0, -3}));   // no normal: from all sides
  EXPECT_THAT(error_of("A\t0\t0\t1\t1\t1\t0\t0\t0\n"),
              HasSubstr("card.tsv:1: nx: expected a normal that is not zero"));
  EXPECT_THAT(error_of("A\t0\t0\t1\t1\t1\t0\t0\tup\n"),
              HasSubstr("card.tsv:1: nz: expected a finite number"));
}

TEST(TargetFile, LightsMayBlink) {
  const TargetBody body = targets_from_text(
      "A\t0\t0\t1\t1\t1\t0\t0\t2\t1101101010101010\nB\t0\t1\t0\t1\t1\t1101110101101010\nC\t1\t1\t0\t1\t1\n",
      "box.tsv");
  EXPECT_EQ(body.targets[0].code.length, 16);
  EXPECT_EQ(body.targets[0].normal.z(), 1);
  EXPECT_TRUE(body.targets[1].code.lit(0));
  EXPECT_FALSE(body.targets[1].code.lit(2));
  EXPECT_FALSE(body.targets[1].code.lit(18));
  EXPECT_FALSE(body.targets[2].code.blinks());
  EXPECT_TRUE(body.targets[2].code.lit(2));
}

TEST(TargetFile, CodesThatTellNothingAreRefused) {
  const auto told = [](const std::string& code) {
    return error_of("A\t0\t0\t1\t1\t1\t1101101010101010\nB\t0\t1\t0\t1\t1\t" + code + "\n");
  };
  EXPECT_THAT(told("110"), HasSubstr("card.tsv:2: code: expected 8 to 32 characters 0 or 1"));
  EXPECT_THAT(told("11x1101010101010"), HasSubstr("expected 8 to 32 characters 0 or 1"));
  EXPECT_THAT(told("1001110101101010"), HasSubstr("two zeros at least, and none beside another"));
  EXPECT_THAT(told("0111111111111110"), HasSubstr("none beside another"));
  EXPECT_THAT(told("1010101010101010"), HasSubstr("differs from itself turned by a phase"));
  EXPECT_THAT(told("11011101"), HasSubstr("differs from itself turned by a phase"));
  EXPECT_THAT(told("1101110101"), HasSubstr("expected as many bits as A has, 16"));
  EXPECT_THAT(told("1011011010101010"), HasSubstr("differs from that of A in two bits at every phase"));
}

TEST(TargetFile, MissingFileIsNamed) {
  EXPECT_THROW(read_target_file("/no/such/card.tsv"), InputError);
}

TEST(TargetFile, OfTheProjectIsRead) {
  const TargetBody body = read_target_file(std::string(OMMA_SOURCE_DIR) + "/config/targets/docking_card.tsv");
  EXPECT_EQ(body.targets.size(), 25U);
}

}  // namespace
}  // namespace omma
