// `omma resect` as an operator runs it: the pose of a rendered card beside the truth, its uncertainty, images
// that hold no card, and bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>
#include <random>

#include "components/catalogue/target_file.hpp"
#include "components/geometry/pose.hpp"
#include "components/geometry/rig_file.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kFrames = 6;
const std::string kConfig = OMMA_SOURCE_DIR "/config/";

Pose pose_of(const json& object) {
  const auto q = object.at("quaternion_xyzw").get<std::vector<double>>();
  const json& t = object.contains("translation_m") ? object.at("translation_m") : object.at("position_m");
  return {Eigen::Quaterniond(q.at(3), q.at(0), q.at(1), q.at(2)),
          Eigen::Vector3d(t.at(0).get<double>(), t.at(1).get<double>(), t.at(2).get<double>())};
}

/// The demo's card on its way from 2.0 m to 0.7 m, in six frame sets.
class RenderedCard : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<OperatorsFolder>();
    std::string scenario = OperatorsFolder::text_of(kConfig + "demo_scenario.toml");
    replace(scenario, "frame_rate_hz = 10", "frame_rate_hz = 0.5");
    replace(scenario, "frames = 120", "frames = " + std::to_string(kFrames));
    for (const std::string file : {"rigs/dissertation.toml", "targets/docking_card.tsv"})
      replace(scenario, '"' + file, '"' + kConfig + file);
    folder_->write("scenario.toml", scenario);
    const Told run = folder_->omma("simulate scenario.toml --out frames");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    std::istringstream lines(folder_->read("frames/truth.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const json frame = json::parse(line);
      if (frame.contains("bodies")) truth_.push_back(pose_of(frame.at("bodies").at(0).at("rig_from_body")));
    }
    ASSERT_EQ(truth_.size(), std::size_t{kFrames});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void replace(std::string& text, const std::string& old, const std::string& fresh) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + fresh.size()))
      text.replace(at, old.size(), fresh);
  }
  static std::string image(const std::string& camera, int frame) {
    return "frames/" + camera + "/" + camera + "_00000" + std::to_string(frame) + ".png";
  }
  static std::string targets() { return " --targets '" + kConfig + "targets/docking_card.tsv'"; }
  static std::string rig() { return " --rig '" + kConfig + "rigs/dissertation.toml'"; }

  static inline std::unique_ptr<OperatorsFolder> folder_;
  static inline std::vector<Pose> truth_;
};

TEST_F(RenderedCard, IsFoundFromPairsPickedByHand) {
  const std::string images =
      "resect hdr1=" + image("hdr1", 3) + " cam0=" + image("cam0", 3) + rig() + targets();
  const Told pattern = folder_->omma(images + " --json");
  ASSERT_EQ(pattern.exit_code, 0) << pattern.err;
  // Where the card is in hdr1, within two pixels, and one target that is elsewhere.
  const Rig read = read_rig_file(kConfig + "rigs/dissertation.toml");
  const TargetBody body = read_target_file(kConfig + "targets/docking_card.tsv");
  std::string pairs = "# camera u v target\n";
  for (const std::size_t t : {0U, 4U, 10U, 14U, 20U, 24U}) {
    Eigen::Vector2d pixel;
    ASSERT_TRUE(read.cameras[0].lens.project((truth_[3] * body.targets[t].position).normalized(), pixel));
    const double off = t == 10 ? 40 : t % 3 - 1.0;
    pairs += "hdr1 " + std::to_string(pixel.x() + off) + " " + std::to_string(pixel.y() - off) + " " +
             std::string(body.targets[t].id.view()) + "\n";
  }
  folder_->write("pairs.txt", pairs);
  const Told by_hand = folder_->omma(images + " --pairs pairs.txt --json");
  ASSERT_EQ(by_hand.exit_code, 0) << by_hand.out << by_hand.err;
  const json object = json::parse(by_hand.out);
  EXPECT_TRUE(object.at("by_hand").get<bool>());
  EXPECT_EQ(object.at("targets_used"), json::parse(pattern.out).at("targets_used"));
  const Pose found = pose_of(object.at("rig_from_body"));
  const Pose expected = pose_of(json::parse(pattern.out).at("rig_from_body"));
  EXPECT_LT((found.translation - expected.translation).norm(), 2e-5);
  EXPECT_LT((pose_of(object.at("body_from_rig")).translation - found.inverse().translation).norm(), 1e-9);
}

