// The IDL parser: what a recording's description says, and sentences for what it cannot take.
#include "ground/idl/idl_schema.hpp"

#include <gtest/gtest.h>

#include "components/telemetry/topics.hpp"
#include "fsw/kernel/input_error.hpp"
#include "tests/refusal.hpp"

namespace omma::idl {
namespace {

std::string error_of(std::string_view text) {
  return refusal_of([&] { parse(text, "x.idl"); });
}

TEST(IdlSchema, KnowsEveryTopicAndItsMembers) {
  const Schema schema = parse(telemetry::idl_text(), "omma.idl");
  for (const telemetry::Topic& topic : telemetry::topics()) {
    ASSERT_TRUE(schema.structs.contains(topic.type_name)) << topic.type_name;
    const std::vector<Member>& members = schema.structs.find(topic.type_name)->second.members;
    ASSERT_GE(members.size(), 4U);
    EXPECT_EQ(members[0].name, "frame");
    EXPECT_EQ(members[0].kind, Kind::kUint64);
    EXPECT_EQ(members[1].name, "time_ns");
    EXPECT_EQ(members[1].kind, Kind::kInt64);
    EXPECT_EQ(members[2].name, "sample_number");
    EXPECT_EQ(members[3].name, "valid");
    EXPECT_EQ(members[3].kind, Kind::kBoolean);
  }
}

TEST(IdlSchema, ReadsEveryFormOfMember) {
  const Schema schema = parse(
      "module a { const unsigned long N = 4; enum E { X, Y }; /* two\nlines */"
      "@final struct In { double v[N]; }; module b { @final @topic(name=\"t\") struct S {"
      "  @key octet k; string free; string<N> text; sequence<a::In, 3> list; sequence<octet> raw;"
      "  E e; unsigned long long big; short small; In one; boolean yes; float f; }; }; };",
      "x.idl");
  const std::vector<Member>& s = schema.structs.find("a::b::S")->second.members;
  ASSERT_EQ(s.size(), 11U);
  EXPECT_TRUE(s[0].is_key);
  EXPECT_EQ(s[1].string_bound, 0U);
  EXPECT_EQ(s[2].string_bound, 4U);
  EXPECT_TRUE(s[3].is_sequence);
  EXPECT_EQ(s[3].bound, 3U);
  EXPECT_EQ(s[3].type_name, "a::In");
  EXPECT_EQ(s[4].kind, Kind::kOctet);
  EXPECT_EQ(s[4].bound, 0U);
  EXPECT_EQ(s[6].kind, Kind::kUint64);
  EXPECT_EQ(s[7].kind, Kind::kInt16);
  EXPECT_EQ(schema.structs.find("a::In")->second.members[0].array_size, 4U);
}

TEST(IdlSchema, SaysLineAndWhatIsWrong) {
  EXPECT_EQ(error_of("module a {\n struct S { double };\n};"), "x.idl:2: member: expected a name, found '}'");
  EXPECT_EQ(error_of("module a {\n\n struct S { Other o; };\n};"),
            "x.idl:3: type: expected a type declared before, found 'Other'");
  EXPECT_EQ(error_of("module a {"), "x.idl:1: IDL: expected '}', found the end of the text");
  EXPECT_EQ(error_of("union U;"), "x.idl:1: IDL: expected module, const, enum or struct, found 'union'");
  EXPECT_EQ(error_of("struct S { double x[many]; };"),
            "x.idl:1: IDL: expected a number or a constant, found 'many'");
}

TEST(IdlSchema, EveryTruncationOfOurOwnIsASentenceOrASmallerSchema) {
  const std::string_view text = telemetry::idl_text();
  for (std::size_t size = 0; size < text.size(); size += 7) {
    try {
      parse(text.substr(0, size), "x.idl");
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos);
    }
  }
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "module m {";
  EXPECT_NE(error_of(deep).find("fewer modules"), std::string::npos);
}

TEST(IdlSchema, ComparesTypesByTheirMembersAndNotByTheirComments) {
  const Schema a = parse("struct In { float x; }; struct S { In i; };", "a");
  EXPECT_TRUE(same_type(a, parse("// c\nstruct In { float x; };\nstruct S { In i; };", "b"), "S"));
  EXPECT_FALSE(same_type(a, parse("struct In { double x; }; struct S { In i; };", "b"), "S"));
  EXPECT_FALSE(same_type(a, parse("struct In { float y; }; struct S { In i; };", "b"), "S"));
  EXPECT_FALSE(same_type(a, a, "T"));
}

}  // namespace
}  // namespace omma::idl
