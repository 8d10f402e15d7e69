// The gimbal between its commands and where the rig really points: pulses of finite steps, lash in the gears,
// play in the bearings, and a structure that swings after every start and stop. Formulas in
// docs/algorithms/simulation.md#gimbal.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "components/motion/axis.hpp"

namespace omma::sim {

/// Follows a driving side within a gap: it stands still while the driver crosses the gap.
class Lash {
 public:
  /// @param gap  whole width [rad]; the follower begins in its middle
  Lash(double gap, double driver) : half_(0.5 * gap), follower_(driver) {}
  /// Where the follower is when the driver has come to `driver` (Prandtl-Ishlinskii play operator; Visintin,
  /// Differential Models of Hysteresis, 1994, section III.2).
  double follow(double driver) {
    follower_ = std::max(driver - half_, std::min(driver + half_, follower_));
    return follower_;
  }

 private:
  double half_;
  double follower_;
};

/// A damped oscillator whose foot is moved: z'' + 2 d w (z' − y') + w² (z − y) = 0.
class SwingingMass {
 public:
  /// @param frequency  undamped [Hz], above 0  @param damping  as a share of the critical one
  SwingingMass(double frequency, double damping, double foot);
  /// Moves the foot in a straight line for `step` [s]. @return where the mass is then
  double move(double foot, double step);

 private:
  double frequency_, damping_;  // [rad/s]
  double foot_, place_, speed_ = 0;
};

struct AxisFlaws {
  double lash = 0;       ///< of the gear, whole width [rad]
  double play = 0;       ///< of the bearing: tilts about the next axis within this, whole width [rad]
  double frequency = 0;  ///< of the structure [Hz]; 0: stiff
  double damping = 0.05;
};

/// One axis of the gimbal, the outermost first.
struct GimbalPart {
  MotionAxis motion;
  int turns_about = 2;  ///< rig axis, 0 to 2
  AxisFlaws flaws;
};

struct GimbalAngles {
  std::array<double, 3> commanded{};  ///< by the trajectory [rad]
  std::array<double, 3> real{};       ///< [rad]
  std::array<double, 3> tilt{};       ///< of each bearing [rad]
};

/// A run of the gimbal from rest, worked out at its beats.
class GimbalRun {
 public:
  static constexpr double kBeat = 0.005;  ///< of the servo commands [s]

  /// @param parts     one to three axes
  /// @param duration  [s]; afterwards everything rests where it is
  GimbalRun(std::vector<GimbalPart> parts, double duration);

  const std::vector<GimbalPart>& parts() const { return parts_; }
  /// @param time  [s] of the trajectories; between beats by straight lines
  GimbalAngles at(double time) const;
  /// home_from_rig, home being where all angles are zero.
  Eigen::Quaterniond turn(const GimbalAngles& angles) const;
  Eigen::Quaterniond turn_at(double time) const { return turn(at(time)); }

 private:
  std::vector<GimbalPart> parts_;
  std::vector<GimbalAngles> beats_;
};

}  // namespace omma::sim
