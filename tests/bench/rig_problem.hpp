// Pose problems of a rig and a target card with known truth: the problem that the peers (PoseLib, OpenGV,
// Ceres, OpenCV) were measured on, number for number: the same seed gives the same card, noise, prior and
// mis-pairings. Three cameras on faces of a tetrahedron, a card of 10 × 8 in, bearing noise equal in all
// directions.
#pragma once

#include <cstdint>
#include <vector>

#include "components/estimation/sight.hpp"
#include "components/geometry/pose.hpp"

namespace omma {

struct RigProblemOptions {
  int targets = 20;
  int cameras = 3;
  double baseline = 0.1;               ///< between camera centres [m]
  double range = 1.3;                  ///< rig origin to card centre [m]
  double card_width = 0.254;           ///< [m]
  double card_height = 0.2032;         ///< [m]
  double depth = 0.0;                  ///< ± relief of the card [m]; 0: flat
  double max_tilt_deg = 40.0;          ///< of the card away from facing the rig
  double sigma_deg = 0.05;             ///< of a bearing, each axis
  double outlier_fraction = 0.0;       ///< sights paired with another target of the card
  bool every_camera_sees_all = false;  ///< false: target i is seen by camera i mod n alone
  bool surround = false;               ///< a card before each camera, no common field
  double off_axis_deg = 70.5288;       ///< rig axis to each optical axis
  double prior_rotation_deg = 5.0;     ///< rms
  double prior_position = 0.05;        ///< rms [m]
};

struct RigProblem {
  std::vector<Sight> sights;
  std::vector<std::uint8_t> camera;      ///< of each sight
  std::vector<std::uint16_t> entry;      ///< of each sight: index of its target in `targets`
  std::vector<Eigen::Vector3d> axes;     ///< of each camera, rig frame
  std::vector<std::uint8_t> is_outlier;  ///< of each sight: truth, for scoring only
  std::vector<Eigen::Vector3d> targets;  ///< body frame [m]
  Pose truth;                            ///< rig_from_body
  Pose prior;
  Matrix6d bound;  ///< Cramér–Rao bound of (δθ, δt), rig frame, from the right sights
};

RigProblem make_rig_problem(const RigProblemOptions& options, std::uint64_t seed);

/// (δθ, δt) with truth = exp(δθ) estimate, t_truth = t_estimate + δt.
Vector6d pose_error(const Pose& estimate, const Pose& truth);

/// Sight of a direction or point with noise `sigma` [rad] equal in all directions.
Sight isotropic_sight(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, double sigma,
                      const Eigen::Vector3d& point);

}  // namespace omma
