// The real `omma-bench`: what it may be told is told, what it does not know is one sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/ground/run_program.hpp"

namespace omma {
namespace {

using test::run_program;
using ::testing::AllOf;
using ::testing::HasSubstr;

void expect_refused(const std::string& arguments, const std::string& sentence) {
  const auto errors = run_program(OMMA_RUN "omma-bench " + arguments, "2>&1 >/dev/null");
  EXPECT_EQ(errors.exit_code, 2) << arguments;
  EXPECT_THAT(errors.output, HasSubstr(sentence)) << arguments;
  EXPECT_EQ(run_program(OMMA_RUN "omma-bench " + arguments, "2>/dev/null").output, "") << arguments;
}

TEST(OmmaBench, RefusesWhatItDoesNotKnowBeforeItMeasures) {
  expect_refused("", "usage: omma-bench NAME");
  expect_refused("poses", "no bench is called 'poses'");
  expect_refused("pose --trails 3", "--trails");
  expect_refused("pose --trials many", "--trials: Value many not in range 1 to ");
  expect_refused("attitude --trials 0", "--trials: Value 0 not in range 1 to ");
  expect_refused("attitude --trials", "--trials");
  expect_refused("render --scenario nowhere.toml", "nowhere.toml");
}

TEST(OmmaBench, TellsTheOptionsOfABenchAndTheirDefaults) {
  const auto help = run_program(OMMA_RUN "omma-bench pose --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.output, AllOf(HasSubstr("--trials N=400"), HasSubstr("--minima")));
}

TEST(OmmaBench, MeasuresAsManyTrialsAsItIsTold) {
  const auto run = run_program(OMMA_RUN "omma-bench axes --trials 2 --samples 12");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("2 trials of three axes, 12 poses each"));
}

}  // namespace
}  // namespace omma
