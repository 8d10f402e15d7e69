// Attitude: star pairings → rig_from_j2000 with covariance, by the one weighted least-squares solver; with a
// filter, attitude and rate over the frame sets beside it. The tracker goes on from the single frame set's
// attitude, filter or not.
#pragma once

#include "components/attitude/attitude_estimate.hpp"
#include "components/attitude/rate_measurements.hpp"
#include "components/estimation/attitude_filter.hpp"
#include "components/estimation/integrity.hpp"
#include "components/estimation/least_squares.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

enum class AttitudeFilterKind : std::uint8_t {
  kNone,
  kMekf,  ///< multiplicative extended Kalman filter
};

struct AttitudeParameters {
  SolveOptions solve;
  AttitudeFilterKind filter = AttitudeFilterKind::kNone;
  AttitudeFilterParameters mekf;
  IntegrityOptions integrity;
  CameraAxes axes = camera_axes(Rig{});
  int least_pairs = 4;  ///< fewer pairs after the cull give no attitude
};

class Attitude final : public Component {
 public:
  explicit Attitude(const AttitudeParameters& parameters)
      : parameters_(parameters), filter_(parameters.mekf) {}

  In<Pairings> pairings;
  In<RateMeasurements> rates;  ///< bound where the filter uses a gyro
  Out<AttitudeEstimate> estimate;

  std::string_view name() const override { return "attitude"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  void solve_frame_set() noexcept;
  void check_frame_set() noexcept;
  void filter_frame_set() noexcept;
  void predict_to(TimeNs time_ns) noexcept;
  bool uses_gyro() const { return parameters_.filter == AttitudeFilterKind::kMekf && parameters_.mekf.gyro; }

  AttitudeParameters parameters_;
  AttitudeFilter filter_;
  TimeNs filter_time_ns_ = 0;
  Eigen::Matrix3d last_covariance_ = Eigen::Matrix3d::Zero();
  /// What calibration adds to the covariance, of the last attitude: a filter does not average it away.
  Eigen::Matrix3d calibration_ = Eigen::Matrix3d::Zero();
  StaticVector<Sight, limits::kStarPairs> sights_;
  StaticVector<SightSource, limits::kStarPairs> sources_;
  bool has_last_ = false;
  TimeNs last_time_ns_ = 0;
  Eigen::Quaterniond last_ = Eigen::Quaterniond::Identity();
};

}  // namespace omma
