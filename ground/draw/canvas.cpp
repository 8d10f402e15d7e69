#include "ground/draw/canvas.hpp"

#include <cairo.h>
#include <jpeglib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace omma::ground {
namespace {

constexpr double kPixelCentre = 0.5;  // cairo's (0,0) is the corner of the first pixel, ours its centre

void set_colour(cairo_t* context, const Colour& colour) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

void set_font(cairo_t* context, double size) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
}

cairo_status_t append_bytes(void* closure, const unsigned char* bytes, unsigned int length) {
  auto* out = static_cast<std::vector<std::uint8_t>*>(closure);
  out->insert(out->end(), bytes, bytes + length);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(int width, int height) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  if (width <= 0 || height <= 0 || cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(surface);
    throw std::runtime_error("cannot make a picture of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels");
  }
  return surface;
}

void copy_grey(const GreyPicture& picture, cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  unsigned char* bytes = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int v = 0; v < picture.height; ++v) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(v) * stride);
    for (int u = 0; u < picture.width; ++u) {
      const std::uint32_t grey = picture.pixels[static_cast<std::size_t>(v) * picture.width + u];
      row[u] = grey << 16 | grey << 8 | grey;
    }
  }
  cairo_surface_mark_dirty(surface);
}

}  // namespace

void Canvas::SurfaceFree::operator()(_cairo_surface* surface) const {
  cairo_surface_destroy(surface);
}
void Canvas::ContextFree::operator()(_cairo* context) const {
  cairo_destroy(context);
}

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), surface_(make_surface(width, height)) {
  context_.reset(cairo_create(surface_.get()));
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
}

Canvas::Canvas(const GreyPicture& picture, int scale, int footer)
    : Canvas(picture.width * scale, picture.height * scale + footer) {
  if (scale == 1) {
    copy_grey(picture, surface_.get());
    return;
  }
  const std::unique_ptr<_cairo_surface, SurfaceFree> small(make_surface(picture.width, picture.height));
  copy_grey(picture, small.get());
  cairo_save(context_.get());
  cairo_scale(context_.get(), scale, scale);
  cairo_set_source_surface(context_.get(), small.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context_.get()), CAIRO_FILTER_BILINEAR);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&& other) noexcept = default;
Canvas& Canvas::operator=(Canvas&& other) noexcept = default;

void Canvas::fill_box(const Box& box, const Colour& colour) {
  set_colour(context_.get(), colour);
  cairo_rectangle(context_.get(), box.left + kPixelCentre, box.top + kPixelCentre, box.right - box.left,
                  box.bottom - box.top);
  cairo_fill(context_.get());
}

void Canvas::circle(const Eigen::Vector2d& centre, double radius, const Colour& colour, double line_width) {
  set_colour(context_.get(), colour);
  cairo_set_line_width(context_.get(), line_width);
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x() + kPixelCentre, centre.y() + kPixelCentre, radius, 0,
            2 * std::numbers::pi);
  cairo_stroke(context_.get());
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, const Colour& colour) {
  set_colour(context_.get(), colour);
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x() + kPixelCentre, centre.y() + kPixelCentre, radius, 0,
            2 * std::numbers::pi);
  cairo_fill(context_.get());
}

void Canvas::line(std::span<const Eigen::Vector2d> points, const Colour& colour, double line_width) {
  if (points.size() < 2) return;
  set_colour(context_.get(), colour);
  cairo_set_line_width(context_.get(), line_width);
  cairo_new_path(context_.get());
  for (const Eigen::Vector2d& point : points) {
    cairo_line_to(context_.get(), point.x() + kPixelCentre, point.y() + kPixelCentre);
  }
  cairo_stroke(context_.get());
}

void Canvas::text(const Eigen::Vector2d& position, std::string_view utf8, double size, const Colour& colour) {
  const std::string terminated(utf8);
  set_font(context_.get(), size);
  cairo_new_path(context_.get());
  cairo_move_to(context_.get(), position.x() + kPixelCentre, position.y() + kPixelCentre);
  cairo_text_path(context_.get(), terminated.c_str());
  set_colour(context_.get(), Colour{0, 0, 0, 0.75 * colour.alpha});
  cairo_set_line_width(context_.get(), std::max(2.0, 0.22 * size));
  cairo_stroke_preserve(context_.get());
  set_colour(context_.get(), colour);
  cairo_fill(context_.get());
}

Box Canvas::text_box(const Eigen::Vector2d& position, std::string_view utf8, double size) const {
  const std::string terminated(utf8);
  set_font(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), terminated.c_str(), &extents);
  return {position.x() + extents.x_bearing, position.y() + extents.y_bearing,
          position.x() + extents.x_bearing + extents.width,
          position.y() + extents.y_bearing + extents.height};
}

std::uint32_t Canvas::pixel(int u, int v) const {
  cairo_surface_flush(surface_.get());
  const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  const auto* row = reinterpret_cast<const std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(v) * stride);
  return row[u] & 0xffffffU;
}

std::vector<std::uint8_t> Canvas::png() const {
  std::vector<std::uint8_t> bytes;
  cairo_surface_flush(surface_.get());
  if (cairo_surface_write_to_png_stream(surface_.get(), append_bytes, &bytes) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error("cannot encode a PNG");
  }
  return bytes;
}

std::vector<std::uint8_t> Canvas::jpeg(int quality) const {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;  // NOLINT: libjpeg's type
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width_);
  jpeg.image_height = static_cast<JDIMENSION>(height_);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(width_) * 3);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const std::uint32_t colour = pixel(u, v);
      row[3 * u] = static_cast<std::uint8_t>(colour >> 16);
      row[3 * u + 1] = static_cast<std::uint8_t>(colour >> 8 & 0xffU);
      row[3 * u + 2] = static_cast<std::uint8_t>(colour & 0xffU);
    }
    JSAMPROW rows = row.data();
    jpeg_write_scanlines(&jpeg, &rows, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::vector<std::uint8_t> bytes(buffer, buffer + size);
  jpeg_destroy_compress(&jpeg);
  std::free(buffer);  // NOLINT: libjpeg allocates with malloc
  return bytes;
}

void Canvas::write_png(const std::string& path) const {
  write_bytes(path, png());
}

void write_bytes(const std::string& path, std::span<const std::uint8_t> bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace omma::ground
