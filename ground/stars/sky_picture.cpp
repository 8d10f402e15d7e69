#include "ground/stars/sky_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "components/catalogue/star_names.hpp"
#include "ground/draw/labels.hpp"

namespace omma::ground {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNamed = 1.3;  // V; brighter stars are named

// Mollweide's projection: the unit circle stretched twice in x. Snyder 1987, USGS Professional Paper 1395.
Eigen::Vector2d mollweide(double longitude, double latitude) {
  double theta = latitude;
  for (int k = 0; k < 30; ++k) {
    const double slope = 2 + 2 * std::cos(2 * theta);
    if (slope < 1e-9) break;
    theta -= (2 * theta + std::sin(2 * theta) - kPi * std::sin(latitude)) / slope;
  }
  return {longitude / kPi * std::cos(theta), std::sin(theta)};
}

class Map {
 public:
  explicit Map(int width) : width_(width), height_(width / 2) {}
  int height() const { return height_; }
  // The middle is 12 h; right ascension grows to the left.
  Eigen::Vector2d place(double right_ascension, double declination) const {
    double east = right_ascension - kPi;
    east = std::remainder(east, 2 * kPi);
    const Eigen::Vector2d m = mollweide(east, declination);
    return {0.5 * width_ - m.x() * (0.5 * width_ - 8), 0.5 * height_ - m.y() * (0.5 * height_ - 8)};
  }

 private:
  int width_;
  int height_;
};

void grid(Canvas& canvas, const Map& map) {
  const Colour line{0.55, 0.66, 0.85, 0.28};
  for (int hour = 0; hour <= 24; hour += 3) {
    std::vector<Eigen::Vector2d> points;
    // 0 h is both edges: a hair inside on each side.
    const double ra = std::clamp(hour * kPi / 12, 1e-6, 2 * kPi - 1e-6);
    for (int dec = -90; dec <= 90; dec += 3) points.push_back(map.place(ra, dec * kPi / 180));
    canvas.line(points, line, 1);
    if (hour % 6 == 0 && hour > 0 && hour < 24)
      canvas.text(map.place(ra, 0) + Eigen::Vector2d(4, -4), std::to_string(hour) + "h", 12,
                  line.with_alpha(0.8));
  }
  for (int dec = -60; dec <= 60; dec += 30) {
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k <= 120; ++k)
      points.push_back(map.place(std::clamp(k * kPi / 60, 1e-6, 2 * kPi - 1e-6), dec * kPi / 180));
    canvas.line(points, line, 1);
  }
}

}  // namespace

Canvas sky_picture(std::span<const SkyStar> stars, double magnitude, int width) {
  const Map map(width);
  Canvas canvas(width, map.height());
  canvas.fill_box({-0.5, -0.5, width - 0.5, map.height() - 0.5}, {0.03, 0.04, 0.08, 1});
  grid(canvas, map);
  Labels labels(canvas);
  struct Named {
    Eigen::Vector2d at;
    double radius;
    std::string_view name;
  };
  std::vector<Named> named;
  for (const SkyStar& star : stars) {
    if (star.magnitude >= magnitude) continue;
    const double ra = std::atan2(star.direction.y(), star.direction.x());
    const double dec = std::asin(std::clamp(star.direction.z(), -1.0, 1.0));
    const Eigen::Vector2d at = map.place(ra, dec);
    const double radius = width / 1200.0 * (0.7 + 0.75 * (magnitude - star.magnitude));
    canvas.disc(at, radius, {1, 0.97, 0.88, 0.95});
    if (star.magnitude >= kNamed) continue;
    labels.reserve(Box{at.x(), at.y(), at.x(), at.y()}.grown(radius));
    named.push_back({at, radius, proper_name(star.hr)});
  }
  for (const Named& one : named) labels.place(one.at, one.radius, one.name, 12, {0.72, 0.82, 1, 0.9});
  return canvas;
}

}  // namespace omma::ground
