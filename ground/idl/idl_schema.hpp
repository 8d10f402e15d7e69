// The IDL as a recording carries it, parsed: enough of OMG IDL 4.2 for telemetry (modules, constants, enums,
// final structs, bounded and unbounded strings and sequences, arrays), so that any recording can be
// exported and compared by its own description.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace omma::idl {

enum class Kind : std::uint8_t {
  kBoolean,
  kOctet,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat,
  kDouble,
  kString,
  kEnum,
  kStruct,
};

struct Member {
  std::string name;
  Kind kind = Kind::kBoolean;
  std::string type_name;         ///< of an enum or a struct, with its module: omma::Dot
  std::uint32_t array_size = 0;  ///< 0: not an array
  bool is_sequence = false;
  std::uint32_t bound = 0;         ///< of the sequence; 0: none
  std::uint32_t string_bound = 0;  ///< 0: none
  bool is_key = false;

  friend bool operator==(const Member&, const Member&) = default;
};

struct Struct {
  std::string name;  ///< with its module
  std::vector<Member> members;
};

struct Enumeration {
  std::string name;  ///< with its module
  std::vector<std::string> values;
};

struct Schema {
  std::map<std::string, Struct, std::less<>> structs;
  std::map<std::string, Enumeration, std::less<>> enums;
  std::vector<std::string> order;  ///< names of the structs as they were declared
};

/// Throws InputError with the line of what it cannot take.
/// @param file  what to call the text in that error
Schema parse(std::string_view text, const std::string& file);

/// True when both describe the same bytes for the struct `name`, and by the same names.
bool same_type(const Schema& a, const Schema& b, std::string_view name);

}  // namespace omma::idl