TEST_F(RenderedCard, PairsThatMakeNoSenseAreRefusedByTheirLine) {
  const std::string images = "resect hdr1=" + image("hdr1", 3) + rig() + targets() + " --pairs pairs.txt";
  const auto refused = [&](const std::string& pairs, const std::string& sentence) {
    folder_->write("pairs.txt", pairs);
    const Told told = folder_->omma(images);
    EXPECT_EQ(told.exit_code, 2) << pairs;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << pairs;
    EXPECT_EQ(told.out, "");
  };
  refused("hdr1 10 10\n", "pairs.txt:1: pair: expected CAMERA u v TARGET, found 3 words");
  refused("\nhdr9 10 10 T01\n", "pairs.txt:2: camera: expected a camera of the rig, found \"hdr9\"");
  refused("hdr1 ten 10 T01\n", "pairs.txt:1: u: expected a pixel of the image");
  refused("hdr1 10 5000 T01\n", "pairs.txt:1: v: expected a pixel of the image");
  refused("hdr1 10 10 T99\n", "pairs.txt:1: target: expected a target of the database, found \"T99\"");
  refused("hdr1 10 10 T01\nhdr1 20 20 T01\n", "pairs.txt:2: target: expected each target once an image");
  refused("hdr1 10 10 T01\n", "pairs: expected at least four, found 1");
  const Told missing =
      folder_->omma("resect hdr1=" + image("hdr1", 3) + rig() + targets() + " --pairs none.txt");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("none.txt"));
}

TEST_F(RenderedCard, IsFoundByItsPatternWithinItsUncertainty) {
  double squares = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Told run = folder_->omma("resect hdr1=" + image("hdr1", frame) + " cam0=" + image("cam0", frame) +
                                   " cam2=" + image("cam2", frame) + rig() + targets() + " --json");
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    const json object = json::parse(run.out);
    ASSERT_TRUE(object.at("solved").get<bool>());
    EXPECT_FALSE(object.at("ambiguous").get<bool>());
    EXPECT_GE(object.at("targets_used").get<int>(), 40);  // 25 in hdr1, the rest near the edge of cam0
    EXPECT_EQ(object.at("cameras").at(2).at("targets_used").get<int>(), 0);  // behind cam2
    const Pose found = pose_of(object.at("rig_from_body"));
    const Pose& truth = truth_[static_cast<std::size_t>(frame)];
    const Eigen::Vector3d turn = rotation_log(truth.rotation * found.rotation.conjugate()) * 180 / M_PI;
    const Eigen::Vector3d shift = truth.translation - found.translation;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double turn_sigma = object.at("sigma_deg").at(axis).get<double>();
      const double shift_sigma = object.at("sigma_m").at(axis).get<double>();
      EXPECT_LT(std::abs(turn(k)), 4 * turn_sigma) << frame;
      EXPECT_LT(std::abs(shift(k)), 4 * shift_sigma) << frame;
      squares += std::pow(turn(k) / turn_sigma, 2) + std::pow(shift(k) / shift_sigma, 2);
    }
    EXPECT_NEAR(object.at("range_m").get<double>(), truth.translation.norm(), 0.02);
    EXPECT_LT(object.at("range_sigma_m").get<double>(), 1e-3 * truth.translation.norm());
  }
  // 36 squares of unit variance, not all independent: between a third and twice what is due.
  EXPECT_GT(squares, 12);
  EXPECT_LT(squares, 72);
}

