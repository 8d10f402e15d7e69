// docs/interfaces.md says what the IDL and the table of topics say: every topic with its quality of service,
// every field with its type, every enumerator.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "components/telemetry/topics.hpp"
#include "ground/idl/idl_schema.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

using Cells = std::vector<std::string>;

std::string trimmed(std::string text) {
  std::erase(text, '`');
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The tables of the page by the heading they stand under, without their first two lines.
std::map<std::string, std::vector<Cells>> tables() {
  std::map<std::string, std::vector<Cells>> result;
  std::ifstream page(OMMA_SOURCE_DIR "/docs/interfaces.md");
  std::string heading;
  int row = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) heading = trimmed(line.substr(line.find(' ')));
    if (!line.starts_with("|")) {
      row = 0;
      continue;
    }
    if (++row <= 2) continue;
    Cells cells;
    for (std::size_t at = 1; at < line.size();) {
      const std::size_t end = line.find('|', at);
      cells.push_back(trimmed(line.substr(at, end - at)));
      at = end + 1;
    }
    result[heading].push_back(cells);
  }
  return result;
}

std::string type_text(const idl::Member& member) {
  static const std::map<idl::Kind, std::string> kNames{
      {idl::Kind::kBoolean, "boolean"}, {idl::Kind::kOctet, "uint8"},   {idl::Kind::kInt16, "int16"},
      {idl::Kind::kUint16, "uint16"},   {idl::Kind::kInt32, "int32"},   {idl::Kind::kUint32, "uint32"},
      {idl::Kind::kInt64, "int64"},     {idl::Kind::kUint64, "uint64"}, {idl::Kind::kFloat, "float"},
      {idl::Kind::kDouble, "double"}};
  const auto simple = kNames.find(member.kind);
  std::string text = simple != kNames.end() ? simple->second
                     : member.kind == idl::Kind::kString
                         ? "string<" + std::to_string(member.string_bound) + ">"
                         : member.type_name.substr(member.type_name.rfind(':') + 1);
  if (member.is_sequence) text = "sequence<" + text + ", " + std::to_string(member.bound) + ">";
  if (member.array_size > 0) text += "[" + std::to_string(member.array_size) + "]";
  return text;
}

TEST(Interfaces, PageHasEveryFieldWithItsTypeAndMeaning) {
  const idl::Schema schema = idl::parse(telemetry::idl_text(), "omma.idl");
  const auto page = tables();
  const std::vector<Cells>& head = page.at("The head of every sample");
  ASSERT_EQ(head.size(), 4U);
  for (const auto& [name, type] : schema.structs) {
    const auto topic = std::find_if(telemetry::topics().begin(), telemetry::topics().end(),
                                    [&](const telemetry::Topic& entry) { return entry.type_name == name; });
    const bool is_topic = topic != telemetry::topics().end();
    const auto table = page.find(is_topic ? std::string(topic->name) + ": " + name : name);
    ASSERT_NE(table, page.end()) << name;
    std::vector<Cells> rows = table->second;
    if (is_topic) rows.insert(rows.begin(), head.begin(), head.end());
    ASSERT_EQ(rows.size(), type.members.size()) << name;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i][0], type.members[i].name) << name;
      EXPECT_EQ(rows[i][1], type_text(type.members[i])) << name << "." << rows[i][0];
      EXPECT_FALSE(rows[i].back().empty()) << name << "." << rows[i][0] << " has no meaning";
      EXPECT_EQ(rows[i].back().starts_with("key:"), type.members[i].is_key) << name << "." << rows[i][0];
    }
  }
}

TEST(Interfaces, PageHasEveryTopicWithItsQualityOfService) {
  const std::vector<Cells> rows = tables().at("Topics");
  ASSERT_EQ(rows.size(), telemetry::kTopicCount);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const telemetry::Topic& topic = telemetry::topics()[i];
    const bool event = topic.delivery == telemetry::Delivery::kEvent;
    EXPECT_EQ(rows[i][0], topic.name);
    EXPECT_EQ(rows[i][1], topic.type_name);
    EXPECT_EQ(rows[i][3], event ? "reliable" : "best effort") << topic.name;
    EXPECT_EQ(rows[i][4], event ? "transient local" : "volatile") << topic.name;
    EXPECT_EQ(rows[i][5], "KEEP_LAST " + std::to_string(topic.depth)) << topic.name;
    EXPECT_EQ(rows[i][6], topic.deadline_ms == 0 ? "none" : std::to_string(topic.deadline_ms / 1000) + " s")
        << topic.name;
  }
}

TEST(Interfaces, PageHasEveryEnumerator) {
  const idl::Schema schema = idl::parse(telemetry::idl_text(), "omma.idl");
  const std::vector<Cells> rows = tables().at("Enumerations");
  EXPECT_EQ(rows.size(), schema.enums.size());
  for (const Cells& row : rows) {
    const auto type = schema.enums.find(row[0]);
    ASSERT_NE(type, schema.enums.end()) << row[0];
    std::string values;
    for (const std::string& value : type->second.values) values += (values.empty() ? "" : ", ") + value;
    EXPECT_EQ(row[1], values) << row[0];
  }
}

}  // namespace
}  // namespace omma::ground
