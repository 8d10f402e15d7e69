// Values read from a sample's bytes by the IDL a recording carries, one after the other: works for any
// version of any topic. (XCDR version 1, little endian: DDS-XTypes 1.3, 7.4.1.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ground/idl/idl_schema.hpp"

namespace omma::idl {

class CdrValues {
 public:
  /// @param cdr  with its encapsulation header; another encapsulation, or bytes that end too early, make
  /// `sound` false
  explicit CdrValues(std::span<const std::byte> cdr);

  /// The next value, of a member that is neither struct nor sequence, as text: numbers in the shortest form
  /// that reads back the same, enumerators by name.
  std::string scalar(const Schema& schema, const Member& member);
  /// Elements of the sequence that comes next; 0 where its bound is broken.
  std::uint32_t length(const Member& member);

  /// False once something was not there or not allowed; what was read since is not to be used.
  bool sound() const { return sound_; }

 private:
  template <class Number>
  Number number();
  std::string text(std::uint32_t bound);

  std::span<const std::byte> body_;  // after the header, to which values are aligned
  std::size_t at_ = 0;
  bool sound_ = true;
};

/// One number, text or flag of a sample.
struct Leaf {
  std::string path;  ///< "cameras[1].dots_kept"
  std::string text;
};

/// All values of a sample in order; none where the bytes are not of that type.
std::optional<std::vector<Leaf>> leaves(const Schema& schema, const Struct& type,
                                        std::span<const std::byte> cdr);

}  // namespace omma::idl