TEST_F(RenderedCard, OneImageIsARigOfOneCamera) {
  const std::string lens = " --lens '" + kConfig + "lenses/hdr1_f3.0mm_10um_768x576.txt'";
  const std::string photographs = image("hdr1", 3) + " " + image("hdr1", 5);
  const Told run = folder_->omma("resect " + photographs + lens + targets() + " --json --annotate card.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::istringstream lines(run.out);
  for (const int frame : {3, 5}) {
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    const json object = json::parse(line);
    EXPECT_EQ(object.at("targets_used").get<int>(), 25);
    // The camera's frame is not the rig's, but its centre is a few centimetres from it.
    EXPECT_NEAR(object.at("range_m").get<double>(),
                truth_[static_cast<std::size_t>(frame)].translation.norm(), 0.1);
  }
  for (const char* picture : {"card_0.png", "card_1.png"})
    EXPECT_GE(read_png_size(*folder_ / picture).width, 768) << picture;
}

TEST_F(RenderedCard, IsToldToAReader) {
  const Told run = folder_->omma("resect hdr1=" + image("hdr1", 2) + rig() + targets());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* part : {"rig_from_body", "position", "rotation", "yaw", "1-sigma", "range", "residual rms",
                           "25 targets used"})
    EXPECT_THAT(run.out, HasSubstr(part));
}

TEST_F(RenderedCard, ASkyWithoutACardIsNoSolution) {
  const Told run = folder_->omma("resect cam2=" + image("cam2", 2) + rig() + targets() + " --json");
  EXPECT_EQ(run.exit_code, 1) << run.out << run.err;
  const json object = json::parse(run.out);
  EXPECT_FALSE(object.at("solved").get<bool>());
  EXPECT_NE(object.at("reason").get<std::string>(), "");
  EXPECT_TRUE(object.at("rig_from_body").is_null());
}

TEST_F(RenderedCard, BlackWhiteAndNoiseAreNoSolution) {
  std::mt19937 random(7);
  const auto write = [&](const std::string& name, auto&& grey) {
    Image picture;
    picture.resize(640, 480, PixelFormat::kGrey8);
    for (std::byte& pixel : picture.pixels) pixel = static_cast<std::byte>(grey());
    write_png(*folder_ / name, picture.view());
  };
  write("black.png", [] { return 0; });
  write("white.png", [] { return 255; });
  write("noise.png", [&] { return static_cast<int>(random() % 200); });
  for (const char* name : {"black.png", "white.png", "noise.png"}) {
    const Told run = folder_->omma(std::string("resect ") + name + " --fov 60" + targets());
    EXPECT_EQ(run.exit_code, 1) << name << run.err;
    EXPECT_THAT(run.out, HasSubstr("no solution: ")) << name;
  }
}

TEST_F(RenderedCard, BadInputIsOneSentence) {
  folder_->write("twice.tsv", "A\t0\t0\t0\t1\t1\nA\t1\t0\t0\t1\t1\n");
  const std::string one = "resect " + image("hdr1", 0);
  const std::string lens = " --lens '" + kConfig + "lenses/hdr1_f3.0mm_10um_768x576.txt'";
  const std::vector<std::pair<std::string, std::string>> cases{
      {one + targets(), "lens: expected one of --lens, --rig and --fov, found none"},
      {one + lens + " --targets nowhere.tsv", "nowhere.tsv: file: expected"},
      {one + lens + " --targets twice.tsv", "twice.tsv:2: id: expected"},
      {"resect nowhere.png" + lens + targets(), "nowhere.png: file: expected an image, found no such file"},
      {"resect " + image("cam0", 0) + lens + targets(), "image size: expected 768x576 as the lens file says"},
      {"resect cam9=" + image("cam0", 0) + rig() + targets(), "camera: expected a camera of the rig"}};
  for (const auto& [arguments, sentence] : cases) {
    const Told run = folder_->omma(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << run.out;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, HasSubstr(sentence));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

}  // namespace
}  // namespace omma
