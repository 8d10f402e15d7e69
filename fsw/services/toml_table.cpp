#include "fsw/services/toml_table.hpp"

#include <toml++/toml.h>
#include <cmath>
#include <sstream>

namespace omma {

// The library's table, and the parsed file that keeps it alive.
struct TomlTable::Node {
  std::shared_ptr<const toml::table> root;
  const toml::table* table = nullptr;
};

namespace {

std::string shown(const toml::node& node) {
  std::ostringstream out;
  if (node.is_table()) return "a table";
  if (node.is_array()) {
    out << "an array of " << node.as_array()->size();
    return out.str();
  }
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) out << value;
  });
  return out.str();
}

std::string shown(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string range_text(std::string_view what, Range range) {
  std::string text(what);
  const bool has_least = std::isfinite(range.least);
  const bool has_most = std::isfinite(range.most);
  if (has_least && has_most) return text + " from " + shown(range.least) + " to " + shown(range.most);
  if (has_least) return text + " of at least " + shown(range.least);
  if (has_most) return text + " of at most " + shown(range.most);
  return text;
}

int line_of(const toml::node* node) {
  return node == nullptr ? 0 : static_cast<int>(node->source().begin.line);
}

}  // namespace

TomlTable::TomlTable(std::string file, std::string prefix, std::shared_ptr<const Node> node)
    : file_(std::move(file)),
      prefix_(std::move(prefix)),
      node_(std::move(node)),
      asked_(std::make_shared<std::set<std::string, std::less<>>>()) {}

TomlTable TomlTable::read(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(file.string(), 0, "file", "a TOML file", "no such file");
  try {
    auto root = std::make_shared<const toml::table>(toml::parse_file(file.string()));
    const toml::table* top = root.get();
    return {file.string(), "", std::make_shared<const Node>(Node{std::move(root), top})};
  } catch (const toml::parse_error& error) {
    throw InputError(file.string(), static_cast<int>(error.source().begin.line), "syntax", "TOML",
                     error.description());
  }
}

InputError TomlTable::error(std::string_view key, std::string_view expected, std::string_view found) const {
  const toml::node* node = node_->table->get(key);
  return {file_, line_of(node != nullptr ? node : node_->table), prefix_ + std::string(key), expected, found};
}

bool TomlTable::has(std::string_view key) const {
  asked_->emplace(key);
  return node_->table->contains(key);
}

std::string TomlTable::text(std::string_view key) const {
  if (!has(key)) throw error(key, "a text", "nothing");
  const auto value = node_->table->get(key)->value_exact<std::string>();
  if (!value) throw error(key, "a text", shown(*node_->table->get(key)));
  return *value;
}

double TomlTable::number(std::string_view key, Range range) const {
  const std::string expected = range_text("a number", range);
  if (!has(key)) throw error(key, expected, "nothing");
  const toml::node& node = *node_->table->get(key);
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value) || *value < range.least || *value > range.most) {
    throw error(key, expected, shown(node));
  }
  return *value;
}

std::int64_t TomlTable::integer(std::string_view key, Range range) const {
  const std::string expected = range_text("a whole number", range);
  if (!has(key)) throw error(key, expected, "nothing");
  const toml::node& node = *node_->table->get(key);
  const auto value = node.value_exact<std::int64_t>();
  if (!value || static_cast<double>(*value) < range.least || static_cast<double>(*value) > range.most) {
    throw error(key, expected, shown(node));
  }
  return *value;
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count) const {
  const std::string expected = "an array of " + std::to_string(count) + " numbers";
  if (!has(key)) throw error(key, expected, "nothing");
  const toml::node& node = *node_->table->get(key);
  if (node.as_array() == nullptr || node.as_array()->size() != count) throw error(key, expected, shown(node));
  return all_numbers(key, expected);
}

