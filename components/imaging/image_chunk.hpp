// ImageChunk: some rows of an image on its way to the ground. Images are large and telemetry packets small,
// so an image travels a few rows per frame set and is put together again by its number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "config/limits.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

enum class ImageKind : std::uint8_t {
  kPanoramaJ2000,  ///< equirectangular, fixed to the stars: column 0 is right ascension 360°, leftward grows
  kPanoramaRig,    ///< equirectangular, fixed to the rig: azimuth about +z from +x
  kView,           ///< virtual pan-tilt camera
};

struct ImageChunk {
  std::uint64_t frame = 0;  ///< frame set these rows were taken from
  TimeNs time_ns = 0;       ///< its exposure midpoint
  bool valid = false;       ///< false: no rows this time
  ImageKind kind = ImageKind::kPanoramaJ2000;
  std::uint32_t image = 0;   ///< counts images; chunks with the same number belong together
  std::uint16_t width = 0;   ///< of the whole image [px]
  std::uint16_t height = 0;  ///< of the whole image [px]
  std::uint16_t first_row = 0;
  std::uint16_t rows = 0;  ///< rows × width bytes of `pixels` are in use
  std::array<std::uint8_t, limits::kImageChunkBytes> pixels{};  ///< grey, row after row, top row first
};

}  // namespace omma
