// Corners found before, in BabelCalib's text files.
#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"
#include "ground/calibrate/board_view.hpp"

namespace omma::ground {
namespace {

std::vector<double> numbers_of(std::string_view line, std::size_t count, const std::string& file, int number,
                               const std::string& expected) {
  std::vector<double> values;
  for (const std::string_view word : words_of(line, ", \t\r")) {
    const auto value = finite_number(word);
    if (!value) throw InputError(file, number, "corner", expected, excerpt(line));
    values.push_back(*value);
  }
  if (values.size() != count)
    throw InputError(file, number, "corner", expected, std::to_string(values.size()));
  return values;
}

// In the order of the file, which is how the corners name them.
std::vector<Eigen::Vector3d> board_points(const std::string& file) {
  const std::string text = read_text(file);
  std::vector<Eigen::Vector3d> points;
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    // Two lines of heads: the board's number and size, and the family of its tags.
    if (++number <= 2 || words_of(line).empty()) continue;
    const auto v = numbers_of(line, 6, file, number, "tag, column, row, x, y, z");
    points.emplace_back(v[3], v[4], v[5]);
  }
  if (points.empty()) throw InputError(file, number, "board", "at least one corner", "none");
  return points;
}

}  // namespace

BoardView read_corners(const std::string& orpc, const std::string& board, int& width, int& height) {
  const auto points = board_points(board);
  const std::string text = read_text(orpc);
  BoardView view;
  view.name = orpc;
  width = height = 0;
  int number = 0;
  bool in_head = true;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    const auto words = words_of(line);
    if (words.empty()) {
      in_head = false;
      continue;
    }
    if (in_head) {
      if (words.size() != 2) throw InputError(orpc, number, "head", "NAME: VALUE", excerpt(line));
      if (words[0] == "width:") width = whole_number(words[1]).value_or(0);
      if (words[0] == "height:") height = whole_number(words[1]).value_or(0);
      in_head = words[0] != "encoding:";
      continue;
    }
    const auto v = numbers_of(line, 5, orpc, number, "board, corner, flag, u, v");
    if (!(v[1] >= 0 && v[1] < double(points.size())))
      throw InputError(orpc, number, "corner", "a corner of " + board, excerpt(line));
    view.points.push_back(points[static_cast<std::size_t>(v[1])]);
    view.pixels.emplace_back(v[3], v[4]);
  }
  if (width < 1 || height < 1) throw InputError(orpc, 1, "head", "width and height above zero", "none");
  if (view.points.size() < 6)
    throw InputError(orpc, number, "corners", "at least six", std::to_string(view.points.size()));
  return view;
}

}  // namespace omma::ground
