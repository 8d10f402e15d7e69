// Fused strip: some rows of a picture, made of several frame sets with different exposures. Each frame set is
// put on the picture's own grid by its own attitude, so that the exposures fit together while the rig turns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/imaging/exposure_fusion.hpp"
#include "components/imaging/grey_scale.hpp"
#include "components/imaging/picture.hpp"

namespace omma {

class FusedStrip {
 public:
  /// Allocates 16 bytes a pixel.
  explicit FusedStrip(std::size_t most_pixels) : light_(most_pixels) {}

  /// Begins rows from `first_row`: as many as asked, as there are, and as there is room for.
  void begin(const Picture& picture, int first_row, int rows) noexcept;
  /// Adds one frame set; what it takes depends on rows · width · cameras alone.
  void add(const Picture& picture, const Mosaic& mosaic, RigImages images, const RigExposed& exposed,
           const Eigen::Quaterniond& rig_from_j2000) noexcept;
  int frame_sets() const noexcept { return frame_sets_; }
  int rows() const noexcept { return rows_; }
  /// The strip's grey levels, row after row; as many as fit. 0 too where only exposures looked that are too
  /// short to say anything.
  void levels(const GreyScale& scale, std::span<std::uint16_t> out) const noexcept;

 private:
  std::vector<FusedLight> light_;
  int first_row_ = 0;
  int rows_ = 0;
  int width_ = 0;
  int frame_sets_ = 0;
};

}  // namespace omma
