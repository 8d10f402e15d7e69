// Reads a TOML file strictly: every key is asked for with its type and range, every error names file, line
// and field, and a key nobody asked for is refused. Used at start-up and on the ground only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/kernel/input_error.hpp"

namespace omma {

/// Bounds of a number, both included.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

class TomlTable {
 public:
  /// The root of a file; InputError where it is missing or is not TOML.
  static TomlTable read(const std::filesystem::path& file);

  bool has(std::string_view key) const;

  // A key that must be there.
  std::string text(std::string_view key) const;
  double number(std::string_view key, Range range = {}) const;  ///< an integer is a number too; never NaN
  std::int64_t integer(std::string_view key, Range range = {}) const;
  std::vector<double> numbers(std::string_view key, std::size_t count) const;  ///< exactly `count`
  /// Any number of them, `group` at a time and one group at least.
  std::vector<double> number_list(std::string_view key, std::size_t group = 1) const;
  TomlTable table(std::string_view key) const;
  std::vector<TomlTable> tables(std::string_view key) const;  ///< [[key]], at least one

  /// The keys of the table, for tables whose keys the user chooses.
  std::vector<std::string> keys() const;
  /// A whole number, a text, or true and false (1 and 0), as text.
  std::string word(std::string_view key) const;

  // A key that may be left out.
  std::string text(std::string_view key, std::string_view otherwise) const;
  double number(std::string_view key, Range range, double otherwise) const;
  std::int64_t integer(std::string_view key, Range range, std::int64_t otherwise) const;
  bool flag(std::string_view key, bool otherwise) const;
  std::vector<double> numbers(std::string_view key, std::size_t count,
                              const std::vector<double>& otherwise) const;
  std::optional<TomlTable> table_if(std::string_view key) const;
  std::vector<TomlTable> tables_if(std::string_view key) const;  ///< empty where there is none

  /// InputError at the first key of this table that none of the calls above asked for.
  void refuse_unknown_keys() const;

  /// A path written in the file, taken relative to the file's own folder.
  std::filesystem::path path(std::string_view key) const;
  const std::string& file() const { return file_; }
  /// An error at `key` of this table (at the table itself where there is no such key).
  InputError error(std::string_view key, std::string_view expected, std::string_view found) const;

 private:
  struct Node;  // hides the TOML library from those who include this file
  TomlTable(std::string file, std::string prefix, std::shared_ptr<const Node> node);
  const Node* find(std::string_view key) const;
  std::vector<double> all_numbers(std::string_view key, const std::string& expected) const;

  std::string file_;
  std::string prefix_;  // "camera[1]."
  std::shared_ptr<const Node> node_;
  std::shared_ptr<std::set<std::string, std::less<>>> asked_;
};

}  // namespace omma
