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
  kView,           ///< virtual pan-tilt camera, fixed to the stars
  kFisheyeJ2000,   ///< half the sky about a direction, equal-distance, fixed to the stars
  kFisheyeRig,     ///< the same, fixed to the rig
  kCamera,         ///< a part of one camera's image as it was taken
  kViewRig,        ///< virtual pan-tilt camera, fixed to the rig
};

/// How a picture is made of several.
enum class ImageComposite : std::uint8_t {
  kSingle,
  kMean,       ///< less noise
  kDarkest,    ///< what stays: passing lights, glare and hits are gone
  kBrightest,  ///< what passed: trails
  kFused,      ///< several exposures become one of high range
};

enum class ImageEncoding : std::uint8_t {
  kGrey,           ///< rows × width bytes
  kPredictedZstd,  ///< image_coder.hpp
};

/// How a grey level from 1 to the largest, 2^bits − 1, stands for light; 0 is not seen. x = (level − 1) /
/// (largest − 1).
enum class ImageScale : std::uint8_t {
  kSquareRoot,  ///< light = most · x²
  kLinear,      ///< the camera's own grey levels, from 0: light = most · level / largest
  kAsinh,       ///< asinh(light / soft) from asinh(−1) at x = 0 to asinh(most / soft) at x = 1
};

struct ImageChunk {
  std::uint64_t frame = 0;  ///< frame set these rows were taken from
  TimeNs time_ns = 0;       ///< its exposure midpoint
  bool valid = false;       ///< false: no rows this time
  ImageKind kind = ImageKind::kPanoramaJ2000;
  ImageComposite composite = ImageComposite::kSingle;
  std::uint16_t composed = 1;  ///< pictures of a composite
  std::uint8_t camera = 0;     ///< of kCamera: index in the rig
  std::uint32_t image = 0;     ///< counts images; chunks with the same number belong together
  std::uint16_t width = 0;     ///< of the whole image [px]
  std::uint16_t height = 0;    ///< of the whole image [px]
  std::uint16_t left = 0;      ///< of kCamera: the camera's pixel at the top left [px]
  std::uint16_t top = 0;
  std::uint16_t first_row = 0;
  std::uint16_t rows = 0;
  ImageEncoding encoding = ImageEncoding::kGrey;
  std::uint8_t bits = 8;  ///< of a pixel: to 8 in one byte, to 16 in two, the low one first
  ImageScale scale = ImageScale::kSquareRoot;
  double light_most = 1;  ///< of the largest level [share of white; of kFused: shares a second]
  double light_soft = 0;  ///< of kAsinh
  double pan = 0;         ///< of views and fisheyes: where the middle looks [rad]
  double tilt = 0;
  double field = 0;         ///< from the left border to the right [rad]; 0: of a camera's own image
  std::uint16_t bytes = 0;  ///< of `pixels` in use
  std::array<std::uint8_t, limits::kImageChunkBytes>
      pixels{};  ///< grey, row after row, top row first; as encoded
};

}  // namespace omma
