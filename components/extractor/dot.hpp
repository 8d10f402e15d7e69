// Dot: a blob in one image that the extractor thinks is a star or a target.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"
#include "hal/camera.hpp"

namespace omma {

/// Bits of Dot::flags.
enum DotFlag : std::uint8_t {
  kDotSaturated = 1,  ///< at least one pixel at the white level
  kDotAtEdge = 2,     ///< touches the image border or the mask: centre not to be trusted
  kDotElongated = 4,  ///< a trail or two blended dots
  kDotHotPixel = 8,   ///< sharper than the point spread allows
};

struct Dot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();           ///< centre [px], image frame (u right, v down)
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the centre [px²]
  float flux = 0;                                            ///< sum over the background [grey levels]
  float peak = 0;          ///< brightest pixel over the background [grey levels]
  float background = 0;    ///< local background [grey levels]
  float snr = 0;           ///< flux over its standard deviation
  float sigma_major = 0;   ///< second moment, long axis [px]
  float sigma_minor = 0;   ///< second moment, short axis [px]
  std::uint16_t area = 0;  ///< pixels
  std::uint8_t flags = 0;  ///< DotFlag
};

/// The dots of one image, brightest first.
struct DotList {
  std::uint64_t frame = 0;  ///< frame id (trigger number)
  TimeNs time_ns = 0;       ///< exposure midpoint
  FrameStatus status = FrameStatus::kMissing;
  std::uint32_t dropped = 0;  ///< dots found beyond the capacity, the faintest
  float background = 0;       ///< median background [grey levels]
  float noise = 0;            ///< median standard deviation of a pixel [grey levels]
  bool everywhere = true;     ///< false: looked for in windows about expected dots only
  float masked = 0;           ///< share of the image in which nothing was looked for
  StaticVector<Dot, limits::kDotsPerCamera> dots;
};

}  // namespace omma
