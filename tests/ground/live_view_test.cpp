// Live cameras in a browser: the real server, asked by a real HTTP client (curl) for its page, its status and
// the frames of a simulated camera; addresses it is refused; and capturing at the rate of the cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "fsw/kernel/input_error.hpp"
#include "ground/capture/view_picture.hpp"
#include "ground/capture/view_server.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/bench/fed_camera.hpp"
#include "tests/ground/run_omma.hpp"
#include "tests/ground/run_program.hpp"

namespace omma::ground {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string message(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

class LiveView : public testing::Test {
 protected:
  LiveView() : fed_("cam0", 96, 64, 12, 50) {
    recorders_.emplace_back(fed_.camera(), RecorderOptions{}, start_);
    recorders_.back().start();
    server_.emplace(recorders_, ViewAddress{});
  }
  std::string url(const std::string& path) const {
    return "'http://127.0.0.1:" + std::to_string(server_->address().port) + path + "'";
  }
  /// What curl prints, its options before the address.
  std::string get(const std::string& path, const std::string& options = "") const {
    return test::run_program("curl -s " + options + " " + url(path), "").output;
  }

  Image image(const std::string& path) const {
    const std::filesystem::path file = folder_ / "frame.jpg";
    get(path, "-o " + file.string());
    return read_image(file);
  }

  OperatorsFolder folder_;
  FedCamera fed_;
  CaptureStart start_;
  Recorders recorders_;
  std::optional<ViewServer> server_;
};

TEST_F(LiveView, IsAPageThatNeedsNothingElse) {
  const std::string page = get("/", "-i");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("text/html"));
  EXPECT_THAT(page, HasSubstr("width=device-width"));
  for (const char* const outside : {"src=\"http", "href=\"http", "url(http", "@import", "//cdn"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(LiveView, TellsRateExposureAndWhatWasLost) {
  nlohmann::json camera;
  for (int i = 0; i < 100 && (camera.empty() || camera["rate_hz"] == 0.0); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    camera = nlohmann::json::parse(get("/status.json"))["cameras"][0];
  }
  EXPECT_EQ(camera["name"], "cam0");
  EXPECT_EQ(camera["width"], 96);
  EXPECT_EQ(camera["connected"], true);
  EXPECT_GT(camera["frames"], 0);
  EXPECT_GT(camera["rate_hz"], 0);
  EXPECT_TRUE(camera.contains("exposure_ms"));
  EXPECT_EQ(camera["lost"]["times_gone"], 0);
}

TEST_F(LiveView, ShowsFramesAsTheyCome) {
  const Image whole = image("/camera/cam0.jpg");
  EXPECT_EQ(whole.width, 96);
  EXPECT_EQ(whole.height, 64);
  EXPECT_EQ(image("/camera/cam0.jpg?width=40").width, 32);  // whole cells of 3
  // Levels as they are: a sensor of 12 bits with 24 levels of noise is all but black.
  EXPECT_LT(image("/camera/cam0.jpg?stretch=0").view().row<std::uint8_t>(10)[10], 8);
}

TEST_F(LiveView, StreamsThemOneAfterTheOther) {
  const std::string stream = get("/camera/cam0.mjpg", "-i --max-time 2");
  EXPECT_THAT(stream, HasSubstr("multipart/x-mixed-replace; boundary=omma-frame"));
  std::size_t parts = 0;
  for (std::size_t at = stream.find("--omma-frame\r\nContent-Type: image/jpeg"); at != std::string::npos;
       at = stream.find("--omma-frame\r\nContent-Type: image/jpeg", at + 1))
    ++parts;
  EXPECT_GE(parts, 2U);
}

TEST_F(LiveView, SaysWhatItDoesNotHave) {
  const std::string status = "-w '%{http_code}'";
  EXPECT_EQ(get("/none", status), "expected /, /status.json or /camera/NAME.jpg or .mjpg, found /none\n404");
  EXPECT_THAT(get("/camera/cam9.jpg", status), HasSubstr("found cam9\n404"));
  EXPECT_THAT(get("/camera/cam0.jpg?width=wide", status), HasSubstr("expected a number from 16\n400"));
  EXPECT_THAT(get("/", "-X POST -d x " + status), HasSubstr("expected GET, found POST\n405"));
}

TEST_F(LiveView, EndsBesideReadersThatDoNot) {
  std::FILE* const reader =
      popen(("curl -s --max-time 60 -o /dev/null " + url("/camera/cam0.mjpg")).c_str(), "r");
  ASSERT_NE(reader, nullptr);
  for (int i = 0; i < 100 && !recorders_.back().shown().newest(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto begin = std::chrono::steady_clock::now();
  server_.reset();
  pclose(reader);  // it was let go
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST_F(LiveView, AtAPortThatIsTakenIsRefused) {
  const std::string port = std::to_string(server_->address().port);
  EXPECT_EQ(message([&] { ViewServer(recorders_, read_view_address(port)); }),
            "omma capture: --serve: expected a port that can be listened at, found 127.0.0.1:" + port +
                ": Address already in use");
}

TEST(ViewAddress, IsAPortOrAnAddressWithOne) {
  EXPECT_EQ(url_of(read_view_address("8080")), "http://127.0.0.1:8080/");
  EXPECT_EQ(url_of(read_view_address("10.0.0.7:80")), "http://10.0.0.7:80/");
  EXPECT_EQ(url_of(read_view_address("[::1]:8080")), "http://[::1]:8080/");
  EXPECT_EQ(read_view_address("0.0.0.0:8080").host, "0.0.0.0");
  for (const std::string text : {"", "http", "80x", "65536", "-1", "1.2.3.4:"})
    EXPECT_EQ(message([&] { read_view_address(text); }),
              "omma capture: --serve: expected a port from 0 to 65535, or ADDRESS:PORT, found " + text);
  EXPECT_THAT(message([] { read_view_address("here:80"); }),
              HasSubstr("expected an address of this machine in numbers"));
  ViewAddress elsewhere = read_view_address("192.0.2.1:8080");
  EXPECT_THAT(message([&] { listen_at(elsewhere); }), HasSubstr("found 192.0.2.1:8080: Cannot assign"));
}

TEST(ViewAddress, ThatIsWrongEndsTheCommandBeforeACameraIsOpened) {
  const Told told = OperatorsFolder().omma("capture --camera cam0=simulated:none --serve http");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_EQ(told.err,
            "omma: omma capture: --serve: expected a port from 0 to 65535, or ADDRESS:PORT, found http\n");
}

TEST(ViewPicture, KeepsAStarAndStretchesWhatIsThere) {
  std::vector<std::uint16_t> pixels(std::size_t{40} * 20, 100);
  pixels[40 * 7 + 13] = 4000;
  const ImageView image{
      reinterpret_cast<const std::byte*>(pixels.data()), 40, 20, 80, PixelFormat::kGrey16, 4095};
  const ViewPicture picture = view_picture(image, 10, 5, false);
  EXPECT_EQ(picture.levels[10 * 1 + 3], 4000 * 255 / 4095);
  EXPECT_EQ(picture.levels[0], 100 * 255 / 4095);
  EXPECT_EQ(view_picture(image, 10, 5, true).levels[10 * 1 + 3], 255);
}

// Whether a busy machine keeps the rate is omma-bench's to say; that nothing goes astray unnamed is held
// here.
TEST(Capture, OfThreeCamerasHasEveryFrameOrCountsIt) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("omma_capture_set_" + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  constexpr std::uint64_t kFrames = 20;
  FedCamera hdr1("hdr1", 768, 576, 12, 20), cam0("cam0", 1024, 768, 8, 20), cam2("cam2", 640, 480, 8, 20);
  CaptureStart start;
  Recorders recorders;
  for (const FedCamera* fed : {&hdr1, &cam0, &cam2})
    recorders.emplace_back(fed->camera(), RecorderOptions{folder.string(), kFrames, false}, start);
  for (Recorder& recorder : recorders) recorder.start();
  for (const Recorder& recorder : recorders) {
    while (!recorder.done()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(recorder.failure(), "");
    EXPECT_EQ(recorder.taken(), kFrames);
    std::set<std::uint64_t> numbers;
    for (const auto& entry : std::filesystem::directory_iterator(folder / recorder.name())) {
      if (entry.path().extension() != ".png") continue;
      const std::string stem = entry.path().stem().string();
      numbers.insert(std::stoull(stem.substr(stem.rfind('_') + 1)));
    }
    ASSERT_EQ(numbers.size(), kFrames);
    EXPECT_EQ(*numbers.rbegin() - *numbers.begin() + 1, kFrames + recorder.health().gaps);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace omma::ground
