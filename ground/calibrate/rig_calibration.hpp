// Calibration of a rig from views of cards and boards: where everything is, roughly, from the pose of each
// card in each image, then one adjustment of all. Beside it the dissertation's way: each camera from one
// image.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ground/calibrate/rig_adjustment.hpp"

namespace omma::ground {

/// What one camera saw of one body in one frame set.
struct BodyView {
  int set = 0;
  int camera = 0;
  int body = 0;
  Pose camera_from_body;  ///< by resection of this image alone
  std::vector<TargetSight> sights;
};

struct RigCalibration {
  bool done = false;
  std::string reason;  ///< why not, in a sentence
  Rig rig;             ///< the one given, its cameras' poses put right
  RigAdjustment adjustment;
  std::vector<TargetSight> sights;
  /// Of each camera: its pose from one image of its own and one of camera 0, the first frame set where both
  /// see a body; none of camera 0.
  std::vector<std::optional<Pose>> one_image;
};

/// @param rig     lenses, names, and the pose of camera 0, which stays; the others' poses are a guess that
///                matters only where no chain of images ties them to camera 0
/// @param bodies  how many there are; the room is the frame of the first
RigCalibration calibrate_rig(const Rig& rig, int bodies, const std::vector<BodyView>& views,
                             const RigAdjustmentOptions& options);

}  // namespace omma::ground