std::vector<double> TomlTable::number_list(std::string_view key, std::size_t group) const {
  const std::string expected =
      group == 1 ? "an array of numbers" : "an array of numbers, " + std::to_string(group) + " to each";
  if (!has(key)) throw error(key, expected, "nothing");
  const toml::node& node = *node_->table->get(key);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty() || array->size() % group != 0)
    throw error(key, expected, shown(node));
  return all_numbers(key, expected);
}

std::vector<double> TomlTable::all_numbers(std::string_view key, const std::string& expected) const {
  std::vector<double> values;
  for (const toml::node& item : *node_->table->get(key)->as_array()) {
    const auto value = item.is_number() ? item.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) throw error(key, expected, shown(item) + " among them");
    values.push_back(*value);
  }
  return values;
}

TomlTable TomlTable::table(std::string_view key) const {
  if (!has(key)) throw error(key, "a table", "nothing");
  const toml::table* inner = node_->table->get(key)->as_table();
  if (inner == nullptr) throw error(key, "a table", shown(*node_->table->get(key)));
  return {file_, prefix_ + std::string(key) + ".", std::make_shared<const Node>(Node{node_->root, inner})};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  if (!has(key)) throw error(key, "at least one [[" + std::string(key) + "]]", "none");
  const toml::array* array = node_->table->get(key)->as_array();
  if (array == nullptr || !array->is_array_of_tables()) {
    throw error(key, "[[" + std::string(key) + "]] tables", shown(*node_->table->get(key)));
  }
  std::vector<TomlTable> result;
  for (std::size_t i = 0; i < array->size(); ++i) {
    result.push_back(TomlTable(file_, prefix_ + std::string(key) + "[" + std::to_string(i) + "].",
                               std::make_shared<const Node>(Node{node_->root, (*array)[i].as_table()})));
  }
  return result;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, node] : *node_->table) keys.emplace_back(key.str());
  return keys;
}

std::string TomlTable::word(std::string_view key) const {
  const std::string expected = "a whole number, a text, true or false";
  if (!has(key)) throw error(key, expected, "nothing");
  const toml::node& node = *node_->table->get(key);
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "1" : "0";
  throw error(key, expected, shown(node));
}

std::string TomlTable::text(std::string_view key, std::string_view otherwise) const {
  return has(key) ? text(key) : std::string(otherwise);
}
double TomlTable::number(std::string_view key, Range range, double otherwise) const {
  return has(key) ? number(key, range) : otherwise;
}
std::int64_t TomlTable::integer(std::string_view key, Range range, std::int64_t otherwise) const {
  return has(key) ? integer(key, range) : otherwise;
}
std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count,
                                       const std::vector<double>& otherwise) const {
  return has(key) ? numbers(key, count) : otherwise;
}
std::optional<TomlTable> TomlTable::table_if(std::string_view key) const {
  return has(key) ? std::optional(table(key)) : std::nullopt;
}
std::vector<TomlTable> TomlTable::tables_if(std::string_view key) const {
  return has(key) ? tables(key) : std::vector<TomlTable>{};
}

bool TomlTable::flag(std::string_view key, bool otherwise) const {
  if (!has(key)) return otherwise;
  const auto value = node_->table->get(key)->value_exact<bool>();
  if (!value) throw error(key, "true or false", shown(*node_->table->get(key)));
  return *value;
}

void TomlTable::refuse_unknown_keys() const {
  for (const auto& [key, node] : *node_->table) {
    if (asked_->contains(key.str())) continue;
    std::string known;
    for (const std::string& name : *asked_) known += (known.empty() ? "" : ", ") + name;
    throw InputError(file_, static_cast<int>(key.source().begin.line), prefix_ + std::string(key.str()),
                     "one of " + known, "an unknown key");
  }
}

std::filesystem::path TomlTable::path(std::string_view key) const {
  const std::filesystem::path written = text(key);
  return written.is_absolute() ? written : std::filesystem::path(file_).parent_path() / written;
}

}  // namespace omma
