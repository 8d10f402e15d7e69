// MissionFile: a fixture for tests that spoil a mission and read what is said of it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "fsw/app/mission.hpp"
#include "fsw/kernel/input_error.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace omma {

/// A copy of config/ whose mission a test may spoil.
class MissionFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(OMMA_BINARY_DIR) / "tests" /
              (std::string("mission_test_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::copy(std::filesystem::path(OMMA_SOURCE_DIR) / "config", folder_,
                          std::filesystem::copy_options::recursive);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file() const { return folder_ / "demo.toml"; }

  void replace(const std::string& name, const std::string& from, const std::string& to) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    std::string content = text.str();
    const std::size_t at = content.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    content.replace(at, from.size(), to);
    std::ofstream(folder_ / name) << content;
  }

  std::string message() const {
    return refusal_of([&] { read_mission(file()); });
  }

  std::filesystem::path folder_;
};

}  // namespace omma
