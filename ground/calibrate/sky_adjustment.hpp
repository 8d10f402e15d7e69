// The adjustment of a rig to stars: every lens, the rotation of each camera on the rig, and the attitude of
// every frame set, in one weighted least squares over all stars of all images, with the covariance of
// everything. The stars are the calibration field: known to milliarcseconds, all around, and for nothing.
// Sources: Triggs et al. 2000, Bundle Adjustment (Gauss–Newton with Levenberg's damping, gauge); Klaus et al.
// 2004 (camera calibration from a single night sky image). docs/calibrate.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "ground/calibrate/lens_shape.hpp"

namespace omma::ground {

/// One dot with its star.
struct StarSight {
  int frame = 0;
  int camera = 0;
  std::uint16_t hr = 0;
  Eigen::Vector3d star = Eigen::Vector3d::UnitZ();  ///< apparent place, J2000 axes, unit
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the dot [px²]
  float snr = 0;
};

/// What is known of the rig, before and after.
struct SkyRig {
  std::vector<LensShape> lenses;                    ///< one a camera
  std::vector<Eigen::Quaterniond> camera_from_rig;  ///< the first stays as it is: it holds the rig's frame
  std::vector<Eigen::Quaterniond> rig_from_j2000;   ///< one a frame set
};

struct SkyAdjustment {
  SkyRig rig;
  bool converged = false;
  int iterations = 0;
  /// Of the estimates, in the order: lenses (all their parameters), small rotations of cameras 1 … (camera
  /// frame), small rotations of the attitudes (rig frame). Zero rows for what was held.
  Eigen::MatrixXd covariance;
  double floor_px = 0;  ///< standard deviation per axis that the dots' own covariances leave unexplained
  double chi2 = 0;
  int degrees = 0;                         ///< of freedom
  std::vector<std::uint8_t> used;          ///< one a sight: 0 where culled
  std::vector<Eigen::Vector2d> residuals;  ///< dot minus prediction [px]
  double rms_px = 0;                       ///< root mean square length of the residuals used

  int lens_offset(std::size_t camera) const;
};

struct AdjustmentOptions {
  int free_radial = 5;      ///< radial numbers of each lens that are found; higher ones are held
  bool free_aspect = true;  ///< aspect and skew too
  double gate = 4.0;        ///< residuals beyond so many standard deviations are culled
};

/// @param sights  at least enough to fix all unknowns; else `converged` is false
SkyAdjustment adjust_to_sky(const SkyRig& start, const std::vector<StarSight>& sights,
                            const AdjustmentOptions& options);

/// Standard deviation of where a lens puts directions at each of the angles off axis, root mean square of
/// both axes over directions all round [px], from the lens's part of the covariance. What a turn of the
/// camera would do is taken out: that is the attitude's uncertainty, not the lens's.
std::vector<double> lens_deviations(const LensShape& shape, const Eigen::MatrixXd& covariance,
                                    const std::vector<double>& angles);

}  // namespace omma::ground
