// The shape of the source tree: who may include whom, how long a file may be, how it begins. Reads the
// sources as text; a broken rule is named with file and line.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.hpp"

namespace {

namespace fs = std::filesystem;

constexpr int kLongestFile = 450;  // lines; more is two ideas

struct Include {
  std::string path;  // as written: from the root of the tree
  int line = 0;
};

struct Source {
  std::vector<std::string> lines;
  std::vector<Include> includes;
};

using Tree = std::map<std::string, Source>;  // by path from the root

Source read_source(const fs::path& file) {
  Source source;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    source.lines.push_back(line);
    constexpr std::string_view kStart = "#include \"";
    if (line.rfind(kStart, 0) != 0) continue;
    const std::size_t end = line.find('"', kStart.size());
    source.includes.push_back(
        {line.substr(kStart.size(), end - kStart.size()), static_cast<int>(source.lines.size())});
  }
  return source;
}

const Tree& tree() {
  static const Tree all = [] {
    Tree read;
    const fs::path root = OMMA_SOURCE_DIR;
    for (const char* folder : {"fsw", "hal", "components", "config", "sim", "ground", "tests"}) {
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension == ".hpp" || extension == ".cpp")
          read[fs::relative(entry.path(), root).string()] = read_source(entry.path());
      }
    }
    return read;
  }();
  return all;
}

bool starts(std::string_view path, std::string_view folder) {
  return path.rfind(folder, 0) == 0;
}

/// "components/tracker/": the part of the tree a file belongs to.
std::string box(const std::string& path) {
  const std::size_t first = path.find('/');
  const std::size_t second = path.find('/', first + 1);
  const std::string top = path.substr(0, first);
  if (second == std::string::npos || top == "sim" || top == "ground" || top == "tests" || top == "config")
    return top + "/";
  return path.substr(0, second + 1);
}

/// A file that knows of components and ports, itself or through what it includes.
bool is_framework_bound(const std::string& path, std::set<std::string>& visited) {
  static const std::set<std::string> kFramework{"fsw/kernel/component.hpp", "fsw/kernel/port.hpp"};
  if (kFramework.count(path) > 0) return true;
  if (!visited.insert(path).second) return false;
  const auto at = tree().find(path);
  if (at == tree().end()) return false;
  for (const Include& include : at->second.includes)
    if (is_framework_bound(include.path, visited)) return true;
  return false;
}

bool is_pure(const std::string& path) {
  std::set<std::string> visited;
  return !is_framework_bound(path, visited);
}

bool is_shared_component(std::string_view target) {
  return starts(target, "components/geometry/") || starts(target, "components/catalogue/") ||
         starts(target, "components/estimation/");
}

/// Messages and algorithms of any box: no component among them.
bool is_pure_component_file(const std::string& target) {
  return starts(target, "components/") && is_pure(target);
}

bool is_hal_interface(const std::string& target) {
  return box(target) == "hal/" && starts(target, "hal/");
}

bool may_include(const std::string& file, const std::string& target) {
  const std::string from = box(file);
  const std::string to = box(target);
  if (to == from || to == "config/") return true;
  if (from == "tests/") return true;
  if (to == "tests/") return false;
  if (from == "fsw/kernel/" || from == "config/") return false;
  if (to == "fsw/kernel/") return true;
  if (from == "fsw/services/") return false;
  if (from == "fsw/app/") return to != "sim/" && to != "ground/";
  if (to == "fsw/app/") return false;
  if (from == "hal/sources/") return starts(to, "hal/");  // the one that knows all live drivers
  // libcamera's frames come from another process.
  if (from == "hal/libcamera/" && to == "hal/shared_frames/") return true;
  if (starts(from, "hal/"))
    return is_hal_interface(target) || to == "hal/live/" || target == "fsw/services/text_input.hpp";
  if (to == "fsw/services/") return true;
  if (is_hal_interface(target)) return true;
  if (starts(from, "components/")) return is_shared_component(target) || is_pure_component_file(target);
  if (from == "sim/") return is_pure_component_file(target) || to == "hal/recorded/";
  if (from == "ground/") return is_pure_component_file(target) || starts(to, "hal/") || to == "sim/";
  return false;
}

