// `omma card` as a user runs it: a card drawn, read back, and checked; and bad input.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "components/catalogue/target_file.hpp"
#include "ground/draw/canvas.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kCard = OMMA_SOURCE_DIR "/config/targets/docking_card.tsv";

// Both cards about the middle of their discs, each target's nearest in the other.
double largest_gap_mm(const TargetBody& a, const TargetBody& b) {
  const auto middle = [](const TargetBody& body) {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
    Eigen::Vector2d high = -low;
    for (const Target& t : body.targets) {
      low = low.cwiseMin(t.position.head<2>());
      high = high.cwiseMax(t.position.head<2>());
    }
    return Eigen::Vector2d(0.5 * (low + high));
  };
  const Eigen::Vector2d shift = middle(b) - middle(a);
  double largest = 0;
  for (const Target& t : a.targets) {
    double nearest = 1e9;
    for (const Target& o : b.targets)
      nearest = std::min(nearest, (t.position.head<2>() + shift - o.position.head<2>()).norm());
    largest = std::max(largest, nearest);
  }
  return 1e3 * largest;
}

TEST(CardProgram, DrawsACardThatReadsBackWithinAFiftiethOfAMillimetre) {
  const OperatorsFolder folder;
  for (const std::string labels : {"", " --labels"}) {
    ASSERT_EQ(folder.omma("card draw " + kCard + " --out card.png --dpi 200" + labels).exit_code, 0);
    const Told told = folder.omma("card read card.png --dpi 200 --out back.tsv");
    ASSERT_EQ(told.exit_code, 0) << told.err;
    EXPECT_THAT(told.err, HasSubstr("25 discs of 1"));
    const TargetBody card = read_target_file(kCard);
    const TargetBody back = read_target_file(folder / "back.tsv");
    ASSERT_EQ(back.targets.size(), card.targets.size());
    EXPECT_LT(largest_gap_mm(card, back), 0.02);
    EXPECT_EQ(back.targets[0].type, 1);  // light discs on a dark plate
    EXPECT_EQ(back.targets[0].id.view(), "T01");
  }
}

TEST(CardProgram, ReadsDarkDiscsToo) {
  const OperatorsFolder folder;
  folder.write("four.tsv",
               "a\t0\t0\t0\t1\t0\nb\t0.05\t0\t0\t1\t0\nc\t0\t0.04\t0\t1\t0\nd\t0.05\t0.047\t0\t1\t0\n");
  ASSERT_EQ(folder.omma("card draw four.tsv --out card.png --dpi 150 --disc 10").exit_code, 0);
  ASSERT_EQ(folder.omma("card read card.png --dpi 150 --out back.tsv").exit_code, 0);
  const TargetBody back = read_target_file(folder / "back.tsv");
  EXPECT_LT(largest_gap_mm(read_target_file(folder / "four.tsv"), back), 0.02);
  EXPECT_EQ(back.targets[0].type, 0);
}

TEST(CardProgram, DrawsVectorSheetsAtTheirTrueSize) {
  const OperatorsFolder folder;
  ASSERT_EQ(folder.omma("card draw " + kCard + " --out card.svg --page a3-landscape").exit_code, 0);
  const std::string svg = folder.read("card.svg");
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("width=\"1190.551181pt\""));  // 420 mm
  ASSERT_EQ(folder.omma("card draw " + kCard + " --out card.pdf --page a3-landscape").exit_code, 0);
  EXPECT_THAT(folder.read("card.pdf"), StartsWith("%PDF"));
}

TEST(CardProgram, ChecksACard) {
  const OperatorsFolder folder;
  const Told good = folder.omma("card check " + kCard + " --range 1 --trials 30 --json");
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  const auto json = nlohmann::json::parse(good.out);
  EXPECT_EQ(json["ranges"][0]["wrong"], 0);
  EXPECT_GE(json["ranges"][0]["right"].get<int>(), 25);
  folder.write("square.tsv",
               "a\t0\t0\t0\t1\t0\nb\t0.1\t0\t0\t1\t0\nc\t0\t0.1\t0\t1\t0\nd\t0.1\t0.1\t0\t1\t0\n");
  const Told symmetric = folder.omma("card check square.tsv --range 1 --trials 5");
  EXPECT_EQ(symmetric.exit_code, 1);
  EXPECT_THAT(symmetric.out, HasSubstr("the card is symmetric"));
}

TEST(CardProgram, RefusesWhatMakesNoSense) {
  const OperatorsFolder folder;
  ground::Canvas(200, 100).write_png((folder / "black.png").string());
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("card " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err + told.out, HasSubstr(sentence)) << arguments;
  };
  refused("", "subcommand");
  refused("draw nowhere.tsv --out a.svg", "nowhere.tsv");
  refused("draw " + kCard + " --out a.doc", "ending: expected .svg, .pdf or .png, found .doc");
  refused("draw " + kCard + " --out a.svg --page a9", "--page: expected a4, a3 or letter");
  refused("draw " + kCard + " --out a.svg --disc 60", "disc: expected a diameter below");
  refused("draw " + kCard + " --out a.svg --page a4 --margin 60", "page: expected at least");
  refused("draw " + kCard + " --out /nowhere/a.png", "/nowhere/a.png");
  refused("read black.png", "size: expected one of --width and --dpi, found none");
  refused("read black.png --dpi 100", "black.png: card: expected at least four round discs, found 0");
  refused("check nowhere.tsv", "nowhere.tsv");
  refused("check " + kCard + " --range 0", "--range: expected metres above zero");
  folder.write("three.tsv", "a\t0\t0\t0\t1\t0\nb\t0.1\t0\t0\t1\t0\nc\t0\t0.1\t0\t1\t0\n");
  refused("check three.tsv", "targets: expected at least four, found 3");
}

}  // namespace
}  // namespace omma
