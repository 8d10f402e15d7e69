// Puts the pictures together again that came down in chunks of rows.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "components/imaging/grey_scale.hpp"
#include "components/telemetry/topics.hpp"
#include "ground/draw/canvas.hpp"

namespace omma::ground {

struct ChunkPicture {
  omma_ImageKind kind = omma_IMAGE_PANORAMA_J2000;
  omma_ImageComposite composite = omma_COMPOSITE_SINGLE;
  int composed = 1;
  int camera = 0;  ///< of a part of a camera's image
  int left = 0;    ///< [px]
  int top = 0;
  double pan = 0;  ///< of views and fisheyes: where the middle looks [rad]
  double tilt = 0;
  double field = 0;  ///< from the left border to the right [rad]; 0: of a camera's own image
  GreyScale scale;   ///< what the levels stand for
  /// Rows that did not arrive are 0.
  std::vector<std::uint16_t> levels;
  GreyPicture picture;            ///< the same, to be looked at: their upper 8 bits
  std::vector<bool> rows;         ///< which arrived
  std::uint64_t first_frame = 0;  ///< frame sets its rows were taken from
  std::uint64_t last_frame = 0;
  std::uint64_t bytes = 0;  ///< that came down
  bool complete() const;
  int rows_there() const;
};

class ChunkPictures {
 public:
  /// A chunk that contradicts itself (its rows and its bytes), cannot be decoded, or contradicts its picture
  /// (another size) is left out and counted.
  void take(const omma_ImageChunk& chunk);

  /// By image number, complete or not.
  const std::map<std::uint32_t, ChunkPicture>& pictures() const { return pictures_; }
  std::uint64_t refused() const { return refused_; }
  /// The last complete picture of a kind; null where there is none.
  const ChunkPicture* last_complete(omma_ImageKind kind) const;

 private:
  bool decode(const omma_ImageChunk& chunk);

  std::map<std::uint32_t, ChunkPicture> pictures_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> rows_;  // levels of the chunk at hand
  std::uint64_t refused_ = 0;
};

}  // namespace omma::ground
