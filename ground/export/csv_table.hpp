// One topic as a table: its columns, and the rows of each sample, by the IDL of the recording. A sample that
// holds a sequence of structs (dots, cameras, steps) gives one row an element, the rest of the sample
// repeated in each; without elements it gives one row with those cells empty. A short sequence of numbers has
// a column each; of a long one (pixels) there is its length.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ground/idl/cdr_values.hpp"

namespace omma::ground {

class CsvTable {
 public:
  /// Throws InputError where the type cannot be laid out (two sequences of structs, or one inside another).
  /// @param file  for that error
  CsvTable(const idl::Schema& schema, const std::string& type, const std::string& file);

  /// Column names with their units, comma between.
  std::string header() const;
  /// Rows of one sample, each ended by a line end; none where the bytes are not of the type.
  std::optional<std::string> rows(std::span<const std::byte> cdr) const;

 private:
  void add_columns(const idl::Struct& type, const std::string& prefix, bool in_element,
                   const std::string& file);
  void read_cells(const idl::Struct& type, idl::CdrValues& values, std::vector<std::string>& cells,
                  std::vector<std::vector<std::string>>* elements) const;

  const idl::Schema& schema_;
  const idl::Struct& type_;
  std::vector<std::string> columns_;          // of the sample
  std::vector<std::string> element_columns_;  // of the sequence of structs
  bool has_elements_ = false;
};

}  // namespace omma::ground
