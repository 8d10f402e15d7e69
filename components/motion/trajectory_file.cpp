// Reads key points, from a table of comma-separated values or from TOML, and makes the splines through them.
#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "components/motion/axis_check.hpp"
#include "components/motion/motion_files.hpp"
#include "fsw/services/text_input.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// The key points of one axis and where they stand.
struct AxisPoints {
  std::vector<KeyPoint> points;
  int line = 0;  // of the first
};

using GimbalPoints = std::vector<AxisPoints>;  // in the order of the gimbal

std::string names_of(const std::vector<GimbalAxis>& gimbal, const std::string& ending) {
  std::string text;
  for (const GimbalAxis& axis : gimbal)
    text += (text.empty() ? "" : ", ") + std::string(axis.name.view()) + ending;
  return text;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Between commas; unlike words, an empty one counts.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    cells.push_back(trimmed(line.substr(at, comma - at)));
    if (comma == std::string_view::npos) return cells;
    at = comma + 1;
  }
}

constexpr int kTimeColumn = -1;

/// Which axis each column is for.
std::vector<int> columns_of(const std::string& file, int line, std::string_view head,
                            const std::vector<GimbalAxis>& gimbal) {
  std::vector<int> columns;
  for (const std::string_view cell : cells_of(head)) {
    int column = kTimeColumn;
    if (cell != "time_s") {
      column = 0;
      while (column < static_cast<int>(gimbal.size()) &&
             cell != std::string(gimbal[static_cast<std::size_t>(column)].name.view()) + "_deg")
        ++column;
      if (column == static_cast<int>(gimbal.size()))
        throw InputError(file, line, "column " + std::to_string(columns.size() + 1),
                         "time_s or an axis of the gimbal (" + names_of(gimbal, "_deg") + ")", excerpt(cell));
    }
    if (std::find(columns.begin(), columns.end(), column) != columns.end())
      throw InputError(file, line, "column " + std::to_string(columns.size() + 1), "each column once",
                       excerpt(cell) + " again");
    columns.push_back(column);
  }
  if (std::find(columns.begin(), columns.end(), kTimeColumn) == columns.end())
    throw InputError(file, line, "first line", "a column time_s", excerpt(head));
  return columns;
}

double number_in(const std::string& file, int line, std::string_view cell, std::string_view column) {
  const auto value = finite_number(cell);
  if (!value) throw InputError(file, line, column, "a number", cell.empty() ? "nothing" : excerpt(cell));
  return *value;
}

GimbalPoints read_csv(const std::filesystem::path& path, const std::vector<GimbalAxis>& gimbal) {
  const std::string file = path.string();
  const std::string text = read_text(path);
  GimbalPoints axes(gimbal.size());
  std::vector<int> columns;
  int line = 0;
  for (const std::string_view row : lines_of(text)) {
    ++line;
    if (trimmed(row).empty() || trimmed(row).starts_with('#')) continue;
    if (columns.empty()) {
      columns = columns_of(file, line, row, gimbal);
      continue;
    }
    const std::vector<std::string_view> cells = cells_of(row);
    if (cells.size() != columns.size())
      throw InputError(file, line, "line", std::to_string(columns.size()) + " cells, as the first line has",
                       std::to_string(cells.size()));
    const auto time_at = std::find(columns.begin(), columns.end(), kTimeColumn) - columns.begin();
    const double time = number_in(file, line, cells[static_cast<std::size_t>(time_at)], "time_s");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (columns[c] == kTimeColumn || cells[c].empty()) continue;
      const auto index = static_cast<std::size_t>(columns[c]);
      AxisPoints& axis = axes[index];
      const double angle =
          number_in(file, line, cells[c], std::string(gimbal[index].name.view()) + "_deg") * kDegree;
      if (!axis.points.empty() && !(time > axis.points.back().time))
        throw InputError(file, line, "time_s",
                         "a time after " + std::to_string(axis.points.back().time) + " s",
                         std::to_string(time) + " s");
      if (axis.points.empty()) axis.line = line;
      axis.points.push_back({time, angle});
    }
  }
  if (columns.empty()) throw InputError(file, 0, "file", "a first line of names", "an empty file");
  return axes;
}

