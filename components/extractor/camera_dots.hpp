// One camera's raw frames to dots: sensor correction, masks, extraction, illumination of the lens.
#pragma once

#include <optional>

#include "components/extractor/dot_extractor.hpp"
#include "components/sensor/frame_correction.hpp"
#include "components/sensor/glare.hpp"
#include "components/sensor/relative_illumination.hpp"

namespace omma {

/// One camera's image size, what is known of its sensor and lens, and what is looked for.
struct ExtractorCamera {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  ExtractorParameters parameters;
  SensorCalibration sensor;
  PixelMask mask;                        ///< where nothing is looked for; of no image: nowhere
  std::optional<GlareParameters> glare;  ///< large bright regions are masked, frame by frame
  RelativeIllumination illumination;
};

class CameraDots {
 public:
  explicit CameraDots(const ExtractorCamera& camera);

  /// Fills the list as DotExtractor does; fluxes are as if seen on the lens's axis.
  /// @param where  null: everywhere
  void find(const ImageView& raw, DotList& list, const CameraWindows* where = nullptr) noexcept;

  const FrameCorrection& correction() const { return correction_; }
  const ExtractorParameters& parameters() const { return parameters_; }
  /// From the next frame on; the black level of a camera with a black frame stays that frame's.
  void tune(const ExtractorParameters& parameters) noexcept;

 private:
  const PixelMask* masked(const ImageView& image) noexcept;
  void age(const DotList& list) noexcept;
  bool sky_has_moved(const DotList& list) noexcept;

  ExtractorParameters parameters_;
  bool has_black_frame_;
  FrameCorrection correction_;
  PixelMask mask_;
  bool has_mask_;
  std::optional<Glare> glare_;
  PixelMask mask_now_;  // with the frame's glare
  RelativeIllumination illumination_;
  DotExtractor extractor_;
  WindowTiles tiles_;
  std::vector<float> level_row_;
  // Dots of the frame in which the black frame last aged.
  StaticVector<Eigen::Vector2f, 64> aged_at_;
  int next_aged_row_ = 0;
};

}  // namespace omma
