#include "ground/card/card_sheet.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kNotesMm = 14;  // below the plate
constexpr double kBarMm = 50;
constexpr double kFlatMm = 0.05;  // targets nearer to the plate's plane lie in it

struct SurfaceFree {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextFree {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceFree>;
using Context = std::unique_ptr<cairo_t, ContextFree>;

// Where the plate lies on the page; millimetres, y down from the top.
struct Layout {
  double left, top, width, height;  // of the plate
  double page_width, page_height;
  Eigen::Vector2d middle;  // of the targets, body frame [mm]

  Eigen::Vector2d place(const Eigen::Vector3d& position) const {
    return {left + 0.5 * width + 1e3 * position.x() - middle.x(),
            top + 0.5 * height - 1e3 * position.y() + middle.y()};
  }
};

Layout layout_of(const std::string& path, const TargetBody& body, const CardSheet& sheet) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = -low;
  for (const Target& target : body.targets) {
    low = low.cwiseMin(1e3 * target.position.head<2>());
    high = high.cwiseMax(1e3 * target.position.head<2>());
  }
  const double border = 2 * sheet.margin_mm + sheet.disc_mm;
  Layout l{};
  l.middle = 0.5 * (low + high);
  l.width = high.x() - low.x() + border;
  l.height = high.y() - low.y() + border;
  l.page_width = sheet.page_width_mm > 0 ? sheet.page_width_mm : std::max(l.width, kBarMm + 40) + 10;
  l.page_height = sheet.page_height_mm > 0 ? sheet.page_height_mm : l.height + kNotesMm + 10;
  if (l.width > l.page_width || l.height + kNotesMm > l.page_height) {
    throw InputError(path, 0, "page",
                     format("at least %.0f x %.0f mm for this card", l.width, l.height + kNotesMm),
                     format("%.0f x %.0f mm", l.page_width, l.page_height));
  }
  l.left = 0.5 * (l.page_width - l.width);
  l.top = 0.5 * (l.page_height - l.height - kNotesMm);
  return l;
}

void refuse_touching_discs(const std::string& path, const TargetBody& body, double disc_mm) {
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    for (std::size_t k = i + 1; k < body.targets.size(); ++k) {
      const double apart = 1e3 * (body.targets[i].position - body.targets[k].position).head<2>().norm();
      if (apart > disc_mm) continue;
      throw InputError(path, 0, "disc",
                       format("a diameter below %.1f mm, the distance of ", apart) +
                           body.targets[i].id.c_str() + " and " + body.targets[k].id.c_str(),
                       format("%.1f mm", disc_mm));
    }
  }
}

Surface surface_for(const std::string& path, const Layout& l, const CardSheet& sheet) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const double width = l.page_width * kPointsPerMm;
  const double height = l.page_height * kPointsPerMm;
  if (ending == ".svg") {
    Surface surface(cairo_svg_surface_create(path.c_str(), width, height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PT);
    return surface;
  }
  if (ending == ".pdf") return Surface(cairo_pdf_surface_create(path.c_str(), width, height));
  if (ending == ".png") {
    const double per_mm = sheet.dots_per_inch / 25.4;
    return Surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                              static_cast<int>(std::lround(l.page_width * per_mm)),
                                              static_cast<int>(std::lround(l.page_height * per_mm))));
  }
  throw InputError(path, 0, "ending", ".svg, .pdf or .png", ending.empty() ? "none" : ending);
}

void grey(cairo_t* c, double level) {
  cairo_set_source_rgb(c, level, level, level);
}

void write_words(cairo_t* c, double x, double y, double size_mm, const std::string& words) {
  cairo_set_font_size(c, size_mm);
  cairo_move_to(c, x, y);
  cairo_show_text(c, words.c_str());
}

void draw_target(cairo_t* c, const Layout& l, const Target& target, bool light, const CardSheet& sheet) {
  const Eigen::Vector2d at = l.place(target.position);
  grey(c, light ? 1 : 0);
  cairo_arc(c, at.x(), at.y(), 0.5 * sheet.disc_mm, 0, 2 * std::numbers::pi);
  cairo_fill(c);
  const double raised = 1e3 * target.position.z();
  grey(c, 0.55);
  const double beside = at.x() + 0.5 * sheet.disc_mm + 1;
  if (std::abs(raised) > kFlatMm) {
    cairo_set_line_width(c, 0.15);
    cairo_arc(c, at.x(), at.y(), 0.5 * sheet.disc_mm + 0.8, 0, 2 * std::numbers::pi);
    cairo_stroke(c);
    write_words(c, beside, at.y() + 3, 2, format("%+.1f mm", raised));
  }
  if (sheet.labels) write_words(c, beside, at.y(), 2, target.id.c_str());
}

void draw_notes(cairo_t* c, const Layout& l, const std::string& name) {
  const double y = l.top + l.height + 6;
  grey(c, 0);
  cairo_set_line_width(c, 0.3);
  cairo_move_to(c, l.left, y);
  cairo_rel_line_to(c, kBarMm, 0);
  for (const double x : {0.0, kBarMm}) {
    cairo_move_to(c, l.left + x, y - 1.5);
    cairo_rel_line_to(c, 0, 3);
  }
  cairo_stroke(c);
  write_words(c, l.left, y + 5, 3, "50 mm: print at 100 %");
  write_words(c, l.left + kBarMm + 4, y + 1, 3, name);
}

}  // namespace

void write_card_sheet(const std::string& path, const TargetBody& body, const std::string& name,
                      const CardSheet& sheet) {
  refuse_touching_discs(path, body, sheet.disc_mm);
  const Layout l = layout_of(path, body, sheet);
  const Surface surface = surface_for(path, l, sheet);
  const Context context(cairo_create(surface.get()));
  cairo_t* c = context.get();
  const bool png = std::filesystem::path(path).extension() == ".png";
  const double scale = png ? sheet.dots_per_inch / 25.4 : kPointsPerMm;
  cairo_scale(c, scale, scale);
  grey(c, 1);
  cairo_paint(c);
  const auto lights =
      std::count_if(body.targets.begin(), body.targets.end(), [](const Target& t) { return t.type == 1; });
  const bool light = 2 * static_cast<std::size_t>(lights) > body.targets.size();
  cairo_rectangle(c, l.left, l.top, l.width, l.height);
  grey(c, light ? 0 : 1);
  cairo_fill_preserve(c);
  grey(c, 0);
  cairo_set_line_width(c, 0.15);
  cairo_stroke(c);
  for (const Target& target : body.targets) draw_target(c, l, target, light, sheet);
  draw_notes(c, l, name);
  cairo_surface_flush(surface.get());
  cairo_status_t status = cairo_status(c);
  if (png && status == CAIRO_STATUS_SUCCESS) status = cairo_surface_write_to_png(surface.get(), path.c_str());
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw InputError(path, 0, "--out", "a file that can be written", cairo_status_to_string(status));
}

}  // namespace omma::ground
