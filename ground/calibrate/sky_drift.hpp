// Drift of lenses and of the cameras' turns on the rig, from the stars of a flight: one adjustment of all of
// it gives the mean, one a window of time gives each camera's centre, focal length and turn then, and a
// straight line through the windows, weighted by their whole covariances, gives the rates with theirs.
// docs/calibrate.md.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ground/calibrate/flight_sights.hpp"
#include "ground/calibrate/sky_calibration.hpp"

namespace omma::ground {

/// Numbers of a rig that may drift, in the order: of each camera centre u, v [px] and the focal length's part
/// [1]; of each camera but the first its turn on the rig about x, y, z (camera frame) [rad].
struct DriftLayout {
  std::size_t cameras = 0;
  Eigen::Index size() const { return static_cast<Eigen::Index>(6 * cameras - 3); }
  static Eigen::Index lens_at(std::size_t camera) { return static_cast<Eigen::Index>(3 * camera); }
  /// @param camera  from 1 on
  Eigen::Index turn_at(std::size_t camera) const {
    return static_cast<Eigen::Index>(3 * cameras + 3 * (camera - 1));
  }
};

struct DriftWindow {
  double time = 0;       ///< mean of its frame sets [s]
  std::size_t sets = 0;  ///< used
  std::size_t stars = 0;
  /// Everything adjusted, less the mean rig: what may drift, in the order of DriftLayout, then the other
  /// numbers of the lenses, which do not.
  Eigen::VectorXd numbers;
  Eigen::MatrixXd numbers_covariance;
  /// What may drift, the other numbers being those of all windows together.
  Eigen::VectorXd offset;
  Eigen::MatrixXd covariance;
};

struct SkyDrift {
  bool done = false;
  std::string reason;  ///< why not, in a sentence
  DriftLayout layout;
  SkyCalibration mean;  ///< of all the time, at the model asked for
  std::vector<DriftWindow> windows;
  double middle = 0;           ///< time at which the line's offset is told [s]
  Eigen::VectorXd offset;      ///< of the line there
  Eigen::VectorXd rate;        ///< [1/s]
  Eigen::MatrixXd covariance;  ///< of offset and rate, one below the other
  double scatter = 1;          ///< chi-square per degree of freedom of the windows about the line
  int degrees = 0;             ///< of freedom of it; 0: two windows, the line goes through both

  double rate_sigma(Eigen::Index k) const { return std::sqrt(covariance(rate.size() + k, rate.size() + k)); }
  /// Squared rates of three numbers from `at` on in their deviations: chi-square of 3 where nothing drifts.
  double squared_in_sigmas_of(Eigen::Index at) const;
};

/// Chi-square of 3 degrees above which a drift is said to be seen: once in a thousand times by chance.
inline constexpr double kSeenDrift = 16.27;

struct DriftOptions {
  LensModel model = LensModel::kOcam;  ///< of the mean
  double max_angle = 3.0;              ///< largest angle off axis that the lenses see [rad]
  std::size_t windows = 10;            ///< of each recording
  std::size_t window_sets = 24;        ///< frame sets of a window that are used, evenly taken
  std::size_t mean_sets = 60;          ///< of each recording for the mean
};

/// @param recordings  frame sets of each recording, in the order of time
SkyDrift drift_from_flight(const Rig& rig, const std::vector<std::vector<FlightSet>>& recordings,
                           const DriftOptions& options);

/// The straight lines through the windows' numbers, weighted by their covariances; where they scatter more
/// about them than these say, the result is scaled up. Fills offset, rate, covariance, scatter, degrees, and
/// the windows' offsets with their covariances.
/// @return false where the windows are fewer than two or at one time
bool fit_line(SkyDrift& drift);

}  // namespace omma::ground
