// How well the flight program did: each product beside the truth and beside the Cramér–Rao bound, frame set
// by frame set and summed up. Conventions: docs/algorithms/report.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "ground/report/bound.hpp"
#include "ground/report/flight_log.hpp"
#include "ground/report/flown_mission.hpp"
#include "ground/report/statistics.hpp"
#include "ground/report/truth.hpp"

namespace omma::ground {

/// One frame set. Errors are true minus estimated, in the rig frame; `sigma` is the estimate's own, `bound`
/// the smallest that the detectable spots allow (NaN where they do not fix the unknowns).
struct AttitudeError {
  std::uint64_t frame = 0;
  double time = 0;                                  ///< since the first frame set of the truth [s]
  Eigen::Vector3d error = Eigen::Vector3d::Zero();  ///< small rotation [rad]
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d bound = Eigen::Vector3d::Zero();
  Eigen::Vector3d used_bound = Eigen::Vector3d::Zero();  ///< bound of the spots the solution was made of
  double nees = 0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< the part of the error that is the exposures' mean
  double rest_nees = 0;                             ///< without it
};

/// Errors against the protection levels they were published with, axis by axis.
struct ProtectionCheck {
  std::size_t axes = 0;    ///< that had a level
  std::size_t beyond = 0;  ///< whose error is larger
  std::size_t alerts = 0;  ///< solutions published with an alert
};

struct AttitudeEvaluation {
  std::vector<AttitudeError> points;                         ///< solved frame sets
  std::size_t frames = 0;                                    ///< of the truth
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();             ///< [rad]
  Eigen::Vector3d bound_rms = Eigen::Vector3d::Zero();       ///< [rad]
  Eigen::Vector3d used_bound_rms = Eigen::Vector3d::Zero();  ///< [rad]
  MeanNees nees;
  ProtectionCheck protection;
  Eigen::Vector3d shift_rms = Eigen::Vector3d::Zero();  ///< [rad]
  Eigen::Vector3d rest_rms = Eigen::Vector3d::Zero();   ///< of the errors without the shift [rad]
  MeanNees rest_nees;
};

struct PoseError {
  std::uint64_t frame = 0;
  double time = 0;                    ///< [s]
  double range = 0;                   ///< from the rig's to the body's origin [m]
  Vector6d error = Vector6d::Zero();  ///< (small rotation [rad], position [m])
  Vector6d sigma = Vector6d::Zero();
  Vector6d bound = Vector6d::Zero();
  Vector6d used_bound = Vector6d::Zero();
  double nees = 0;
  Vector6d shift = Vector6d::Zero();  ///< the part of the error that is the exposures' mean
  double rest_nees = 0;               ///< without it
};

/// Of three axes together: √ of the mean squared length.
struct OverBound {
  double rms = 0;
  double bound = 0;       ///< the same of the bound: √ of its mean trace
  double used_bound = 0;  ///< with the spots the solution was made of
  double ratio() const { return bound > 0 ? rms / bound : 0; }
};

/// The motion since the first accepted pose of a body, beside the true one since that frame set. All samples
/// share the first pose's error, so that one flight's mean NEES scatters as one draw of it does.
struct MotionEvaluation {
  std::vector<PoseError> points;    ///< bounds are not worked out; the first pose itself is left out
  std::uint64_t first_frame = 0;    ///< of the last sample
  Vector6d rms = Vector6d::Zero();  ///< per axis (rotation [rad], position [m])
  double mean_nees = 0;             ///< 6 is right
};

struct PoseEvaluation {
  std::string body;
  std::vector<PoseError> points;    ///< solved frame sets
  std::size_t frames = 0;           ///< of the truth that have the body
  double first_range = 0;           ///< [m]
  double last_range = 0;            ///< [m]
  Vector6d rms = Vector6d::Zero();  ///< per axis (rotation [rad], position [m])
  Vector6d bound_rms = Vector6d::Zero();
  OverBound position_part;  ///< of the range
  OverBound rotation;       ///< [rad]
  MeanNees nees;
  ProtectionCheck protection;
  MotionEvaluation motion;
  Vector6d shift_rms = Vector6d::Zero();
  Vector6d rest_rms = Vector6d::Zero();  ///< of the errors without the shift
  MeanNees rest_nees;
};

/// Spots paired, against where the truth has the star or target of that name.
struct PairCheck {
  std::size_t right = 0;
  std::size_t wrong = 0;    ///< the truth has it more than kLargestOffset away
  std::size_t unknown = 0;  ///< too faint to be in the truth
};
inline constexpr double kLargestOffsetPx = 3;

struct SpotCount {
  double time = 0;
  int detectable_stars = 0;  ///< in the images of all cameras, by the truth
  int paired_stars = 0;
  int detectable_targets = 0;
  int paired_targets = 0;
};

struct Evaluation {
  double duration = 0;  ///< from the first to the last frame set of the truth [s]
  AttitudeEvaluation attitude;
  std::vector<PoseEvaluation> poses;  ///< in the order of the mission's bodies
  PairCheck pairs;
  std::vector<SpotCount> counts;
  bool exposures_told = false;  ///< by the truth: the shifts are known (docs/algorithms/report.md)
};

/// Where the bounds of the points come from.
enum class BoundFrom {
  kSpots,     ///< the truth's spots: Cramér–Rao
  kEstimate,  ///< a truth that knows no spots (another instrument's): the estimate's own covariance
};

/// @throws InputError where the log has a frame set that the truth does not, or a body the mission does not
Evaluation evaluate(const FlownMission& mission, const std::vector<TruthFrame>& truth, const FlightLog& log,
                    const std::string& log_path, BoundFrom bound = BoundFrom::kSpots);

}  // namespace omma::ground
