// Bouguet's Calib_Results.m: assignments of numbers in Matlab's syntax; those that make a lens are taken, the
// rest (uncertainties, poses of the calibration views) is passed over.
#include <map>
#include <vector>

#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

struct Assignment {
  std::vector<Word> values;
  int line = 0;
};

bool is_name(std::string_view word) {
  return !word.empty() &&
         word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
             std::string_view::npos;
}

// name = [ numbers between blanks, commas, semicolons, over any number of lines ]; or name = number;
std::map<std::string, Assignment, std::less<>> assignments(std::string_view text) {
  std::map<std::string, Assignment, std::less<>> found;
  Assignment* open = nullptr;  // inside [ ] that has not ended yet
  int line_number = 0;
  for (std::string_view line : lines_of(text)) {
    ++line_number;
    line = line.substr(0, line.find('%'));
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos) {
      const auto names = words_of(line.substr(0, equals));
      if (names.size() != 1 || !is_name(names[0])) continue;
      open = &found[std::string(names[0])];
      *open = {{}, line_number};
      line.remove_prefix(equals + 1);
    }
    if (open == nullptr) continue;
    for (const std::string_view word : words_of(line, " \t\r,;[]"))
      open->values.push_back({word, line_number});
    const bool list_starts = line.find('[') != std::string_view::npos;
    const bool list_ends = line.find(']') != std::string_view::npos;
    if (list_ends || (equals != std::string_view::npos && !list_starts)) open = nullptr;
  }
  return found;
}

class BouguetFile {
 public:
  BouguetFile(std::string_view text, const std::string& file)
      : found_(assignments(text)), file_(file), last_line_(static_cast<int>(lines_of(text).size())) {}

  bool has(std::string_view name) const { return found_.find(name) != found_.end(); }
  int line(std::string_view name) const { return has(name) ? found_.find(name)->second.line : last_line_; }

  std::vector<double> numbers(const std::string& name, std::size_t least, std::size_t most) const {
    const std::string expected =
        (least == most ? std::to_string(least) : std::to_string(least) + " or " + std::to_string(most)) +
        (most == 1 ? " number" : " numbers");
    if (!has(name)) throw InputError(file_, last_line_, name, expected, "no such assignment in the file");
    const Assignment& assignment = found_.find(name)->second;
    if (assignment.values.size() < least || assignment.values.size() > most) {
      throw InputError(file_, assignment.line, name, expected, std::to_string(assignment.values.size()));
    }
    std::vector<double> values;
    for (const Word& word : assignment.values) {
      const auto value = finite_number(word.text);
      if (!value) throw InputError(file_, word.line, name, "finite numbers", excerpt(word.text));
      values.push_back(*value);
    }
    return values;
  }

  int size(const std::string& name) const {
    const double value = numbers(name, 1, 1)[0];
    if (!(value >= 1 && value <= 1 << 16 && value == static_cast<int>(value))) {
      throw InputError(file_, line(name), name, "a whole number of pixels from 1 to 65536",
                       std::to_string(value));
    }
    return static_cast<int>(value);
  }

 private:
  std::map<std::string, Assignment, std::less<>> found_;
  const std::string& file_;
  int last_line_;
};

}  // namespace

Lens lens_from_bouguet(std::string_view text, const std::string& file) {
  const BouguetFile records(text, file);
  const auto fc = records.numbers("fc", 2, 2);
  if (!(fc[0] > 0 && fc[1] > 0)) {
    throw InputError(file, records.line("fc"), "fc", "focal lengths above zero",
                     std::to_string(fc[0]) + " " + std::to_string(fc[1]));
  }
  const auto cc = records.numbers("cc", 2, 2);
  const double alpha_c = records.has("alpha_c") ? records.numbers("alpha_c", 1, 1)[0] : 0.0;
  const auto kc = records.numbers("kc", 4, 5);  // the oldest toolboxes write no k3
  const int width = records.size("nx");
  const int height = records.size("ny");
  return Lens::caltech(width, height, {fc[0], fc[1]}, {cc[0], cc[1]}, alpha_c,
                       {kc[0], kc[1], kc[2], kc[3], kc.size() == 5 ? kc[4] : 0.0});
}

}  // namespace omma
