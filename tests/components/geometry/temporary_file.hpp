// A text file that lives as long as its object; for the tests of the readers.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace omma {

class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, std::string_view text)
      : path_(std::filesystem::path(testing::TempDir()) / (unique_prefix() + name)) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path() const { return path_.string(); }
  std::string name() const { return path_.filename().string(); }

 private:
  // Tests run side by side: each has its own names.
  static std::string unique_prefix() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return std::string("omma_") + test->test_suite_name() + "_" + test->name() + "_";
  }
  std::filesystem::path path_;
};

/// The message of the InputError that `call` throws; empty where it throws none.
template <class Error, class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace omma
