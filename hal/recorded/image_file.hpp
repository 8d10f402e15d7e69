// Image files in and out: PNG, JPEG and FITS are read as one grey image of 8 or 16 bits; PNG is written.
// Start-up, ground and the background threads of drivers only: everything here allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hal/image.hpp"

namespace omma {

/// A grey image with its storage; rows packed.
struct Image {
  std::vector<std::byte> pixels;
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  PixelFormat format = PixelFormat::kGrey8;
  std::uint16_t white_level = 255;

  int bytes_per_pixel() const { return format == PixelFormat::kGrey8 ? 1 : 2; }
  ImageView view() const {
    return {pixels.data(), width, height, std::ptrdiff_t{width} * bytes_per_pixel(), format, white_level};
  }
  /// Sets size and format and makes room; the pixels are not cleared. Keeps its storage where it is large
  /// enough.
  void resize(int new_width, int new_height, PixelFormat new_format);
};

/// No side of an image file may be longer [px]: a damaged header must not ask for all memory.
inline constexpr int kImageFileSide = 16384;

/// Reads a PNG, JPEG or FITS file, told apart by their first bytes.
///
/// Colour becomes luminance (Rec. 601: 0.299 R + 0.587 G + 0.114 B) of 8 bits; opacity is ignored. Grey keeps
/// its 8 or 16 bits. FITS: the first two-dimensional image; 8 bits and unsigned 16 bits as they are, other
/// types in their units where they fit 0 … 65535, otherwise scaled to fill 16 bits (blank pixels become the
/// lowest); rows from the bottom up unless the header's ROWORDER says TOP-DOWN, so that the picture stands
/// upright.
/// @throws InputError: missing, damaged, cut short, or not such an image. Nothing half-loaded is returned.
Image read_image(const std::filesystem::path& file);
/// The same from the bytes of a file; `file` is only for messages.
Image image_from_bytes(std::span<const std::byte> bytes, const std::string& file);
/// The same into `image`, whose storage is used again where it is large enough.
void read_image_bytes(std::span<const std::byte> bytes, const std::string& file, Image& image);

// One format each, from the file's bytes; `file` is only for messages. The result goes into `image`, whose
// storage is used again where it is large enough.
void read_png(std::span<const std::byte> bytes, const std::string& file, Image& image);
void read_jpeg(std::span<const std::byte> bytes, const std::string& file, Image& image);
void read_fits(std::span<const std::byte> bytes, const std::string& file, Image& image);

/// The bytes of a file into `bytes` (storage used again); InputError where it cannot be read.
void read_bytes(const std::filesystem::path& file, std::vector<std::byte>& bytes);

struct ImageSize {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  int bits = 0;    ///< 8 or 16 as read_image would give it
};
/// From the header of a PNG file alone; InputError where there is none.
ImageSize read_png_size(const std::filesystem::path& file);
/// The same of any kind: others than PNG are read whole.
ImageSize read_image_size(const std::filesystem::path& file);

enum class PngEffort : std::uint8_t {
  kStored,  ///< not compressed: as fast as the disk
  kFast,    ///< a few times faster, somewhat larger
  kSmall,   ///< what a report should hold
};

/// A grey PNG of 8 or 16 bits. A white level below the format's largest is noted in the file and read back.
std::vector<std::byte> encode_png(const ImageView& image, PngEffort effort = PngEffort::kSmall);
/// A grey JPEG. @param grey  8 bits. @param quality  1 ... 100
std::vector<std::byte> encode_jpeg(const ImageView& grey, int quality);
/// A colour PNG: `rgb` holds 3 × width × height bytes, rows packed.
std::vector<std::byte> encode_png_rgb(int width, int height, std::span<const std::uint8_t> rgb,
                                      PngEffort effort = PngEffort::kSmall);
/// The same into a file; InputError where it cannot be written.
void write_png(const std::filesystem::path& file, const ImageView& image,
               PngEffort effort = PngEffort::kSmall);
void write_png_rgb(const std::filesystem::path& file, int width, int height,
                   std::span<const std::uint8_t> rgb, PngEffort effort = PngEffort::kSmall);

}  // namespace omma
