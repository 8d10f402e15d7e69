// Reading the truth: every field arrives, and whatever is wrong is named with its line.
#include "ground/report/truth.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fsw/kernel/input_error.hpp"
#include "tests/refusal.hpp"

namespace omma::ground {
namespace {

const std::string kLine =
    R"({"frame":7,"time_ns":700000000,"utc":"2026-04-02T02:00:00.7Z","rig_from_j2000":[0,0,0.6,0.8],)"
    R"("rate_rig":[0.01,0,-0.02],"bodies":[{"name":"card","rig_from_body":{"quaternion_xyzw":[1,0,0,0],)"
    R"("translation_m":[1,2,3]}}],"spots":[)"
    R"({"camera":1,"kind":"star","hr":2491,"u":10.5,"v":20.25,"flux":100,"snr":9.5,"information":[4,1,3]},)"
    R"({"camera":0,"kind":"target","body":"card","id":"T01","u":1,"v":2,"flux":5,"snr":6,"information":[1,0,1]},)"
    R"({"camera":0,"kind":"moon","u":1,"v":2,"flux":5,"snr":6,"information":[1,0,1],"saturated":true}]})";

class Truth : public testing::Test {
 protected:
  Truth() : file_(testing::TempDir() + "truth_test_" + std::to_string(getpid()) + ".jsonl") {}
  ~Truth() override { std::filesystem::remove(file_); }

  std::vector<TruthFrame> read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_truth(file_, 2);
  }
  std::string refusal(const std::string& text) {
    return refusal_of([&] { read(text); });
  }
  static std::string changed(const std::string& from, const std::string& to) {
    std::string line = kLine;
    return line.replace(line.find(from), from.size(), to);
  }

  const std::string file_;
};

TEST_F(Truth, ArrivesFieldByField) {
  const std::vector<TruthFrame> frames = read(kLine + "\n");
  ASSERT_EQ(frames.size(), 1U);
  const TruthFrame& frame = frames[0];
  EXPECT_EQ(frame.frame, 7U);
  EXPECT_EQ(frame.time_ns, 700000000);
  EXPECT_EQ(frame.utc, "2026-04-02T02:00:00.7Z");
  EXPECT_NEAR(frame.rig_from_j2000.z(), 0.6, 1e-15);
  EXPECT_EQ(frame.rate, Eigen::Vector3d(0.01, 0, -0.02));
  ASSERT_EQ(frame.bodies.size(), 1U);
  EXPECT_EQ(frame.bodies[0].name, "card");
  EXPECT_EQ(frame.bodies[0].rig_from_body.rotation.x(), 1);
  EXPECT_EQ(frame.bodies[0].rig_from_body.translation, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(frame.spots.size(), 3U);
  EXPECT_EQ(frame.spots[0].kind, TruthSpot::Kind::kStar);
  EXPECT_EQ(frame.spots[0].camera, 1);
  EXPECT_EQ(frame.spots[0].hr, 2491);
  EXPECT_EQ(frame.spots[0].pixel, Eigen::Vector2d(10.5, 20.25));
  EXPECT_EQ(frame.spots[0].snr, 9.5);
  EXPECT_EQ(frame.spots[0].information, (Eigen::Matrix2d() << 4, 1, 1, 3).finished());
  EXPECT_EQ(frame.spots[1].body, "card");
  EXPECT_EQ(frame.spots[1].id, "T01");
  EXPECT_EQ(frame.spots[2].kind, TruthSpot::Kind::kMoon);
}

TEST_F(Truth, WhichIsMissingIsRefused) {
  EXPECT_THROW(read_truth(testing::TempDir() + "no_such_truth.jsonl", 2), InputError);
  EXPECT_THROW(read_truth(testing::TempDir(), 2), InputError);
  EXPECT_NE(refusal("").find("empty file"), std::string::npos);
}

TEST_F(Truth, CutOffAnywhereIsRefusedWithItsLine) {
  for (std::size_t length = 1; length < kLine.size(); length += 13) {
    const std::string told = refusal(changed(":7,", ":6,") + "\n" + kLine.substr(0, length));
    EXPECT_NE(told.find(".jsonl:2: line: expected one JSON object"), std::string::npos) << told;
  }
}

TEST_F(Truth, NamesTheFieldThatIsWrong) {
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& words) {
    const std::string told = refusal(changed(from, to));
    EXPECT_NE(told.find(words), std::string::npos) << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << "one sentence";
  };
  expect(R"("snr":9.5,)", "", "spots[0].snr: expected a number, found no such field");
  expect(R"("snr":9.5)", R"("snr":"high")", "spots[0].snr: expected a number, found");
  expect(R"([4,1,3])", "[4,1]", "spots[0].information: expected 3 numbers");
  expect(R"("camera":1)", R"("camera":2)", "spots[0].camera: expected a camera of the rig, 0 to 1, found");
  expect(R"("kind":"moon")", R"("kind":"comet")",
         "spots[2].kind: expected star, target, planet, moon or sun");
  expect(R"([1,0,0,0])", "[1,1,0,0]", "bodies[0].rig_from_body.quaternion_xyzw: expected a quaternion");
  expect(R"("frame":7)", R"("frame":-7)", "frame: expected a number from 0");
  expect(R"("time_ns":700000000)", R"("time_ns":0.7)", "time_ns: expected a whole number");
  EXPECT_NE(refusal("[1]").find(":1: record: expected a JSON object"), std::string::npos);
}

TEST_F(Truth, MayTellTheMeanOfEachExposure) {
  const std::string one = R"({"turn_rad":[1,2,3],"bodies":[{"turn_rad":[4,5,6],"move_m":[7,8,9]}]})";
  const auto told = [&](const std::string& exposures) {
    return changed(R"("spots")", R"("exposures":[)" + exposures + R"(],"spots")") + "\n";
  };
  const std::vector<TruthFrame> frames = read(told(one + "," + one));
  ASSERT_EQ(frames[0].exposures.size(), 2U);
  EXPECT_EQ(frames[0].exposures[1].turn, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(frames[0].exposures[0].bodies[0][5], 9);
  EXPECT_NE(refusal(told(one)).find("one for each camera"), std::string::npos);
  EXPECT_NE(refusal(told(one + R"(,{"turn_rad":[1,2,3],"bodies":[]})")).find("one for each body"),
            std::string::npos);
  EXPECT_NE(refusal(told(one + ",1")).find("exposures[1]"), std::string::npos);
}

TEST_F(Truth, FramesThatDoNotRiseAreRefused) {
  EXPECT_NE(refusal(kLine + "\n" + kLine).find(":2: frame: expected a number above the line before"),
            std::string::npos);
}

}  // namespace
}  // namespace omma::ground
