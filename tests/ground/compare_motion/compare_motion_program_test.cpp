// `omma compare-motion` as a user runs it, and its bad input.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/ground/run_omma.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

std::string table(double turn) {
  std::string text = "time_s,qx,qy,qz,qw\n";
  for (int k = 0; k < 50; ++k) {
    const double half = 0.5 * (turn + 0.2 * std::sin(0.3 * k));
    text += std::to_string(k) + ",0,0," + std::to_string(std::sin(half)) + "," +
            std::to_string(std::cos(half)) + "\n";
  }
  return text;
}

TEST(CompareMotion, TellsTheMisalignmentOfTwoTables) {
  const OperatorsFolder folder;
  folder.write("a.csv", table(0.1));
  folder.write("b.csv", table(0));
  const Told told = folder.omma("compare-motion a.csv b.csv --align left --output out");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("length 5.7296"));  // 0.1 rad
  EXPECT_THAT(folder.read("out/motion.html"), HasSubstr("as given"));
  EXPECT_THAT(folder.read("out/motion.json"), HasSubstr("time_offset_s"));
}

TEST(CompareMotion, RefusesWhatItCannotRead) {
  const OperatorsFolder folder;
  folder.write("good.csv", table(0));
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("compare-motion good.csv " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
  };
  refused("none.csv", "none.csv: file: expected a log");
  refused("none.mcap", "none.mcap");
  refused("none.jsonl", "none.jsonl");
  folder.write("heading.csv", "t,x\n");
  refused("heading.csv", "heading.csv:1: heading");
  folder.write("word.csv", "time_s,qx,qy,qz,qw\n0,0,0,zero,1\n");
  refused("word.csv", "word.csv:2: column 4: expected a number");
  folder.write("short.csv", "time_s,qx,qy,qz,qw\n0,0,0,1\n");
  refused("short.csv", "short.csv:2: columns: expected 5, found 4");
  folder.write("long.csv", "time_s,qx,qy,qz,qw\n0,0,0,1,1\n");
  refused("long.csv", "a quaternion of length 1");
  folder.write("back.csv", "time_s,qx,qy,qz,qw\n1,0,0,0,1\n1,0,0,0,1\n");
  refused("back.csv", "back.csv:3: time");
  folder.write("few.csv", "time_s,qx,qy,qz,qw\n1,0,0,0,1\n");
  refused("few.csv", "at least three samples");
  folder.write("later.csv", "time_s,qx,qy,qz,qw\n100,0,0,0,1\n101,0,0,0,1\n102,0,0,0,1\n");
  refused("later.csv", "at least three moments");
  folder.write("chain.toml", "[[left]]\nquaternion_xyzw = [0, 0, 1, 1]\n");
  refused("good.csv --transforms chain.toml", "a quaternion of length 1");
  folder.write("other.toml", "[[middle]]\nquaternion_xyzw = [0, 0, 0, 1]\n");
  refused("good.csv --transforms other.toml", "middle");
}

}  // namespace
}  // namespace omma
