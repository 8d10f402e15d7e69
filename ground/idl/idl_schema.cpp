#include "ground/idl/idl_schema.hpp"

#include <cctype>
#include <charconv>
#include <optional>

#include "fsw/kernel/input_error.hpp"

namespace omma::idl {
namespace {

constexpr int kDeepestNesting = 16;

struct Token {
  std::string_view text;  // empty: the end
  int line = 0;
};

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : text_(text), file_(file) { advance(); }

  Schema parse() {
    while (!token_.text.empty()) definition(0);
    return std::move(schema_);
  }

 private:
  [[noreturn]] void fail(std::string_view field, std::string_view expected) const {
    throw InputError(file_, token_.line, field, expected,
                     token_.text.empty() ? "the end of the text" : "'" + std::string(token_.text) + "'");
  }

  void skip_space_and_comments() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        if (text_[at_] == '\n') ++line_;
        ++at_;
      } else if (text_.substr(at_, 2) == "//") {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        const std::size_t stop = end == std::string_view::npos ? text_.size() : end + 2;
        for (; at_ < stop; ++at_)
          if (text_[at_] == '\n') ++line_;
      } else {
        return;
      }
    }
  }

  static bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  void advance() {
    skip_space_and_comments();
    const std::size_t start = at_;
    if (at_ < text_.size()) {
      if (in_word(text_[at_])) {
        while (at_ < text_.size() && in_word(text_[at_])) ++at_;
      } else {
        at_ += text_.substr(at_, 2) == "::" ? 2 : 1;
      }
    }
    token_ = {text_.substr(start, at_ - start), line_};
  }

  bool accept(std::string_view text) {
    if (token_.text != text) return false;
    advance();
    return true;
  }
  void expect(std::string_view text) {
    if (!accept(text)) fail("IDL", "'" + std::string(text) + "'");
  }
  std::string word(std::string_view field) {
    if (token_.text.empty() || !in_word(token_.text.front())) fail(field, "a name");
    std::string name(token_.text);
    advance();
    return name;
  }
  std::string qualified(const std::string& name) const {
    return scope_.empty() ? name : scope_ + "::" + name;
  }

  std::uint32_t number() {
    if (const auto known = constants_.find(token_.text); known != constants_.end()) {
      advance();
      return known->second;
    }
    std::uint32_t value = 0;
    const char* end = token_.text.data() + token_.text.size();
    const auto [stop, error] = std::from_chars(token_.text.data(), end, value);
    if (token_.text.empty() || error != std::errc{} || stop != end) fail("IDL", "a number or a constant");
    advance();
    return value;
  }

  /// Takes annotations; true when @key was among them.
  bool annotations() {
    bool is_key = false;
    while (accept("@")) {
      is_key = word("annotation") == "key" || is_key;
      if (accept("(")) {
        while (!token_.text.empty() && token_.text != ")") advance();
        expect(")");
      }
    }
    return is_key;
  }

  void definition(int depth) {
    if (depth > kDeepestNesting) fail("IDL", "fewer modules inside each other");
    annotations();
    if (accept("module")) {
      module(depth);
    } else if (accept("const")) {
      constant();
    } else if (accept("enum")) {
      enumeration();
    } else if (accept("struct")) {
      structure();
    } else {
      fail("IDL", "module, const, enum or struct");
    }
    expect(";");
  }

  void module(int depth) {
    const std::string outside = scope_;
    scope_ = qualified(word("module"));
    expect("{");
    while (token_.text != "}") {
      if (token_.text.empty()) fail("IDL", "'}'");
      definition(depth + 1);
    }
    expect("}");
    scope_ = outside;
  }

  void constant() {
    Member type;
    base_type(type);
    const std::string name = word("const");
    expect("=");
    constants_[name] = number();
  }

  void enumeration() {
    Enumeration result{qualified(word("enum")), {}};
    expect("{");
    do {
      result.values.push_back(word("enum"));
    } while (accept(","));
    expect("}");
    schema_.enums[result.name] = result;
  }

  void structure() {
    Struct result{qualified(word("struct")), {}};
    expect("{");
    while (!accept("}")) {
      Member member;
      member.is_key = annotations();
      if (accept("sequence")) {
        expect("<");
        member.is_sequence = true;
        base_type(member);
        if (accept(",")) member.bound = number();
        expect(">");
      } else {
        base_type(member);
      }
      member.name = word("member");
      if (accept("[")) {
        member.array_size = number();
        if (member.array_size == 0 || member.is_sequence)
          fail(member.name, "an array of at least one element");
        expect("]");
      }
      expect(";");
      result.members.push_back(member);
    }
    schema_.order.push_back(result.name);
    schema_.structs[result.name] = result;
  }

  void base_type(Member& member) {
    const bool is_unsigned = accept("unsigned");
    if (accept("short")) {
      member.kind = is_unsigned ? Kind::kUint16 : Kind::kInt16;
    } else if (accept("long")) {
      const bool wide = accept("long");
      member.kind =
          wide ? (is_unsigned ? Kind::kUint64 : Kind::kInt64) : (is_unsigned ? Kind::kUint32 : Kind::kInt32);
    } else if (is_unsigned) {
      fail("IDL", "short or long after unsigned");
    } else if (!simple_type(member)) {
      named_type(member);
    }
  }

  bool simple_type(Member& member) {
    if (accept("string")) {
      member.kind = Kind::kString;
      if (accept("<")) {
        member.string_bound = number();
        expect(">");
      }
      return true;
    }
    static const std::map<std::string_view, Kind> kSimple{{"boolean", Kind::kBoolean},
                                                          {"octet", Kind::kOctet},
                                                          {"float", Kind::kFloat},
                                                          {"double", Kind::kDouble}};
    const auto found = kSimple.find(token_.text);
    if (found == kSimple.end()) return false;
    member.kind = found->second;
    advance();
    return true;
  }

  static std::string outer(const std::string& scope) {
    const std::size_t end = scope.rfind("::");
    return end == std::string::npos ? std::string() : scope.substr(0, end);
  }

  void named_type(Member& member) {
    const Token at = token_;
    std::string name = word("type");
    while (accept("::")) name += "::" + word("type");
    // A type is declared before it is used, so no struct can hold itself; the innermost scope is asked first.
    for (std::string scope = scope_;; scope = outer(scope)) {
      member.type_name = scope;
      if (!scope.empty()) member.type_name += "::";
      member.type_name += name;
      if (schema_.enums.contains(member.type_name)) {
        member.kind = Kind::kEnum;
        return;
      }
      if (schema_.structs.contains(member.type_name)) {
        member.kind = Kind::kStruct;
        return;
      }
      if (scope.empty()) break;
    }
    token_ = at;
    fail("type", "a type declared before");
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
  Token token_;
  std::string scope_;
  std::map<std::string, std::uint32_t, std::less<>> constants_;
  Schema schema_;
};

}  // namespace

Schema parse(std::string_view text, const std::string& file) {
  return Parser(text, file).parse();
}

bool same_type(const Schema& a, const Schema& b, std::string_view name) {
  const auto in_a = a.structs.find(name);
  const auto in_b = b.structs.find(name);
  if (in_a == a.structs.end() || in_b == b.structs.end()) return false;
  if (in_a->second.members != in_b->second.members) return false;
  for (const Member& member : in_a->second.members) {
    if (member.kind == Kind::kStruct && !same_type(a, b, member.type_name)) return false;
    if (member.kind == Kind::kEnum &&
        a.enums.at(member.type_name).values != b.enums.at(member.type_name).values) {
      return false;
    }
  }
  return true;
}

}  // namespace omma::idl
