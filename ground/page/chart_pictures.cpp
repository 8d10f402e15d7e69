#include "ground/page/chart_pictures.hpp"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cctype>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>

#include "ground/page/chart_style.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
using Handle = std::unique_ptr<RsvgHandle, Freed<g_object_unref>>;
using Surface = std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;

// What pages name of HTML's characters and XML does not know.
constexpr std::string_view kCharacters =
    "<!DOCTYPE svg [<!ENTITY Prime '&#8243;'><!ENTITY chi '&#967;'><!ENTITY deg '&#176;'><!ENTITY eacute "
    "'&#233;'>"
    "<!ENTITY micro '&#181;'><!ENTITY middot '&#183;'><!ENTITY ndash '&#8211;'><!ENTITY plusmn '&#177;'>"
    "<!ENTITY radic '&#8730;'><!ENTITY sigma '&#963;'><!ENTITY sup2 '&#178;'><!ENTITY times '&#215;'>]>";

std::string replaced(std::string text, const std::string& from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// librsvg knows no variables.
std::string paper_rules() {
  std::string rules(kChartRules);
  for (const PageColour& colour : kPageColours)
    rules = replaced(std::move(rules), "var(--" + std::string(colour.name) + ")", colour.light);
  return rules;
}

// An SVG of a page as a document of its own.
std::string document(std::string_view svg) {
  const std::size_t tag = svg.find('>') + 1;
  return std::string(kCharacters) + "<svg xmlns='http://www.w3.org/2000/svg'" +
         std::string(svg.substr(4, tag - 4)) + "<style>" + paper_rules() + "</style>" +
         std::string(svg.substr(tag));
}

std::string_view title_of(std::string_view svg) {
  const std::size_t open = svg.find("class='title'");
  if (open == std::string_view::npos) return {};
  const std::size_t begin = svg.find('>', open) + 1;
  return svg.substr(begin, svg.find("</text>", begin) - begin);
}

// Letters and figures of a title; marks and what is between them are joined by "_".
std::string file_name_of(std::string_view title) {
  std::string name;
  bool mark = false;
  for (const char c : title.substr(0, title.find(" <tspan"))) {
    if (c == '<' || c == '&') mark = true;
    const auto letter = static_cast<unsigned char>(c);
    if (!mark && std::isalnum(letter) != 0)
      name += static_cast<char>(std::tolower(letter));
    else if (!name.empty() && name.back() != '_')
      name += '_';
    if (c == '>' || c == ';') mark = false;
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "chart" : name;
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  auto* png = static_cast<std::vector<std::uint8_t>*>(bytes);
  png->insert(png->end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

void draw(RsvgHandle* handle, cairo_t* context, const RsvgRectangle& place) {
  GError* error = nullptr;
  if (rsvg_handle_render_document(handle, context, &place, &error) != 0) return;
  const std::string message = error->message;
  g_error_free(error);
  throw std::runtime_error("a chart cannot be drawn: " + message);
}

}  // namespace

std::vector<Chart> charts_of(std::string_view page) {
  constexpr std::string_view kEnd = "</svg>";
  std::vector<Chart> charts;
  std::map<std::string, int> times;
  for (std::size_t begin = page.find("<svg"); begin != std::string_view::npos;) {
    const std::size_t end = page.find(kEnd, begin);
    if (end == std::string_view::npos) break;
    const std::string_view svg = page.substr(begin, end + kEnd.size() - begin);
    std::string name = file_name_of(title_of(svg));
    if (const int before = times[name]++; before > 0) name += "_" + std::to_string(before + 1);
    charts.push_back({std::move(name), svg});
    begin = page.find("<svg", end);
  }
  return charts;
}

std::vector<std::uint8_t> chart_png(std::string_view svg, double scale) {
  const std::string text = document(svg);
  GError* error = nullptr;
  const Handle handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(text.data()), text.size(), &error));
  if (!handle) {
    const std::string message = error->message;
    g_error_free(error);
    throw std::runtime_error("a chart is no SVG: " + message);
  }
  gboolean has_width = 0, has_height = 0, has_box = 0;
  RsvgLength width, height;
  RsvgRectangle box;
  rsvg_handle_get_intrinsic_dimensions(handle.get(), &has_width, &width, &has_height, &height, &has_box,
                                       &box);
  if (has_box == 0 || !(box.width > 0) || !(box.height > 0))
    throw std::runtime_error("a chart has no viewBox");
  const RsvgRectangle place{0, 0, scale * box.width, scale * box.height};
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(place.width),
                                                   static_cast<int>(place.height)));
  const Context context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  draw(handle.get(), context.get(), place);
  std::vector<std::uint8_t> png;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &png) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("a chart cannot be made a PNG");
  return png;
}

void write_page(const std::string& path, const std::string& page) {
  write_text_file(path, page);
  const std::string stem = std::filesystem::path(path).replace_extension().string();
  for (const Chart& chart : charts_of(page)) {
    const std::vector<std::uint8_t> png = chart_png(chart.svg);
    write_text_file(stem + "_" + chart.name + ".png", std::string(png.begin(), png.end()));
  }
}

}  // namespace omma::ground