GimbalPoints read_toml(const std::filesystem::path& path, const std::vector<GimbalAxis>& gimbal) {
  const TomlTable root = TomlTable::read(path);
  GimbalPoints axes(gimbal.size());
  for (const TomlTable& table : root.tables("axis")) {
    const std::string name = table.text("name");
    const auto at = std::find_if(gimbal.begin(), gimbal.end(),
                                 [&](const GimbalAxis& axis) { return axis.name.view() == name; });
    if (at == gimbal.end())
      throw table.error("name", "an axis of the gimbal (" + names_of(gimbal, "") + ")", name);
    AxisPoints& axis = axes[static_cast<std::size_t>(at - gimbal.begin())];
    if (!axis.points.empty()) throw table.error("name", "each axis once", name + " again");
    for (const TomlTable& point : table.tables("key_points")) {
      const double time = point.number("time_s", {-1e6, 1e6});
      if (!axis.points.empty() && !(time > axis.points.back().time))
        throw point.error("time_s", "a time after " + std::to_string(axis.points.back().time) + " s",
                          std::to_string(time) + " s");
      axis.points.push_back({time, point.number("angle_deg", {-3600, 3600}) * kDegree});
      point.refuse_unknown_keys();
    }
    table.refuse_unknown_keys();
  }
  root.refuse_unknown_keys();
  return axes;
}

GimbalPoints read_points(const std::filesystem::path& file, const std::vector<GimbalAxis>& gimbal) {
  const bool toml = file.extension() == ".toml";
  if (!toml && file.extension() != ".csv")
    throw InputError(file.string(), 0, "file", "a name that ends in .csv or .toml",
                     excerpt(file.extension().string()));
  GimbalPoints read = toml ? read_toml(file, gimbal) : read_csv(file, gimbal);
  if (std::all_of(read.begin(), read.end(), [](const AxisPoints& axis) { return axis.points.empty(); }))
    throw InputError(file.string(), 0, "file", "key points", "none");
  return read;
}

}  // namespace

std::vector<std::vector<KeyPoint>> read_key_points(const std::filesystem::path& file,
                                                   const std::vector<GimbalAxis>& gimbal) {
  std::vector<std::vector<KeyPoint>> points;
  for (AxisPoints& axis : read_points(file, gimbal)) points.push_back(std::move(axis.points));
  return points;
}

std::vector<MotionAxis> read_unchecked_trajectory_file(const std::filesystem::path& file,
                                                       const std::vector<GimbalAxis>& gimbal) {
  const GimbalPoints read = read_points(file, gimbal);
  std::vector<MotionAxis> axes;
  for (std::size_t i = 0; i < gimbal.size(); ++i) {
    std::vector<KeyPoint> points = read[i].points;
    if (points.empty()) points = {{0, gimbal[i].home}, {1, gimbal[i].home}};
    try {
      axes.push_back({gimbal[i], AxisSpline(points)});
    } catch (const std::invalid_argument& error) {
      throw InputError(file.string(), read[i].line, "axis " + std::string(gimbal[i].name.view()),
                       "a trajectory", error.what());
    }
  }
  return axes;
}

std::vector<MotionAxis> read_trajectory_file(const std::filesystem::path& file,
                                             const std::vector<GimbalAxis>& gimbal) {
  std::vector<MotionAxis> axes = read_unchecked_trajectory_file(file, gimbal);
  for (const MotionAxis& axis : axes) {
    const std::vector<std::string> sentences = broken_limits(axis);
    if (!sentences.empty())
      throw InputError(file.string(), 0, "trajectory", "one within the limits of its axes",
                       sentences.front());
  }
  return axes;
}

}  // namespace omma
