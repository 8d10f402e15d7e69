// Recordings as CSV, and recordings compared.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "fsw/kernel/input_error.hpp"
#include "ground/compare/recording_difference.hpp"
#include "ground/export/csv_table.hpp"
#include "tests/ground/run_program.hpp"
#include "tests/ground/sample_recording.hpp"

namespace omma::ground {
namespace {

using telemetry::TopicId;

class ExportCompare : public testing::Test {
 protected:
  ExportCompare() { std::filesystem::create_directories(folder_); }
  ~ExportCompare() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string text_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  /// A recording of `frames` attitudes; the one of frame `wrong` has another chi2.
  static void write_attitudes(const std::string& file, int frames, int wrong = -1) {
    telemetry::RecordingWriter recording(file, "testsat", false);
    telemetry::CdrWriter cdr;
    for (int i = 0; i < frames; ++i) {
      omma_Attitude sample = test::attitude_sample(i);
      if (i == wrong) sample.chi2 = 1234.5;
      recording.write(TopicId::kAttitude, cdr.write(TopicId::kAttitude, &sample));
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("omma_export_" + std::to_string(getpid()));
};

TEST_F(ExportCompare, TopicIsATableWithUnitsInItsColumns) {
  test::write_recording(path("a.mcap"), 3);
  const test::ProgramRun run = test::run_omma("export " + path("a.mcap") + " --out " + path("csv"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const std::vector<std::string> lines = lines_of(text_of(path("csv/attitude.csv")));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].substr(0, lines[0].find(",rig")), "frame,time_ns,sample_number,valid,state");
  EXPECT_NE(lines[0].find(",rig_from_j2000.w,covariance_rx_rx_rad2,covariance_rx_ry_rad2,"),
            std::string::npos);
  EXPECT_NE(lines[0].find(",rate_rad_s.x,"), std::string::npos);
  EXPECT_EQ(lines[2].substr(0, 44), "1,1100000000,2,true,SOLVE_SOLVED,0,0,0.6,0.8");
}

TEST_F(ExportCompare, EveryDotHasARowOfItsOwn) {
  test::write_recording(path("a.mcap"), 2);
  ASSERT_EQ(test::run_omma("export " + path("a.mcap") + " --topic dots --out " + path("csv")).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("csv/attitude.csv")));
  const std::vector<std::string> lines = lines_of(text_of(path("csv/dots.csv")));
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[0].substr(0, 65), "frame,time_ns,sample_number,valid,camera,dots_index,dots.u_px,dot");
  EXPECT_EQ(lines[6].substr(0, 42), "1,1100000000,2,true,1,2,31.5,4.25,0,0,0,0,");
}

TEST_F(ExportCompare, ColumnsOfEveryTopicHaveDifferentNames) {
  const idl::Schema schema = idl::parse(telemetry::idl_text(), "omma.idl");
  for (const telemetry::Topic& topic : telemetry::topics()) {
    const CsvTable table(schema, std::string(topic.type_name), "omma.idl");
    std::set<std::string> names;
    std::istringstream header(table.header());
    for (std::string name; std::getline(header, name, ',');)
      EXPECT_TRUE(names.insert(name).second) << topic.name << ": " << name;
  }
}

TEST_F(ExportCompare, TextWithCommasAndQuotesIsOneCell) {
  omma_Event event{};
  telemetry::CdrWriter cdr;
  std::snprintf(event.text, sizeof event.text, "a \"word\", and one");
  double values[2] = {1.5, -2};
  event.values = {2, 2, values, false};
  const idl::Schema schema = idl::parse(telemetry::idl_text(), "omma.idl");
  const CsvTable table(schema, "omma::Event", "omma.idl");
  const std::optional<std::string> rows = table.rows(cdr.write(TopicId::kEvent, &event));
  ASSERT_TRUE(rows);
  EXPECT_NE(rows->find(",\"a \"\"word\"\", and one\",2,1.5,-2,,\n"), std::string::npos) << *rows;
}

TEST_F(ExportCompare, SampleWithoutElementsKeepsItsRow) {
  omma_CameraDots sample{};
  sample.frame = 5;
  telemetry::CdrWriter cdr;
  const idl::Schema schema = idl::parse(telemetry::idl_text(), "omma.idl");
  const CsvTable table(schema, "omma::CameraDots", "omma.idl");
  const std::optional<std::string> rows = table.rows(cdr.write(TopicId::kDots, &sample));
  ASSERT_TRUE(rows);
  EXPECT_EQ(*rows, "5,0,0,false,0,,,,,,,,,,,,,,,,\n");
}

TEST_F(ExportCompare, BytesCutOffAnywhereGiveNoRow) {
  omma_Dot dots[3];
  const omma_CameraDots sample = test::dots_sample(1, dots, 3);
  telemetry::CdrWriter cdr;
  const std::span<const std::byte> bytes = cdr.write(TopicId::kDots, &sample);
  const idl::Schema schema = idl::parse(telemetry::idl_text(), "omma.idl");
  const CsvTable table(schema, "omma::CameraDots", "omma.idl");
  const std::size_t padding = std::to_integer<std::size_t>(bytes[3]);
  for (std::size_t size = 0; size + padding < bytes.size(); ++size)
    EXPECT_FALSE(table.rows(bytes.first(size))) << size;
  EXPECT_TRUE(table.rows(bytes));
}

TEST_F(ExportCompare, SameRecordingsAreTheSame) {
  test::write_recording(path("a.mcap"), 5);
  test::write_recording(path("b.mcap"), 5, {.chunk_bytes = 300});
  const test::ProgramRun run = test::run_omma("compare " + path("a.mcap") + " " + path("b.mcap"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("the recordings are the same"), std::string::npos) << run.output;
}

TEST_F(ExportCompare, FirstDifferenceIsNamedByFrameAndField) {
  write_attitudes(path("a.mcap"), 9);
  write_attitudes(path("b.mcap"), 9, 4);
  const std::vector<TopicComparison> topics = compare_recordings(path("a.mcap"), path("b.mcap"));
  for (const TopicComparison& topic : topics) {
    if (topic.topic != "attitude") {
      EXPECT_EQ(topic.first_difference, "") << topic.topic;
      continue;
    }
    EXPECT_EQ(topic.different, 1U);
    EXPECT_EQ(topic.first_difference, "sample 5 (frame 4): chi2: 2 in the first, 1234.5 in the second");
  }
  EXPECT_EQ(test::run_omma("compare --quiet " + path("a.mcap") + " " + path("b.mcap")).exit_code, 1);
}

TEST_F(ExportCompare, MissingSamplesAreADifference) {
  write_attitudes(path("a.mcap"), 9);
  write_attitudes(path("b.mcap"), 8);
  const test::ProgramRun run = test::run_omma("compare " + path("a.mcap") + " " + path("b.mcap"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("9 samples in the first, 8 in the second"), std::string::npos) << run.output;
}

TEST_F(ExportCompare, BadInputIsOneSentenceAndExitCodeTwo) {
  test::write_recording(path("a.mcap"), 50);
  std::filesystem::copy_file(path("a.mcap"), path("cut.mcap"));
  std::filesystem::resize_file(path("cut.mcap"), std::filesystem::file_size(path("a.mcap")) / 2);
  std::ofstream(path("other.mcap")) << "PK\x03\x04 another kind of file";
  std::ofstream(path("empty.mcap"));
  for (const std::string name : {"cut.mcap", "other.mcap", "empty.mcap", "missing.mcap"}) {
    for (const std::string& arguments :
         {"compare " + path("a.mcap") + " " + path(name), "compare " + path(name) + " " + path("a.mcap"),
          // Of export only what it says of the error.
          "export --out " + path("csv") + " " + path(name)}) {
      const test::ProgramRun run =
          test::run_omma(arguments, arguments.starts_with("export") ? "2>&1 >/dev/null" : "2>&1");
      EXPECT_EQ(run.exit_code, 2) << arguments << ": " << run.output;
      EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << arguments << ": " << run.output;
      EXPECT_NE(run.output.find(name), std::string::npos) << run.output;
    }
  }
  EXPECT_EQ(test::run_omma("export " + path("a.mcap") + " --topic altitude --out " + path("csv")).exit_code,
            2);
  EXPECT_EQ(test::run_omma("export " + path("a.mcap") + " --out /dev/null/csv").exit_code, 2);
}

TEST_F(ExportCompare, ANumberThatDiffersWithinTheToleranceIsTolerated) {
  write_attitudes(path("a.mcap"), 5);
  {
    telemetry::RecordingWriter recording(path("b.mcap"), "testsat", false);
    telemetry::CdrWriter cdr;
    for (int i = 0; i < 5; ++i) {
      omma_Attitude sample = test::attitude_sample(i);
      sample.chi2 *= 1 + 1e-9;
      recording.write(TopicId::kAttitude, cdr.write(TopicId::kAttitude, &sample));
    }
  }
  const std::string files = path("a.mcap") + " " + path("b.mcap");
  EXPECT_EQ(test::run_omma("compare " + files).exit_code, 1);
  const test::ProgramRun near = test::run_omma("compare " + files + " --tolerance 1e-6");
  EXPECT_EQ(near.exit_code, 0) << near.output;
  EXPECT_NE(near.output.find("the same within the tolerance"), std::string::npos) << near.output;
  EXPECT_NE(near.output.find("largest: "), std::string::npos) << near.output;
  const test::ProgramRun strict = test::run_omma("compare " + files + " --tolerance 1e-12");
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_NE(strict.output.find("chi2"), std::string::npos) << strict.output;
  EXPECT_EQ(test::run_omma("compare " + files + " --tolerance attitude.chi2=1").exit_code, 0);
  EXPECT_EQ(test::run_omma("compare " + files + " --tolerance attitude.stars=1").exit_code, 1);
}

TEST_F(ExportCompare, AWholeNumberIsToBeTheSameUnlessNamed) {
  write_attitudes(path("a.mcap"), 3);
  {
    telemetry::RecordingWriter recording(path("b.mcap"), "testsat", false);
    telemetry::CdrWriter cdr;
    for (int i = 0; i < 3; ++i) {
      omma_Attitude sample = test::attitude_sample(i);
      if (i == 1) ++sample.stars_used;
      recording.write(TopicId::kAttitude, cdr.write(TopicId::kAttitude, &sample));
    }
  }
  const std::string files = path("a.mcap") + " " + path("b.mcap");
  EXPECT_EQ(test::run_omma("compare " + files + " --tolerance 0.5").exit_code, 1);
  EXPECT_EQ(test::run_omma("compare " + files + " --tolerance attitude.stars_used=1").exit_code, 0);
}

TEST_F(ExportCompare, AToleranceThatIsNoneIsRefused) {
  write_attitudes(path("a.mcap"), 1);
  for (const std::string wrong : {"much", "-1", "=1", "attitude.chi2=x"}) {
    const test::ProgramRun run =
        test::run_omma("compare " + path("a.mcap") + " " + path("a.mcap") + " --tolerance=" + wrong);
    EXPECT_EQ(run.exit_code, 2) << wrong;
    EXPECT_NE(run.output.find("--tolerance: expected a number, or FIELD=NUMBER"), std::string::npos)
        << run.output;
  }
}

}  // namespace
}  // namespace omma::ground
