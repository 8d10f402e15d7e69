// Integrity of a solution: do the residuals look like noise, what would the answer be without any one dot or
// any one camera, how far may it be off at a stated risk, and what do calibration and survey add to its
// covariance. Everything is of the solution's own normal equations: a dot is left out by a rank-two downdate.
// Sources: Blanch et al. 2015 (solution separation), Joerger et al. 2014; Schmidt 1966, Bierman 1977
// (consider terms). Formulas and verification: docs/algorithms/integrity.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "components/estimation/calibration_error.hpp"
#include "components/estimation/sight.hpp"
#include "components/estimation/solution.hpp"
#include "components/estimation/weakest_direction.hpp"

namespace omma {

struct IntegrityOptions {
  /// Probability, per frame set and axis, that an error is beyond its protection level.
  double risk = 1e-5;
  double dot_fault = 1e-4;     ///< probability that a dot left after the cull is paired wrongly
  double camera_fault = 1e-5;  ///< probability that a camera is wrong by more than its calibration says
  double false_alarm = 1e-6;   ///< of each of the three tests, per frame set
  CalibrationError calibration;
};

enum class IntegrityState : std::uint8_t {
  kNone,       ///< there is no solution
  kSound,      ///< all tests passed
  kUnchecked,  ///< nothing is left over to test with: no protection level
  kAlert,      ///< residuals, a dot or a camera contradict the others
};

/// Rotations come first, then positions (zero for an attitude). `rig`: (δθ, δt) as in the solution; `body`:
/// the same rotation in body (attitude: J2000) axes, and the position of the rig's origin in the body frame.
struct ErrorBounds {
  Matrix6d covariance = Matrix6d::Zero();        ///< noise and calibration
  Vector6d protection_level = Vector6d::Zero();  ///< infinite where there is none
};

struct Integrity {
  IntegrityState state = IntegrityState::kNone;
  double risk = 0;  ///< of the protection levels
  std::uint16_t freedom = 0;
  double chi2_probability = 1;  ///< that noise makes a χ² as large
  /// The dot that the others contradict most, in σ of the difference (two axes together).
  SightSource suspect_dot;
  double suspect_dot_sigma = 0;
  /// The camera that the others contradict most, and the probability that noise does so.
  std::uint8_t suspect_camera = 0;
  double suspect_camera_probability = 1;
  bool cameras_checked = false;  ///< each camera that took part can be left out
  /// Largest move of the solution when one is left out [rad, m].
  double dot_separation_rad = 0, dot_separation_m = 0;
  double camera_separation_rad = 0, camera_separation_m = 0;
  WeakestDirection weakest_rotation;  ///< rig frame, calibration included [rad]
  WeakestDirection weakest_position;  ///< the same [m]
  ErrorBounds rig, body;
};

/// @param sights   those of the solve; `sources` as long
/// @param used     as the solver left it: 1 where the sight is in the solution
/// @param axes     of the rig's cameras
Integrity attitude_integrity(std::span<const Sight> sights, std::span<const SightSource> sources,
                             std::span<const std::uint8_t> used, const AttitudeSolution& solution,
                             const CameraAxes& axes, const IntegrityOptions& options) noexcept;

/// An ambiguous pose's protection level reaches to the alternative; where that is a whole valley there is
/// none.
Integrity pose_integrity(std::span<const Sight> sights, std::span<const SightSource> sources,
                         std::span<const std::uint8_t> used, const PoseSolution& solution,
                         const CameraAxes& axes, const IntegrityOptions& options) noexcept;

}  // namespace omma
