// How the frames of a rig were exposed: what a grey level of each camera stands for, in one unit of light for
// all.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/camera/frames.hpp"
#include "components/imaging/grey_scale.hpp"
#include "components/imaging/mosaic.hpp"
#include "components/sensor/response_curve.hpp"

namespace omma {

/// What is known of a camera's pixels, for light in electrons a second; of the mission.
struct CameraSensor {
  double electrons = 0;    ///< a grey level; 0: not known, then a camera's light is shares of its white level
  double black_level = 0;  ///< grey level of no light, where the camera does not tell
  double read_noise = 5;   ///< [electrons]
  ResponseCurve response{};   ///< empty: linear. Levels are made even for fusion, not in other pictures
  double relative_noise = 0;  ///< of even levels, as a share of their light
};

/// The image of a frame of this trigger; empty where there is none.
inline ImageView usable_image(const Frame& frame) noexcept {
  const bool usable = frame.status == FrameStatus::kFresh || frame.status == FrameStatus::kSaturated;
  return usable ? frame.image : ImageView{};
}

class RigExposures {
 public:
  /// Allocates a table for each camera that is not linear.
  explicit RigExposures(const std::array<CameraSensor, limits::kCameras>& sensors);

  /// Of every frame set; bounded by the cameras.
  void take(const Frames& frames) noexcept;
  /// Frame sets taken in which at least one camera told its exposure.
  int told() const noexcept { return told_; }
  /// All that were taken.
  int frame_sets() const noexcept { return frame_sets_; }

  /// For fusion. The unit is the share a second of the white level of the camera that holds the fewest
  /// electrons.
  const RigExposed& exposed() const noexcept { return exposed_; }
  /// What a camera's share of its white level is to be multiplied by to be light in that unit times the
  /// reference exposure, which is let be where it is not linear; 1 where it is not known. @param reference
  /// from reference_exposure
  double scale(std::size_t camera, double reference) const noexcept;
  /// The longest of the frame set taken last [s]; 0: none is known.
  double reference_exposure() const noexcept;
  /// From the noise of reading in the longest exposure to the full pixel in the shortest, of all taken so
  /// far.
  GreyScale fused_scale(int bits) const noexcept;

 private:
  bool electrons_known() const noexcept;
  void take(std::size_t camera, const Frame& frame) noexcept;

  std::array<CameraSensor, limits::kCameras> sensors_;
  RigExposed exposed_{};
  struct EvenTable {
    std::vector<std::uint16_t> levels;  // by grey level; empty of linear cameras
    std::uint16_t white = 0;            // it was made for these
    double black = 0;
  };
  std::array<EvenTable, limits::kCameras> even_;
  std::array<double, limits::kCameras> white_{};  // [electrons], or 1 where electrons are not known
  std::size_t cameras_ = 0;
  double fewest_ = 1;  // electrons of a white level
  double least_ = 0;   // light of reading noise, in the longest exposure
  double most_ = 0;
  int told_ = 0;
  int frame_sets_ = 0;
};

}  // namespace omma
