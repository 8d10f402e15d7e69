#include "ground/annotate.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "ground/draw/labels.hpp"
#include "ground/draw/sky_grid.hpp"
#include "ground/draw/stretch.hpp"

namespace omma::ground {
namespace {

constexpr int kSmallestWidth = 1000;  // narrower images are enlarged
constexpr std::array<Colour, 4> kMarkColours{
    {{1, 1, 1, 0.75}, {0.30, 0.95, 0.45, 0.95}, {1.0, 0.32, 0.28, 0.95}, {1.0, 0.75, 0.25, 0.95}}};
constexpr std::array<const char*, 4> kMarkNames{"found", "paired", "culled", "Moon, planets"};

const Colour& colour_of(MarkKind kind) {
  return kMarkColours[static_cast<std::size_t>(kind)];
}

struct Sizes {
  int scale = 1;
  double text = 12;
  double radius = 7;
  double line = 1.3;
};

Sizes sizes_for(const ImageView& image) {
  Sizes sizes;
  sizes.scale = std::max(1, (kSmallestWidth + image.width - 1) / image.width);
  const double width = static_cast<double>(image.width) * sizes.scale;
  sizes.text = std::clamp(width / 90, 12.0, 48.0);
  sizes.radius = 0.55 * sizes.text;
  sizes.line = std::max(1.2, sizes.text / 10);
  return sizes;
}

/// A pixel of the image in the enlarged picture.
Eigen::Vector2d enlarged(const Eigen::Vector2d& pixel, int scale) {
  return ((pixel.array() + 0.5) * scale - 0.5).matrix();
}

/// What the legend says: its lines, and what the colours mean with how many there are.
struct Legend {
  std::vector<std::string> lines;
  std::vector<std::string> keys;  ///< one per MarkKind; empty without marks
  double height = 0;              ///< [px], 0 for nothing to say
};

Legend legend_of(const Annotation& annotation, const Sizes& sizes) {
  Legend legend;
  if (!annotation.title.empty()) legend.lines.push_back(annotation.title);
  legend.lines.insert(legend.lines.end(), annotation.lines.begin(), annotation.lines.end());
  std::array<std::size_t, kMarkNames.size()> counts{};
  for (const Mark& mark : annotation.marks) ++counts[static_cast<std::size_t>(mark.kind)];
  for (std::size_t i = 0; i < counts.size() && !annotation.marks.empty(); ++i) {
    const bool rare = i == static_cast<std::size_t>(MarkKind::kSolar);
    legend.keys.push_back(rare && counts[i] == 0 ? "" : std::to_string(counts[i]) + " " + kMarkNames[i]);
  }
  const double rows = static_cast<double>(legend.lines.size()) + (legend.keys.empty() ? 0 : 1);
  if (rows > 0) legend.height = (1.45 * rows + 0.9) * sizes.text;
  return legend;
}

void draw_legend(Canvas& canvas, const Legend& legend, const Sizes& sizes) {
  const double width = canvas.width();
  const double height = canvas.height();
  const Box strip{-1, height - legend.height, width, height};
  canvas.fill_box(strip, {0.06, 0.08, 0.12});
  Eigen::Vector2d cursor(0.8 * sizes.text, strip.top + 1.45 * sizes.text);
  for (const std::string& line : legend.lines) {
    canvas.text(cursor, line, sizes.text, {1, 1, 1, 0.95});
    cursor.y() += 1.45 * sizes.text;
  }
  for (std::size_t i = 0; i < legend.keys.size(); ++i) {
    if (legend.keys[i].empty()) continue;
    const Eigen::Vector2d centre = cursor + Eigen::Vector2d(0.45, -0.36) * sizes.text;
    canvas.circle(centre, 0.42 * sizes.text, kMarkColours[i], sizes.line);
    cursor.x() += 1.3 * sizes.text;
    canvas.text(cursor, legend.keys[i], sizes.text, kMarkColours[i].with_alpha(0.95));
    cursor.x() += canvas.text_box({0, 0}, legend.keys[i], sizes.text).right + 1.4 * sizes.text;
  }
}

void draw_grid(Canvas& canvas, Labels& labels, const SkyView& sky, const Sizes& sizes) {
  const SkyProjection projection = [&](const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) {
    if (!sky.lens.project(sky.camera_from_j2000 * direction, pixel)) return false;
    pixel = enlarged(pixel, sizes.scale);
    return true;
  };
  const double field_deg = 2 * sky.lens.max_angle() * 180 / std::numbers::pi;
  const double largest_jump = 0.1 * std::max(canvas.width(), canvas.height());
  draw_sky_grid(canvas, labels, sky_grid(projection, grid_step(field_deg), largest_jump), 0.9 * sizes.text);
}

}  // namespace

Canvas annotate(const ImageView& image, const Annotation& annotation) {
  const Sizes sizes = image.empty() ? Sizes{} : sizes_for(image);
  const Legend legend = legend_of(annotation, sizes);
  Canvas canvas(stretched(image, night_sky_stretch(image)), sizes.scale, static_cast<int>(legend.height));
  Labels labels(canvas);
  labels.reserve({-1.0, canvas.height() - legend.height, 1.0 * canvas.width(), 1.0 * canvas.height()});
  std::vector<double> radii;
  for (const Mark& mark : annotation.marks) {
    radii.push_back(mark.radius_px > 0 ? mark.radius_px * sizes.scale : sizes.radius);
    const Eigen::Vector2d centre = enlarged(mark.pixel, sizes.scale);
    canvas.circle(centre, radii.back(), colour_of(mark.kind), sizes.line);
    const double r = radii.back();
    labels.reserve({centre.x() - r, centre.y() - r, centre.x() + r, centre.y() + r});
  }
  for (std::size_t i = 0; i < annotation.marks.size(); ++i) {
    const Mark& mark = annotation.marks[i];
    if (mark.label.empty()) continue;
    labels.place(enlarged(mark.pixel, sizes.scale), radii[i], mark.label, sizes.text, colour_of(mark.kind));
  }
  if (annotation.sky) draw_grid(canvas, labels, *annotation.sky, sizes);
  if (legend.height > 0) draw_legend(canvas, legend, sizes);
  return canvas;
}

}  // namespace omma::ground
