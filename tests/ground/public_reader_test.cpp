// Our recordings, read by software that is not ours: the public MCAP reader and IDL decoder from npm. Needs
// node, and the modules in <build>/node_modules or a network to fetch them once.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/ground/run_program.hpp"
#include "tests/ground/sample_recording.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

constexpr const char* kModules =
    "@mcap/core@2.2.2 fzstd@0.1.1 @foxglove/omgidl-parser@1 @foxglove/omgidl-serialization@1";

TEST(PublicReader, ReadsWhatWeWriteAndChecksItsSums) {
  const std::filesystem::path folder = OMMA_BINARY_DIR;
  if (test::run_program("node --version").exit_code != 0) GTEST_SKIP() << "node is not installed";
  if (!std::filesystem::exists(folder / "node_modules/@foxglove/omgidl-serialization")) {
    const test::ProgramRun install = test::run_program(
        "cd " + folder.string() + " && timeout 60 npm install --no-save --no-audit " + kModules);
    if (install.exit_code != 0)
      GTEST_SKIP() << "the public reader's modules are not to be had: " << install.output;
  }
  for (const int compression : {0, 1}) {
    const std::string path = testing::TempDir() + "omma_public_reader_" + std::to_string(getpid()) + ".mcap";
    test::write_recording(path, 30, {.chunk_bytes = 2000, .compression_level = compression});
    const test::ProgramRun read = test::run_program(
        "node " OMMA_SOURCE_DIR "/tests/ground/read_with_public_reader.mjs " + folder.string() + " " + path);
    std::filesystem::remove(path);
    EXPECT_EQ(read.exit_code, 0) << read.output;
    EXPECT_NE(
        read.output.find("omma/testsat/attitude omma::Attitude omgidl cdr 30 30 frame=29 w=0.8 stars=49"),
        std::string::npos)
        << read.output;
    EXPECT_NE(read.output.find("omma/testsat/dots omma::CameraDots omgidl cdr 30 30 frame=29 u=31.5"),
              std::string::npos)
        << read.output;
  }
}

}  // namespace
}  // namespace omma::ground