TEST(Tree, IncludesPointOneWay) {
  ASSERT_GT(tree().size(), 50U);
  for (const auto& [file, source] : tree()) {
    for (const Include& include : source.includes) {
      const bool ours = tree().count(include.path) > 0;
      if (!ours) continue;  // generated, or a library's
      EXPECT_TRUE(may_include(file, include.path))
          << file << ":" << include.line << " may not include " << include.path;
    }
  }
}

TEST(Tree, TheRuleKnowsWrongFromRight) {
  EXPECT_FALSE(may_include("fsw/kernel/clock.hpp", "fsw/services/events.hpp"));
  EXPECT_FALSE(may_include("fsw/kernel/clock.hpp", "components/geometry/rig.hpp"));
  EXPECT_FALSE(may_include("fsw/services/events.hpp", "components/geometry/rig.hpp"));
  EXPECT_FALSE(may_include("hal/recorded/x.cpp", "components/geometry/rig.hpp"));
  EXPECT_FALSE(may_include("components/tracker/x.hpp", "components/attitude/attitude.hpp"));
  EXPECT_FALSE(may_include("components/tracker/x.hpp", "hal/recorded/image_file.hpp"));
  EXPECT_FALSE(may_include("components/tracker/x.hpp", "fsw/app/mission.hpp"));
  EXPECT_FALSE(may_include("ground/x.cpp", "components/attitude/attitude.hpp"));
  EXPECT_FALSE(may_include("sim/x.cpp", "tests/bench/measure.hpp"));
  EXPECT_FALSE(may_include("fsw/app/main.cpp", "sim/x.hpp"));
  EXPECT_TRUE(may_include("components/tracker/x.hpp", "components/extractor/dot.hpp"));
  EXPECT_TRUE(may_include("components/tracker/x.hpp", "config/limits.hpp"));
  EXPECT_FALSE(may_include("hal/v4l2/x.cpp", "hal/sources/live_drivers.hpp"));
  EXPECT_TRUE(may_include("hal/v4l2/x.cpp", "hal/live/frame_source.hpp"));
  EXPECT_TRUE(may_include("ground/x.cpp", "components/geometry/rig.hpp"));
  EXPECT_TRUE(may_include("fsw/app/main.cpp", "components/attitude/attitude.hpp"));
}

TEST(Tree, NoFileIsTwoIdeasLong) {
  for (const auto& [file, source] : tree())
    EXPECT_LE(source.lines.size(), static_cast<std::size_t>(kLongestFile)) << file;
}

// A source file beside its header is told by that; a test by what it includes and its names.
TEST(Tree, EveryFileSaysWhatItIsFor) {
  for (const auto& [file, source] : tree()) {
    ASSERT_FALSE(source.lines.empty()) << file;
    const std::string header = file.substr(0, file.size() - 4) + ".hpp";
    if (starts(file, "tests/") || (fs::path(file).extension() == ".cpp" && tree().count(header) > 0))
      continue;
    EXPECT_TRUE(starts(source.lines[0], "// ")) << file << " does not begin with a comment";
  }
}

// c_library_test holds what the functions that are used give; others are not the same everywhere, or not
// looked at.
TEST(Tree, FlightCodeCallsNoFunctionThatDiffersBetweenMachines) {
  const std::regex differs(
      R"(\bstd::(hypot|cbrt|erfc?|[tl]gamma|fma|cosh|tanh|acosh|atanh|expm1|exp2|log2)\()");
  ASSERT_TRUE(std::regex_search("x = std::hypot(a, b)", differs));
  for (const auto& [file, source] : tree()) {
    if (!starts(file, "components/") && !starts(file, "fsw/")) continue;
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      const std::string& line = source.lines[i];
      const bool comment = line.find("//") < line.find("std::");
      EXPECT_TRUE(comment || !std::regex_search(line, differs)) << file << ":" << i + 1 << ": " << line;
    }
  }
}

TEST(Tree, EveryHeaderIsIncludedOnce) {
  for (const auto& [file, source] : tree()) {
    if (fs::path(file).extension() != ".hpp") continue;
    bool guarded = false;
    for (const std::string& line : source.lines) guarded = guarded || line == "#pragma once";
    EXPECT_TRUE(guarded) << file;
  }
}

}  // namespace
