// Alignment, bounds, and numbers as text.
#include "ground/idl/cdr_values.hpp"

#include <array>
#include <charconv>
#include <cstring>

namespace omma::idl {
namespace {

constexpr std::size_t kHeaderBytes = 4;

template <class Number>
std::string shortest(Number value) {
  std::array<char, 32> text{};
  const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

}  // namespace

CdrValues::CdrValues(std::span<const std::byte> cdr) {
  sound_ = cdr.size() > kHeaderBytes && cdr[0] == std::byte{0} && cdr[1] == std::byte{1};
  if (sound_) body_ = cdr.subspan(kHeaderBytes);
}

template <class Number>
Number CdrValues::number() {
  const std::size_t start = (at_ + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number);
  Number value{};
  if (!sound_ || start + sizeof value > body_.size()) {
    sound_ = false;
    return value;
  }
  std::memcpy(&value, body_.data() + start, sizeof value);
  at_ = start + sizeof value;
  return value;
}

std::string CdrValues::text(std::uint32_t bound) {
  const auto size = number<std::uint32_t>();  // with the zero at the end
  if (!sound_ || size == 0 || size > body_.size() - at_ || (bound > 0 && size - 1 > bound)) {
    sound_ = false;
    return {};
  }
  const char* first = reinterpret_cast<const char*>(body_.data() + at_);
  at_ += size;
  return {first, size - 1};
}

std::uint32_t CdrValues::length(const Member& member) {
  const auto count = number<std::uint32_t>();
  // No element is shorter than a byte: more elements than bytes are a lie.
  sound_ = sound_ && (member.bound == 0 || count <= member.bound) && count <= body_.size() - at_;
  return sound_ ? count : 0;
}

std::string CdrValues::scalar(const Schema& schema, const Member& member) {
  switch (member.kind) {
    case Kind::kBoolean:
      return number<std::uint8_t>() != 0 ? "true" : "false";
    case Kind::kOctet:
      return shortest(static_cast<unsigned>(number<std::uint8_t>()));
    case Kind::kInt16:
      return shortest(number<std::int16_t>());
    case Kind::kUint16:
      return shortest(number<std::uint16_t>());
    case Kind::kInt32:
      return shortest(number<std::int32_t>());
    case Kind::kUint32:
      return shortest(number<std::uint32_t>());
    case Kind::kInt64:
      return shortest(number<std::int64_t>());
    case Kind::kUint64:
      return shortest(number<std::uint64_t>());
    case Kind::kFloat:
      return shortest(number<float>());
    case Kind::kDouble:
      return shortest(number<double>());
    case Kind::kString:
      return text(member.string_bound);
    case Kind::kEnum: {
      const auto value = number<std::uint32_t>();
      const std::vector<std::string>& names = schema.enums.at(member.type_name).values;
      sound_ = sound_ && value < names.size();
      return sound_ ? names[value] : std::string();
    }
    case Kind::kStruct:
      break;
  }
  sound_ = false;
  return {};
}

namespace {

void add_leaves(const Schema& schema, const Struct& type, const std::string& prefix, CdrValues& values,
                std::vector<Leaf>& out) {
  for (const Member& member : type.members) {
    const bool many = member.is_sequence || member.array_size > 0;
    const std::uint32_t count = member.is_sequence ? values.length(member) : many ? member.array_size : 1;
    for (std::uint32_t i = 0; i < count && values.sound(); ++i) {
      const std::string path = prefix + member.name + (many ? "[" + std::to_string(i) + "]" : "");
      if (member.kind == Kind::kStruct)
        add_leaves(schema, schema.structs.at(member.type_name), path + ".", values, out);
      else
        out.push_back({path, values.scalar(schema, member)});
    }
  }
}

}  // namespace

std::optional<std::vector<Leaf>> leaves(const Schema& schema, const Struct& type,
                                        std::span<const std::byte> cdr) {
  CdrValues values(cdr);
  std::vector<Leaf> out;
  add_leaves(schema, type, "", values, out);
  if (!values.sound()) return std::nullopt;
  return out;
}

}  // namespace omma::idl
