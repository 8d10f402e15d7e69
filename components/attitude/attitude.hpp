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
#include "fsw/services/parameter_input.hpp"

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

inline constexpr ParameterDescriptor kAttitudeAccelerationDensity{
    .id = 45,
    .name = "attitude.acceleration_density",
    .text = "white angular acceleration that nothing measures, density of each axis",
    .value = {.name = "value", .unit = "rad/s1.5", .least = 1e-9, .most = 100}};
inline constexpr ParameterDescriptor kAttitudeLeastPairs{
    .id = 46,
    .name = "attitude.least_pairs",
    .text = "fewer pairs after the cull give no attitude",
    .value = {.name = "value", .type = ValueType::kInteger, .least = 3, .most = 100}};

inline constexpr std::array kAttitudeParameters{kAttitudeAccelerationDensity, kAttitudeLeastPairs};

template <class Visit>
void visit_parameters(AttitudeParameters& p, Visit&& visit) {
  visit(kAttitudeAccelerationDensity, p.mekf.acceleration_density);
  visit(kAttitudeLeastPairs, p.least_pairs);
}

class Attitude final : public Component {
 public:
  explicit Attitude(const AttitudeParameters& parameters)
      : parameters_(parameters), filter_(parameters.mekf) {}

  In<Pairings> pairings;
  In<RateMeasurements> rates;  ///< bound where the filter uses a gyro
  ParameterInput tuning;
  Out<AttitudeEstimate> estimate;

  std::string_view name() const override { return "attitude"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  void skipped(const Tick& tick) noexcept override;

 private:
  void withdraw() noexcept;
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
