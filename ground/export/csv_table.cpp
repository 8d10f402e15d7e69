// Layout of columns and cells.
#include "ground/export/csv_table.hpp"

#include <algorithm>

#include "fsw/kernel/input_error.hpp"

namespace omma::ground {
namespace {

using idl::Kind;
using idl::Member;

// A longer sequence of numbers is data of its own (pixels), not columns.
constexpr std::uint32_t kMostColumns = 16;

/// "covariance[7]" of a pose is (rotation y, rotation y): axes and unit instead of a number.
std::string covariance_column(const std::string& name, std::uint32_t size, std::uint32_t index) {
  static constexpr const char* kAxes[] = {"rx", "ry", "rz", "px", "py", "pz"};
  const std::uint32_t side = size == 36 ? 6 : 3;
  const std::uint32_t row = index / side;
  const std::uint32_t column = index % side;
  std::string stem = name;
  if (const std::size_t unit = stem.rfind("_rad2"); unit != std::string::npos) stem.resize(unit);
  const char* unit = row < 3 && column < 3 ? "rad2" : row >= 3 && column >= 3 ? "m2" : "rad_m";
  return stem + "_" + kAxes[row] + "_" + kAxes[column] + "_" + unit;
}

std::string array_column(const std::string& prefix, const Member& member, std::uint32_t index) {
  const bool is_covariance =
      member.name.starts_with("covariance") && (member.array_size == 9 || member.array_size == 36);
  if (is_covariance) return prefix + covariance_column(member.name, member.array_size, index);
  return prefix + member.name + "_" + std::to_string(index);
}

/// As RFC 4180 wants it.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void append_line(std::string& out, const std::vector<std::string>& first,
                 const std::vector<std::string>& second) {
  const char* separator = "";
  for (const auto* part : {&first, &second}) {
    for (const std::string& text : *part) {
      out += separator;
      out += cell(text);
      separator = ",";
    }
  }
  out += '\n';
}

bool is_short(const Member& member) {
  return member.bound > 0 && member.bound <= kMostColumns;
}

}  // namespace

CsvTable::CsvTable(const idl::Schema& schema, const std::string& type, const std::string& file)
    : schema_(schema), type_(schema.structs.at(type)) {
  add_columns(type_, "", false, file);
}

void CsvTable::add_columns(const idl::Struct& type, const std::string& prefix, bool in_element,
                           const std::string& file) {
  std::vector<std::string>& columns = in_element ? element_columns_ : columns_;
  for (const Member& member : type.members) {
    if (member.is_sequence && member.kind == Kind::kStruct) {
      if (has_elements_ || in_element || !prefix.empty())
        throw InputError(file, 0, type.name, "one sequence of structs at most, directly in the topic",
                         "another, " + member.name);
      has_elements_ = true;
      element_columns_.push_back(member.name + "_index");
      add_columns(schema_.structs.at(member.type_name), member.name + ".", true, file);
    } else if (member.is_sequence) {
      columns.push_back(prefix + member.name + "_count");
      for (std::uint32_t i = 0; is_short(member) && i < member.bound; ++i)
        columns.push_back(prefix + member.name + "_" + std::to_string(i));
    } else if (member.kind == Kind::kStruct) {
      for (std::uint32_t i = 0; i < std::max(member.array_size, 1U); ++i)
        add_columns(schema_.structs.at(member.type_name),
                    prefix + member.name + (member.array_size > 0 ? "_" + std::to_string(i) : "") + ".",
                    in_element, file);
    } else if (member.array_size > 0) {
      for (std::uint32_t i = 0; i < member.array_size; ++i)
        columns.push_back(array_column(prefix, member, i));
    } else {
      columns.push_back(prefix + member.name);
    }
  }
}

std::string CsvTable::header() const {
  std::string line;
  append_line(line, columns_, element_columns_);
  return line;
}

void CsvTable::read_cells(const idl::Struct& type, idl::CdrValues& values, std::vector<std::string>& cells,
                          std::vector<std::vector<std::string>>* elements) const {
  for (const Member& member : type.members) {
    const bool is_struct = member.kind == Kind::kStruct;
    if (member.is_sequence && is_struct) {
      const std::uint32_t count = values.length(member);
      for (std::uint32_t i = 0; i < count && values.sound(); ++i) {
        std::vector<std::string>& element = elements->emplace_back();
        element.push_back(std::to_string(i));
        read_cells(schema_.structs.at(member.type_name), values, element, nullptr);
      }
    } else if (member.is_sequence) {
      const std::uint32_t count = values.length(member);
      cells.push_back(std::to_string(count));
      for (std::uint32_t i = 0; i < std::max(count, is_short(member) ? member.bound : 0U); ++i) {
        std::string text = i < count && values.sound() ? values.scalar(schema_, member) : std::string();
        if (is_short(member)) cells.push_back(std::move(text));
      }
    } else {
      for (std::uint32_t i = 0; i < std::max(member.array_size, 1U) && values.sound(); ++i) {
        if (is_struct)
          read_cells(schema_.structs.at(member.type_name), values, cells, elements);
        else
          cells.push_back(values.scalar(schema_, member));
      }
    }
  }
}

std::optional<std::string> CsvTable::rows(std::span<const std::byte> cdr) const {
  idl::CdrValues values(cdr);
  std::vector<std::string> cells;
  std::vector<std::vector<std::string>> elements;
  read_cells(type_, values, cells, &elements);
  if (!values.sound()) return std::nullopt;
  if (has_elements_ && elements.empty()) elements.emplace_back(element_columns_.size());
  std::string text;
  if (!has_elements_) append_line(text, cells, {});
  for (const std::vector<std::string>& element : elements) append_line(text, cells, element);
  return text;
}

}  // namespace omma::ground
