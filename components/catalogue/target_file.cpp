#include "components/catalogue/target_file.hpp"

#include <array>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

constexpr std::array<const char*, 10> kColumns = {"id",   "x",  "y",  "z",  "group",
                                                  "type", "nx", "ny", "nz", "code"};
constexpr std::size_t kWithoutNormal = 6, kWithNormal = 9;
constexpr int kLeastDifference = 2;  // of two codes at any phase: one bit may be seen wrongly

// Between tabs a field may be empty, so that an empty id is seen as one.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t tab = line.find('\t');
    std::string_view field = line.substr(0, tab);
    while (field.starts_with(' ')) field.remove_prefix(1);
    while (field.ends_with(' ')) field.remove_suffix(1);
    fields.push_back(field);
    if (tab == std::string_view::npos) return fields;
    line.remove_prefix(tab + 1);
  }
}

class TargetLine {
 public:
  TargetLine(std::string_view line, const std::string& file, int number)
      : fields_(fields_of(line)), file_(file), number_(number) {
    const bool with_code = fields_.size() == kWithoutNormal + 1 || fields_.size() == kWithNormal + 1;
    if (with_code) {
      code_ = fields_.back();
      fields_.pop_back();
    }
    if (fields_.size() != kWithoutNormal && fields_.size() != kWithNormal) {
      throw InputError(file_, number_, "target",
                       "6 fields between tabs: id x y z group type (or 9, with a normal nx ny nz; "
                       "or one more, with a blinking code)",
                       std::to_string(fields_.size()));
    }
  }

  InputError error(std::size_t column, std::string_view expected) const {
    return {file_, number_, kColumns[column], expected,
            fields_[column].empty() ? "nothing" : excerpt(fields_[column])};
  }

  InputError code_error(std::string_view expected) const {
    return {file_, number_, kColumns.back(), expected, excerpt(code_)};
  }

  /// The codes of one body are told apart at any phase.
  void check_code(const Target& target, const Target& other) const {
    if (!target.code.blinks() || !other.code.blinks()) return;
    if (target.code.length != other.code.length)
      throw code_error("as many bits as " + std::string(other.id.view()) + " has, " +
                       std::to_string(other.code.length));
    if (least_difference(target.code.bits, other.code.bits, target.code.length) < kLeastDifference ||
        target.code.bits == other.code.bits)
      throw code_error("a code that differs from that of " + std::string(other.id.view()) +
                       " in two bits at every phase");
  }

  Target target() const {
    if (fields_[0].empty()) throw error(0, "a name");
    if (fields_[0].size() > limits::kNameLength) {
      throw error(0, "at most " + std::to_string(limits::kNameLength) + " characters (limits::kNameLength)");
    }
    Target target;
    target.id = Name(fields_[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = finite_number(fields_[i + 1]);
      if (!value) throw error(i + 1, "a finite number of metres");
      target.position[static_cast<Eigen::Index>(i)] = *value;
    }
    const auto group = whole_number(fields_[4]);
    if (!group) throw error(4, "a whole number");
    const auto type = whole_number(fields_[5]);
    if (!type || (*type != 0 && *type != 1)) throw error(5, "0 (dark dot on light) or 1 (light dot on dark)");
    target.group = *group;
    target.type = *type;
    if (fields_.size() == kWithNormal) target.normal = normal();
    if (!code_.empty()) target.code = code();
    return target;
  }

 private:
  Eigen::Vector3d normal() const {
    Eigen::Vector3d outward;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = finite_number(fields_[kWithoutNormal + i]);
      if (!value) throw error(kWithoutNormal + i, "a finite number");
      outward[static_cast<Eigen::Index>(i)] = *value;
    }
    if (!(outward.norm() > 1e-6)) throw error(kWithoutNormal, "a normal that is not zero");
    return outward.normalized();
  }

  BlinkWord code() const {
    if (code_.size() < static_cast<std::size_t>(kFewestCodeBits) ||
        code_.size() > static_cast<std::size_t>(kMostCodeBits) ||
        code_.find_first_not_of("01") != std::string_view::npos)
      throw code_error("8 to 32 characters 0 or 1, the first frame's first");
    BlinkWord word{0, static_cast<int>(code_.size())};
    for (std::size_t n = 0; n < code_.size(); ++n) word.bits |= (code_[n] == '1' ? 1U : 0U) << n;
    if (!can_be_followed(word.bits, word.length))
      throw code_error("two zeros at least, and none beside another (it goes round)");
    if (least_difference(word.bits, word.bits, word.length) < kLeastDifference)
      throw code_error("a code that differs from itself turned by a phase");
    return word;
  }

  std::vector<std::string_view> fields_;
  std::string_view code_;
  const std::string& file_;
  int number_;
};

bool is_header(std::string_view line) {
  const auto fields = fields_of(line);
  return fields.size() >= kWithoutNormal && fields[0] == kColumns[0] && fields[1] == kColumns[1];
}

}  // namespace

TargetBody targets_from_text(std::string_view text, const std::string& file) {
  TargetBody body;
  int number = 0;
  bool first = true;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.starts_with('#')) continue;
    const bool header = first && is_header(line);
    first = false;
    if (header) continue;
    const TargetLine entry(line, file, number);
    const Target target = entry.target();
    for (const Target& other : body.targets) {
      if (other.id == target.id) throw entry.error(0, "an id no other target has");
      entry.check_code(target, other);
    }
    if (!body.targets.push_back(target)) {
      throw InputError(file, number, "targets",
                       "at most " + std::to_string(limits::kTargetsPerBody) + " (limits::kTargetsPerBody)",
                       "more");
    }
  }
  if (body.targets.empty()) throw InputError(file, number, "targets", "at least one", "none");
  return body;
}

TargetBody read_target_file(const std::filesystem::path& file) {
  return targets_from_text(read_text(file), file.string());
}

}  // namespace omma
