// Strict TOML: right values are read, wrong ones are named by file, line and field.
#include "fsw/services/toml_table.hpp"
#include "tests/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace omma {
namespace {

using ::testing::HasSubstr;

std::filesystem::path file_with(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("omma_toml_" + std::to_string(std::hash<std::string>{}(text)) + ".toml");
  std::ofstream(path) << text;
  return path;
}

template <class Read>
std::string message_of(const std::string& text, Read read) {
  return refusal_of([&] { read(TomlTable::read(file_with(text))); });
}

TEST(TomlTable, ReadsEachKind) {
  const TomlTable table =
      TomlTable::read(file_with("name = \"rig\"\nrate = 2\nlist = [1, 2.5]\non = true\n[inner]\nx = "
                                "1.5\n[[camera]]\nid = 1\n[[camera]]\nid = 2\n"));
  EXPECT_EQ(table.text("name"), "rig");
  EXPECT_EQ(table.number("rate"), 2.0);
  EXPECT_EQ(table.integer("rate"), 2);
  EXPECT_EQ(table.numbers("list", 2), (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(table.flag("on", false));
  EXPECT_EQ(table.table("inner").number("x"), 1.5);
  EXPECT_EQ(table.tables("camera")[1].integer("id"), 2);
  EXPECT_EQ(table.number("absent", {}, 7.0), 7.0);
  table.refuse_unknown_keys();
}

TEST(TomlTable, NamesLineAndFieldOfAWrongValue) {
  const std::string message = message_of("a = 1\n[[camera]]\nrate = \"fast\"\n", [](const TomlTable& table) {
    table.tables("camera")[0].number("rate", {0, 10});
  });
  EXPECT_THAT(message, HasSubstr(".toml:3: camera[0].rate: expected a number from 0 to 10, found 'fast'"));
}

TEST(TomlTable, RefusesAnUnknownKeyAtItsLine) {
  const std::string message = message_of("name = \"a\"\nnmae = \"b\"\n", [](const TomlTable& table) {
    table.text("name");
    table.refuse_unknown_keys();
  });
  EXPECT_THAT(message, HasSubstr(".toml:2: nmae: expected one of name, found an unknown key"));
}

TEST(TomlTable, RefusesNotANumberOutOfRangeAndMissing) {
  EXPECT_THAT(message_of("x = nan\n", [](const TomlTable& t) { t.number("x"); }),
              HasSubstr("expected a number"));
  EXPECT_THAT(message_of("x = 11\n",
                         [](const TomlTable& t) {
                           t.number("x", {0, 10});
                         }),
              HasSubstr("found 11"));
  EXPECT_THAT(message_of("y = 1\n", [](const TomlTable& t) { t.number("x"); }), HasSubstr("found nothing"));
  EXPECT_THAT(message_of("x = 1.5\n", [](const TomlTable& t) { t.integer("x"); }),
              HasSubstr("a whole number"));
  EXPECT_THAT(message_of("x = [1]\n", [](const TomlTable& t) { t.numbers("x", 2); }),
              HasSubstr("an array of 1"));
}

TEST(TomlTable, SaysWhereTheSyntaxBreaks) {
  EXPECT_THAT(message_of("a = 1\nb = = 2\n", [](const TomlTable&) {}), HasSubstr(".toml:2: syntax"));
}

TEST(TomlTable, SaysThatTheFileIsMissing) {
  EXPECT_THROW(TomlTable::read("/nonexistent/mission.toml"), InputError);
}

}  // namespace
}  // namespace omma
