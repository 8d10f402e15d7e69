// The imaging component with the outputs it reads, as a topology would bind them, under a painted sky.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "components/imaging/imaging.hpp"
#include "tests/components/imaging/painted_sky.hpp"

namespace omma::testing {

inline double smooth_sky(const Eigen::Vector3d& d) {
  return 0.15 + 0.05 * d.x() - 0.03 * d.z();
}

struct ImagingBench {
  explicit ImagingBench(const ImagingParameters& parameters)
      : rig(tetrahedral_rig()), imaging(parameters, rig, events) {
    imaging.frames.bind(frames);
    imaging.dots.bind(dots);
    imaging.attitude.bind(attitude);
    dots->cameras.resize(rig.cameras.size());
    for (DotList& list : dots->cameras) list.background = 0;
  }

  void take(std::uint64_t number, const Eigen::Quaterniond& rig_from_j2000,
            const PaintedSky& sky = smooth_sky, const CameraSettings& settings = {}) {
    images = paint(rig, rig_from_j2000, sky);
    frames->number = number;
    frames->cameras.clear();
    for (const ImageView& view : images.views)
      frames->cameras.push_back({view, number, 0, FrameStatus::kFresh, settings});
    attitude->valid = true;
    attitude->frame = number;
    attitude->time_ns = static_cast<TimeNs>(number) * 100000000;
    attitude->solution.rig_from_j2000 = rig_from_j2000;
  }

  Rig rig;
  Events events;
  Out<Frames> frames;
  Out<DotLists> dots;
  Out<AttitudeEstimate> attitude;
  PaintedImages images;
  Imaging imaging;
};

/// The levels of a chunk's rows; false where they cannot be decoded.
inline bool levels_of(const ImageChunk& chunk, std::span<std::uint16_t> out) {
  const std::span<const std::uint8_t> bytes(chunk.pixels.data(), chunk.bytes);
  const bool wide = chunk.bits > 8;
  if (chunk.encoding == ImageEncoding::kPredictedZstd) {
    if (wide) return decode_rows(bytes, chunk.width, chunk.rows, out);
    std::vector<std::uint8_t> narrow(out.size());
    if (!decode_rows(bytes, chunk.width, chunk.rows, narrow)) return false;
    std::copy(narrow.begin(), narrow.end(), out.begin());
    return true;
  }
  if (bytes.size() != out.size() * (wide ? 2 : 1)) return false;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = wide ? static_cast<std::uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8)) : bytes[i];
  return true;
}

}  // namespace omma::testing
