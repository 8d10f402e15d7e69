// The example of docs/component.md: what it does, that its topology runs, and that the page shows it as it
// is.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "docs/examples/rate_limit.hpp"
#include "tests/paths.hpp"

namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(OMMA_SOURCE_DIR) + "/" + file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string output_of(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) output += line.data();
  pclose(pipe);
  return output;
}

TEST(ExampleComponent, FollowsItsTargetNoFasterThanItsRate) {
  omma::Out<Angle> target;
  RateLimit limit(0.1);
  limit.target.bind(target);
  target->radians = 0.25;
  for (const double expected : {0.1, 0.2, 0.25, 0.25}) {
    limit.step({});
    EXPECT_DOUBLE_EQ(limit.command->radians, expected);
  }
}

TEST(ExampleTopology, RunsAsThePageSays) {
  const std::string output = output_of(OMMA_RUN "example-topology");
  EXPECT_EQ(output.substr(0, 30), "0.00\n-0.10\n-0.20\n-0.30\n-0.40\n-");
  EXPECT_NE(output_of(OMMA_RUN "example-topology --graph")
                .find("c2 -> c0 [label=\"target\\nlatest\", style=dashed]"),
            std::string::npos);
}

TEST(ExamplePage, ShowsTheExampleAsItIs) {
  const std::string page = text_of("docs/component.md");
  for (const char* file : {"docs/examples/rate_limit.hpp", "docs/examples/topology.cpp"}) {
    const std::string code = text_of(file);
    // The page leaves out the first comment and the includes.
    const std::size_t start = code.find("class RateLimit") != std::string::npos ? code.find("class RateLimit")
                                                                                : code.find("int main");
    ASSERT_NE(start, std::string::npos);
    EXPECT_NE(page.find(code.substr(start)), std::string::npos) << file;
  }
}

}  // namespace
