#include "hal/live/pixel_layout.hpp"

#include <array>
#include <cstring>
#include <string>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr std::array kLayouts{
    PixelLayout{"GREY", PixelKind::kGrey, 8, 1},      PixelLayout{"Y10", PixelKind::kGrey, 10, 2},
    PixelLayout{"Y12", PixelKind::kGrey, 12, 2},      PixelLayout{"Y14", PixelKind::kGrey, 14, 2},
    PixelLayout{"Y16", PixelKind::kGrey, 16, 2},      PixelLayout{"BA81", PixelKind::kBayer, 8, 1, 0},
    PixelLayout{"GBRG", PixelKind::kBayer, 8, 1, 1},  PixelLayout{"GRBG", PixelKind::kBayer, 8, 1, 1},
    PixelLayout{"RGGB", PixelKind::kBayer, 8, 1, 0},  PixelLayout{"BG10", PixelKind::kBayer, 10, 2, 0},
    PixelLayout{"GB10", PixelKind::kBayer, 10, 2, 1}, PixelLayout{"BA10", PixelKind::kBayer, 10, 2, 1},
    PixelLayout{"RG10", PixelKind::kBayer, 10, 2, 0}, PixelLayout{"BG12", PixelKind::kBayer, 12, 2, 0},
    PixelLayout{"GB12", PixelKind::kBayer, 12, 2, 1}, PixelLayout{"BA12", PixelKind::kBayer, 12, 2, 1},
    PixelLayout{"RG12", PixelKind::kBayer, 12, 2, 0}, PixelLayout{"BYR2", PixelKind::kBayer, 16, 2, 0},
    PixelLayout{"GB16", PixelKind::kBayer, 16, 2, 1}, PixelLayout{"GR16", PixelKind::kBayer, 16, 2, 1},
    PixelLayout{"RG16", PixelKind::kBayer, 16, 2, 0}, PixelLayout{"YUYV", PixelKind::kYuv, 8, 2, 0},
    PixelLayout{"UYVY", PixelKind::kYuv, 8, 2, 1},    PixelLayout{"RGB3", PixelKind::kRgb, 8, 3, 0},
    PixelLayout{"BGR3", PixelKind::kRgb, 8, 3, 2}};

template <class Pixel>
Pixel load(const std::byte* at) {
  Pixel value{};
  std::memcpy(&value, at, sizeof value);  // a device's rows need not be aligned
  return value;
}

// Mean of a cell's four pixels, or of its two greens.
template <class Pixel>
void bin_row(const std::byte* upper, const std::byte* lower, bool green_only, bool green_first, int width,
             std::byte* out) {
  for (int u = 0; u < width; ++u) {
    const std::size_t left = 2 * static_cast<std::size_t>(u) * sizeof(Pixel);
    const unsigned a = load<Pixel>(upper + left);
    const unsigned b = load<Pixel>(upper + left + sizeof(Pixel));
    const unsigned c = load<Pixel>(lower + left);
    const unsigned d = load<Pixel>(lower + left + sizeof(Pixel));
    const unsigned mean = !green_only   ? (a + b + c + d + 2) / 4
                          : green_first ? (a + d + 1) / 2
                                        : (b + c + 1) / 2;
    const auto pixel = static_cast<Pixel>(mean);
    std::memcpy(out + static_cast<std::size_t>(u) * sizeof(Pixel), &pixel, sizeof pixel);
  }
}

void yuv_row(const std::byte* source, int first, int width, std::byte* out) {
  for (int u = 0; u < width; ++u) out[u] = source[2 * u + first];
}

void rgb_row(const std::byte* source, int red, int width, std::byte* out) {
  for (int u = 0; u < width; ++u) {
    const std::byte* const pixel = source + std::ptrdiff_t{3} * u;
    const auto r = static_cast<unsigned>(pixel[red]);
    const auto g = static_cast<unsigned>(pixel[1]);
    const auto b = static_cast<unsigned>(pixel[2 - red]);
    out[u] = static_cast<std::byte>((299 * r + 587 * g + 114 * b + 500) / 1000);
  }
}

}  // namespace

std::span<const PixelLayout> pixel_layouts() {
  return kLayouts;
}

const PixelLayout* find_pixel_layout(std::string_view name) {
  for (const PixelLayout& layout : kLayouts)
    if (layout.name == name) return &layout;
  return nullptr;
}

const PixelLayout& layout_of(const CameraSetup& setup) {
  if (const PixelLayout* layout = find_pixel_layout(setup.format)) return *layout;
  std::string names;
  for (const PixelLayout& layout : kLayouts) names += (names.empty() ? "" : ", ") + std::string(layout.name);
  throw InputError(setup.where, 0, "format", "one of " + names, setup.format);
}

GreyShape shape_of(const CameraSetup& setup) {
  const PixelLayout& layout = layout_of(setup);
  if (setup.width < 1 || setup.height < 1) {
    throw InputError(setup.where, 0, "size", "at least 1 x 1 px",
                     std::to_string(setup.width) + " x " + std::to_string(setup.height));
  }
  const int cell = binning(layout, setup.bayer);
  GreyShape shape = grey_shape(layout, setup.bayer, cell * setup.width, cell * setup.height);
  if (setup.bits == 0) return shape;
  if (setup.bits > layout.bits || (setup.bits > 8) != (layout.bits > 8)) {
    throw InputError(setup.where, 0, "bits",
                     (layout.bits > 8 ? "9 to " : "8 to ") + std::to_string(layout.bits) + ", as format " +
                         setup.format + " has",
                     std::to_string(setup.bits));
  }
  shape.white_level = static_cast<std::uint16_t>((1U << static_cast<unsigned>(setup.bits)) - 1);
  return shape;
}

int binning(const PixelLayout& layout, BayerUse bayer) {
  return layout.kind == PixelKind::kBayer && bayer != BayerUse::kRaw ? 2 : 1;
}

GreyShape grey_shape(const PixelLayout& layout, BayerUse bayer, int width, int height) {
  const int cell = binning(layout, bayer);
  return {.width = width / cell,
          .height = height / cell,
          .format = layout.bits > 8 ? PixelFormat::kGrey16 : PixelFormat::kGrey8,
          .white_level = static_cast<std::uint16_t>((1U << static_cast<unsigned>(layout.bits)) - 1)};
}

void to_grey(const PixelLayout& layout, BayerUse bayer, const std::byte* source, std::ptrdiff_t stride,
             const GreyShape& shape, std::byte* pixels) noexcept {
  const bool binned = binning(layout, bayer) == 2;
  const bool green_only = bayer == BayerUse::kGreen;
  for (int v = 0; v < shape.height; ++v) {
    const std::byte* const row = source + (binned ? 2 : 1) * v * stride;
    std::byte* const out = pixels + static_cast<std::size_t>(v) * shape.row_bytes();
    if (layout.kind == PixelKind::kYuv) {
      yuv_row(row, layout.first, shape.width, out);
    } else if (layout.kind == PixelKind::kRgb) {
      rgb_row(row, layout.first, shape.width, out);
    } else if (!binned) {
      std::memcpy(out, row, shape.row_bytes());
    } else if (layout.bytes == 1) {
      bin_row<std::uint8_t>(row, row + stride, green_only, layout.first == 1, shape.width, out);
    } else {
      bin_row<std::uint16_t>(row, row + stride, green_only, layout.first == 1, shape.width, out);
    }
  }
}

}  // namespace omma
