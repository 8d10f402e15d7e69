// Runs the real `omma` program as an operator would, in a folder that lives as long as its object.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/paths.hpp"

namespace omma {

/// What a program told its operator.
struct Told {
  int exit_code = -1;
  std::string out;
  std::string err;
};

class OperatorsFolder {
 public:
  OperatorsFolder() {
    // Of one test, or of a suite while it is being set up. ctest runs tests of a suite side by side.
    const auto* unit = testing::UnitTest::GetInstance();
    const auto* test = unit->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string("omma_") + unit->current_test_suite()->name() + "_" +
             (test != nullptr ? test->name() : std::to_string(getpid())));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~OperatorsFolder() { std::filesystem::remove_all(path_); }
  OperatorsFolder(const OperatorsFolder&) = delete;
  OperatorsFolder& operator=(const OperatorsFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
  }
  std::string read(const std::string& name) const { return text_of(path_ / name); }

  /// `omma ARGUMENTS` with this folder as the working folder.
  Told omma(const std::string& arguments) const {
    const std::string command =
        "cd '" + path_.string() + "' && " OMMA_RUN "omma " + arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
  }

  static std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace omma
