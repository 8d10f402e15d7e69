#include "ground/draw/sky_grid.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "components/geometry/angles.hpp"

namespace omma::ground {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kSampleDeg = 0.5;  // along a line, at the widest grid
const Colour kGridColour{0.45, 0.62, 0.85, 0.42};
const Colour kGridTextColour{0.62, 0.76, 0.95, 0.85};

Eigen::Vector3d direction_of(double right_ascension_deg, double declination_deg) {
  return direction_at(right_ascension_deg * kRadians, declination_deg * kRadians);
}

std::string right_ascension_label(double degrees) {
  const int minutes = static_cast<int>(std::lround(degrees * 4));
  std::array<char, 32> text{};
  if (minutes % 60 == 0) {
    std::snprintf(text.data(), text.size(), "%dʰ", minutes / 60);
  } else {
    std::snprintf(text.data(), text.size(), "%dʰ%02dᵐ", minutes / 60, minutes % 60);
  }
  return text.data();
}

std::string declination_label(double degrees) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), degrees > 0 ? "+%g°" : "%g°", degrees);
  std::string label = text.data();
  if (degrees < 0) label.replace(0, 1, "−");
  return label;
}

/// Cuts the samples of one line into the pieces that are seen.
class LineBuilder {
 public:
  LineBuilder(const SkyProjection& projection, std::string label, double largest_jump,
              std::vector<GridLine>& out)
      : projection_(projection), label_(std::move(label)), largest_jump_(largest_jump), out_(out) {}

  void sample(const Eigen::Vector3d& direction) {
    Eigen::Vector2d pixel;
    if (!projection_(direction, pixel)) {
      cut();
      return;
    }
    if (!piece_.empty() && (piece_.back() - pixel).norm() > largest_jump_) cut();
    piece_.push_back(pixel);
  }
  void cut() {
    if (piece_.size() > 1) out_.push_back({piece_, label_});
    piece_.clear();
  }

 private:
  const SkyProjection& projection_;
  std::string label_;
  double largest_jump_;
  std::vector<GridLine>& out_;
  std::vector<Eigen::Vector2d> piece_;
};

}  // namespace

GridStep grid_step(double field_of_view_deg) {
  struct Choice {
    double from_field_deg;
    GridStep step;
  };
  // Whole hours, or whole fractions of an hour, in right ascension.
  constexpr std::array<Choice, 5> kChoices{
      {{100, {30, 30}}, {50, {15, 15}}, {20, {7.5, 5}}, {8, {3.75, 2}}, {3, {1.25, 1}}}};
  for (const Choice& choice : kChoices) {
    if (field_of_view_deg >= choice.from_field_deg) return choice.step;
  }
  return {0.5, 0.25};
}

std::vector<GridLine> sky_grid(const SkyProjection& projection, const GridStep& step, double largest_jump) {
  std::vector<GridLine> lines;
  const double sample = std::min(kSampleDeg, step.declination_deg / 20);
  const int meridians = static_cast<int>(std::lround(360 / step.right_ascension_deg));
  for (int i = 0; i < meridians; ++i) {
    const double ra = i * step.right_ascension_deg;
    // Near the poles only every sixth hour goes on, the others would run together.
    const bool quarter = std::abs(std::remainder(ra, 90)) < 1e-9;
    const double last = quarter ? 90 : 90 - std::min(10.0, step.declination_deg);
    LineBuilder line(projection, right_ascension_label(ra), largest_jump, lines);
    const int samples = static_cast<int>(std::ceil(2 * last / sample));
    for (int k = 0; k <= samples; ++k) line.sample(direction_of(ra, std::min(k * sample - last, last)));
    line.cut();
  }
  const int highest = static_cast<int>(std::ceil(90 / step.declination_deg)) - 1;
  for (int i = -highest; i <= highest; ++i) {
    const double dec = i * step.declination_deg;
    LineBuilder line(projection, declination_label(dec), largest_jump, lines);
    const int samples = static_cast<int>(std::ceil(360 / sample));
    for (int k = 0; k <= samples; ++k) line.sample(direction_of(std::min(k * sample, 360.0), dec));
    line.cut();
  }
  return lines;
}

void draw_sky_grid(Canvas& canvas, Labels& labels, const std::vector<GridLine>& lines, double text_size) {
  std::map<std::string, const GridLine*> longest;
  for (const GridLine& line : lines) {
    canvas.line(line.points, kGridColour, std::max(1.0, text_size / 11));
    const GridLine*& known = longest[line.label];
    if (known == nullptr || known->points.size() < line.points.size()) known = &line;
  }
  for (const auto& [label, line] : longest) {
    if (labels.place(line->points.back(), 0, label, text_size, kGridTextColour)) continue;
    labels.place(line->points.front(), 0, label, text_size, kGridTextColour);
  }
}

}  // namespace omma::ground
