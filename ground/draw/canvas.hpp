// Canvas: an RGB picture to draw on, for annotations and reports. A thin layer over cairo (antialiased lines,
// text); positions are pixels with (0,0) the centre of the top-left pixel, as everywhere else here.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier): cairo's own name
struct _cairo;          // NOLINT(bugprone-reserved-identifier)

namespace omma::ground {

/// Colour and opacity, each 0 … 1.
struct Colour {
  double red = 1;
  double green = 1;
  double blue = 1;
  double alpha = 1;
  Colour with_alpha(double value) const { return {red, green, blue, value}; }
};

/// Axis-aligned box [px]: what a piece of text covers.
struct Box {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  Box grown(double margin) const { return {left - margin, top - margin, right + margin, bottom + margin}; }
};

/// Grey picture of 8 bits, rows packed: what a stretched image or a panorama is.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

class Canvas {
 public:
  /// A black picture. @throws std::runtime_error when the size is not positive or memory is short
  Canvas(int width, int height);
  /// The grey picture enlarged `scale` times (smoothly), with `footer` black rows below it.
  explicit Canvas(const GreyPicture& picture, int scale = 1, int footer = 0);
  ~Canvas();
  Canvas(Canvas&& other) noexcept;
  Canvas& operator=(Canvas&& other) noexcept;

  int width() const { return width_; }
  int height() const { return height_; }

  void fill_box(const Box& box, const Colour& colour);
  void circle(const Eigen::Vector2d& centre, double radius, const Colour& colour, double line_width);
  void disc(const Eigen::Vector2d& centre, double radius, const Colour& colour);
  void line(std::span<const Eigen::Vector2d> points, const Colour& colour, double line_width);
  /// Text with its baseline starting at `position`; a dark halo keeps it readable on any ground.
  void text(const Eigen::Vector2d& position, std::string_view utf8, double size, const Colour& colour);
  /// The box `text` would cover when drawn at `position`.
  Box text_box(const Eigen::Vector2d& position, std::string_view utf8, double size) const;

  /// The three colours of one pixel, 0xRRGGBB.
  std::uint32_t pixel(int u, int v) const;
  /// The file as bytes.
  std::vector<std::uint8_t> png() const;
  /// @param quality  1 … 100
  std::vector<std::uint8_t> jpeg(int quality) const;
  /// @throws std::runtime_error naming the path when it cannot be written
  void write_png(const std::string& path) const;

 private:
  struct SurfaceFree {
    void operator()(_cairo_surface* surface) const;
  };
  struct ContextFree {
    void operator()(_cairo* context) const;
  };
  int width_ = 0;
  int height_ = 0;
  std::unique_ptr<_cairo_surface, SurfaceFree> surface_;
  std::unique_ptr<_cairo, ContextFree> context_;
};

/// Writes bytes to a file. @throws std::runtime_error naming the path when it cannot be written
void write_bytes(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace omma::ground
