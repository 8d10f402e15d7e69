// The adjustment of a rig to views of bodies with known targets (cards, boards): the pose of every camera on
// the rig, of every body in the room, and of the rig in the room at every frame set, in one weighted least
// squares over all targets of all images, with the covariance of everything. This is what the dissertation
// wished for instead of moving the rig onto one camera resected from one image. Source: Triggs et al. 2000,
// Bundle Adjustment. docs/calibrate.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "components/geometry/pose.hpp"
#include "components/geometry/rig.hpp"

namespace omma::ground {

/// One dot with its target.
struct TargetSight {
  int set = 0;
  int camera = 0;
  int body = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the target, body frame [m]
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the dot [px²]
};

struct RigGeometry {
  std::vector<Pose> rig_from_camera;  ///< the first stays as it is: it holds the rig's frame
  std::vector<Pose> room_from_body;   ///< the first stays as it is: it holds the room's
  std::vector<Pose> rig_from_room;    ///< one a frame set
};

struct RigAdjustment {
  bool converged = false;
  RigGeometry geometry;
  /// Of cameras 1 …, bodies 1 …, frame sets, each a small turn [rad] and a shift [m] in the frame on the left
  /// of its name.
  Eigen::MatrixXd covariance;
  double floor_px = 0;  ///< standard deviation per axis that the dots' own covariances leave unexplained
  double chi2 = 0;
  int degrees = 0;                         ///< of freedom
  std::vector<std::uint8_t> used;          ///< one a sight: 0 where culled
  std::vector<Eigen::Vector2d> residuals;  ///< dot minus prediction [px]
  double rms_px = 0;                       ///< root mean square length of the residuals used

  /// @param camera  from 1 on
  Matrix6d camera_covariance(std::size_t camera) const {
    return covariance.block<6, 6>(6 * (static_cast<Eigen::Index>(camera) - 1),
                                  6 * (static_cast<Eigen::Index>(camera) - 1));
  }
};

struct RigAdjustmentOptions {
  double gate = 4.0;       ///< residuals beyond so many standard deviations are culled
  bool find_floor = true;  ///< false: the dots' covariances are taken as they are
};

/// @param lenses  of the cameras, in their order; taken as exact
RigAdjustment adjust_rig(const Rig& lenses, const RigGeometry& start, const std::vector<TargetSight>& sights,
                         const RigAdjustmentOptions& options);

}  // namespace omma::ground
