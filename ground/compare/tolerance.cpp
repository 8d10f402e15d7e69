#include "ground/compare/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fsw/services/text_input.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

// "dots[17].u_px" and "dots[3].u_px" are one field.
std::string without_places(const std::string& path) {
  std::string field;
  bool inside = false;
  for (const char c : path) {
    if (c == '[') inside = true;
    if (!inside) field += c;
    if (c == ']') inside = false;
  }
  return field;
}

bool is_whole(const std::string& text) {
  return text.find_first_of(".eEn") == std::string::npos;
}

}  // namespace

void FieldJudge::measure(const std::vector<idl::Leaf>& leaves) {
  for (const idl::Leaf& leaf : leaves) {
    const auto number = finite_number(leaf.text);
    if (!number) continue;
    double& magnitude = magnitude_[without_places(leaf.path)];
    magnitude = std::max(magnitude, std::abs(*number));
  }
}

double FieldJudge::allowed(const std::string& field, bool whole) const {
  const std::string full = topic_ + "." + field;
  std::optional<double> named;
  std::size_t longest = 0;
  for (const auto& [beginning, difference] : tolerance_.fields) {
    if (full.rfind(beginning, 0) != 0 || beginning.size() < longest) continue;
    longest = beginning.size();
    named = difference;
  }
  if (named) return *named;
  const auto magnitude = magnitude_.find(field);
  return whole || magnitude == magnitude_.end() ? 0 : tolerance_.relative * magnitude->second;
}

std::string FieldJudge::difference(const std::vector<idl::Leaf>& a, const std::vector<idl::Leaf>& b) {
  std::string first;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i].path != b[i].path) {
      if (first.empty()) first = "field " + a[i].path + " in the first, " + b[i].path + " in the second";
      return first;
    }
    if (a[i].text == b[i].text) continue;
    const auto number_a = finite_number(a[i].text);
    const auto number_b = finite_number(b[i].text);
    const std::string told = a[i].path + ": " + a[i].text + " in the first, " + b[i].text + " in the second";
    if (!number_a || !number_b) {
      if (first.empty()) first = told;
      continue;
    }
    const double gap = std::abs(*number_a - *number_b);
    const double most = allowed(without_places(a[i].path), is_whole(a[i].text) && is_whole(b[i].text));
    const double part = most > 0 ? gap / most : INFINITY;
    if (part > worst_ || largest_.empty()) {
      worst_ = part;
      largest_ = format("%.3g apart, %.3g allowed: ", gap, most) + told;
    }
    if (gap > most && first.empty()) first = told + format(" (%.3g apart, %.3g allowed)", gap, most);
  }
  if (first.empty() && a.size() != b.size())
    first = (a.size() > b.size() ? a : b)[std::min(a.size(), b.size())].path + ": only in one of them";
  return first;
}

}  // namespace omma::ground
