// Simulated frames, the flight program and `omma report` as a user runs them: figures, page and pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "ground/simulate/render_recording.hpp"
#include "sim/scenario_file.hpp"
#include "tests/ground/run_program.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

using ::testing::HasSubstr;

constexpr int kFrameSets = 6;
const std::string kConfig = OMMA_SOURCE_DIR "/config/";

class ReportProgram : public testing::Test {
 protected:
  static std::filesystem::path folder() {
    return std::filesystem::path(testing::TempDir()) / ("omma_report_" + std::to_string(getppid()));
  }
  void SetUp() override {
    sim::Scenario scenario = sim::read_scenario_file(kConfig + "demo_scenario.toml");
    scenario.frames = kFrameSets;
    folder_ = folder().string() + testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    render_recording(scenario, folder_ / "frames", 2);
    const test::ProgramRun flight =
        test::run_program(OMMA_RUN "omma-fsw " + kConfig + "demo.toml --no-dds --frames " + path("frames") +
                          " --log " + path("demo.mcap"));
    ASSERT_EQ(flight.exit_code, 0) << flight.output;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string text_of(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  test::ProgramRun report(const std::string& recording) const {
    return test::run_omma("report " + path(recording) + " --frames " + path("frames") + " --mission " +
                          kConfig + "demo.toml --output " + path("report"));
  }
  std::filesystem::path folder_;
};

TEST_F(ReportProgram, PutsTheFlightBesideTheTruth) {
  const test::ProgramRun run = report("demo.mcap");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto json = nlohmann::json::parse(text_of("report/report.json"));
  EXPECT_EQ(json["attitude"]["frames"], kFrameSets);
  EXPECT_EQ(json["attitude"]["solved"], kFrameSets);
  EXPECT_EQ(json["pairings"]["wrong"], 0);
  EXPECT_GT(json["attitude"]["bound_rms_arcsec"][0].get<double>(), 0.5);
  EXPECT_GT(json["attitude"]["rms_over_bound"].get<double>(), 0.4);
  EXPECT_LT(json["attitude"]["rms_over_bound"].get<double>(), 4);
  EXPECT_EQ(json["poses"][0]["body"], "card");

  const std::string page = text_of("report/report.html");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBOR"));
  for (const char* picture : {"hdr1.png", "cam0.png", "cam2.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / picture)) << picture;
  }
}

TEST_F(ReportProgram, RefusesFramesWithoutTruth) {
  std::filesystem::remove(folder_ / "frames" / "truth.jsonl");
  const test::ProgramRun run = report("demo.mcap");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("truth.jsonl"));
}

TEST_F(ReportProgram, RefusesARecordingThatIsCutOff) {
  std::filesystem::resize_file(folder_ / "demo.mcap", std::filesystem::file_size(folder_ / "demo.mcap") / 2);
  const test::ProgramRun run = report("demo.mcap");
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_THAT(run.output, HasSubstr("demo.mcap"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "report" / "report.html"));
}

TEST_F(ReportProgram, RefusesARecordingThatIsMissing) {
  EXPECT_EQ(report("lost.mcap").exit_code, 2);
}

}  // namespace
}  // namespace omma::ground
