// OCamCalib calib_results.txt: five records of numbers. The '#' lines between them vary from writer to
// writer: they are skipped, but a record must not reach across one.
#include <cmath>
#include <vector>

#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

constexpr int kMaxInverseCoefficients = 100000;

class OcamRecords {
 public:
  OcamRecords(std::string_view text, const std::string& file) : file_(file) {
    int line_number = 0;
    int record = 0;
    for (const std::string_view line : lines_of(text)) {
      ++line_number;
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first == std::string_view::npos) continue;
      if (line[first] == '#') {
        ++record;
        continue;
      }
      for (const std::string_view word : words_of(line)) words_.push_back({{word, line_number}, record});
    }
    last_line_ = line_number;
  }

  double number(const std::string& field) {
    const Word word = next(field);
    const auto value = finite_number(word.text);
    if (!value) throw InputError(file_, word.line, field, "a finite number", excerpt(word.text));
    return *value;
  }

  int whole(const std::string& field, int least, int most) {
    const Word word = next(field);
    const auto value = whole_number(word.text);
    if (!value || *value < least || *value > most) {
      throw InputError(file_, word.line, field,
                       "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                       excerpt(word.text));
    }
    return *value;
  }

  /// Call after the last number of a record: what follows on must be another one.
  void end_record(const std::string& field, bool last) {
    const bool more = at_ < words_.size();
    if (more && (last || (in_record_ && at_ > 0 && words_[at_].word.line == words_[at_ - 1].word.line))) {
      throw InputError(file_, words_[at_].word.line, field, "the end of the record",
                       excerpt(words_[at_].word.text));
    }
    in_record_ = false;
  }

  int line() const { return at_ > 0 ? words_[at_ - 1].word.line : 0; }

 private:
  struct PlacedWord {
    Word word;
    int record = 0;  // number of '#' lines before it
  };

  Word next(const std::string& field) {
    if (at_ == words_.size()) throw InputError(file_, last_line_, field, "a number", "the end of the file");
    const PlacedWord& placed = words_[at_];
    if (in_record_ && placed.record != words_[at_ - 1].record) {
      throw InputError(file_, words_[at_ - 1].word.line, field, "a number", "the end of the record");
    }
    in_record_ = true;
    ++at_;
    return placed.word;
  }

  const std::string& file_;
  std::vector<PlacedWord> words_;
  std::size_t at_ = 0;
  bool in_record_ = false;
  int last_line_ = 0;
};

// P with the axis along +z. The toolbox writes it with a0 < 0, other exporters with the sign turned.
std::vector<double> forward_polynomial(OcamRecords& records, const std::string& file) {
  const int count = records.whole("polynomial length", 1, OcamModel::kMaxCoefficients);
  std::vector<double> polynomial;
  for (int i = 0; i < count; ++i) {
    polynomial.push_back(records.number("polynomial a" + std::to_string(i)));
    if (i == 0 && polynomial[0] == 0) {
      throw InputError(file, records.line(), "polynomial a0", "a focal length other than zero", "0");
    }
  }
  if (polynomial[0] < 0) {
    for (double& a : polynomial) a = -a;
  }
  return polynomial;
}

}  // namespace

Lens lens_from_ocamcalib(std::string_view text, const std::string& file) {
  OcamRecords records(text, file);
  const std::vector<double> polynomial = forward_polynomial(records, file);
  records.end_record("polynomial", false);

  // Read, so that a damaged file is noticed, and not used: the direct polynomial is inverted instead.
  const int inverse_count = records.whole("inverse polynomial length", 1, kMaxInverseCoefficients);
  for (int i = 0; i < inverse_count; ++i) records.number("inverse polynomial b" + std::to_string(i));
  records.end_record("inverse polynomial", false);

  const double row = records.number("centre row");
  const double column = records.number("centre column");
  records.end_record("centre", false);
  const int centre_line = records.line();

  const double c = records.number("affine c");
  const double d = records.number("affine d");
  const double e = records.number("affine e");
  records.end_record("affine", false);
  if (!(c - d * e > 0)) {
    throw InputError(file, records.line(), "affine", "c - d e above zero", std::to_string(c - d * e));
  }

  const int height = records.whole("image height", 1, 1 << 16);
  const int width = records.whole("image width", 1, 1 << 16);
  records.end_record("image size", true);
  if (!(std::abs(row - 0.5 * height) <= height) || !(std::abs(column - 0.5 * width) <= width)) {
    throw InputError(file, centre_line, "centre",
                     "a row and column near the image of " + std::to_string(height) + " rows and " +
                         std::to_string(width) + " columns",
                     std::to_string(row) + " " + std::to_string(column));
  }

  // [row; column] = [c d; e 1] [x; y] + centre with x down, y right, z backwards: our x is its y, our y its
  // x.
  Eigen::Matrix2d affine;
  affine << 1, e, d, c;
  return Lens::ocam(width, height, {column, row}, affine, polynomial);
}

}  // namespace omma
