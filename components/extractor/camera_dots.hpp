// One camera's raw frames to dots: sensor correction, masks, extraction, illumination of the lens.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "components/extractor/best_dots.hpp"
#include "components/extractor/classical/classical_extractor.hpp"
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
  /// Other kinds of things, looked for in the same frames in other ways; what lies on a dot found before is
  /// it.
  std::vector<ExtractorParameters> also;
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
  const ExtractorParameters& parameters() const { return searches_.front().parameters; }
  /// From the next frame on; of what is also looked for, gain and black level alone. The black level of a
  /// camera with a black frame stays that frame's.
  void tune(const ExtractorParameters& parameters) noexcept;

 private:
  const PixelMask* masked(const ImageView& image) noexcept;
  // One way of looking for dots.
  struct Search {
    ExtractorParameters parameters;
    std::unique_ptr<DotExtractor> matched;  // one of the two
    std::unique_ptr<ClassicalExtractor> classical;

    Search(int width, int height, const ExtractorParameters& p);
    void find(const ImageView& image, const ImageMasks& masks, const WindowTiles* windows,
              DotList& list) noexcept;
  };
  void add_others(const ImageView& image, const ImageMasks& masks, DotList& list) noexcept;
  const BackgroundMap& background() const noexcept;
  void age(const DotList& list) noexcept;
  bool sky_has_moved(const DotList& list) noexcept;

  int height_;  // [px]
  std::vector<Search> searches_;
  std::vector<Dot> found_;           // by all of several searches
  std::unique_ptr<DotList> others_;  // of one more search
  BestDots best_;
  bool has_black_frame_;
  FrameCorrection correction_;
  PixelMask mask_;
  bool has_mask_;
  std::optional<Glare> glare_;
  PixelMask mask_now_;  // with the frame's glare
  RelativeIllumination illumination_;
  WindowTiles tiles_;
  std::vector<float> level_row_;
  // Dots of the frame in which the black frame last aged.
  StaticVector<Eigen::Vector2f, 64> aged_at_;
  int next_aged_row_ = 0;
};

}  // namespace omma
