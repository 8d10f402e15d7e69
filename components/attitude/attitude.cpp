#include "components/attitude/attitude.hpp"

#include <algorithm>

#include "components/estimation/mean_rate.hpp"

namespace omma {
namespace {

double seconds(TimeNs interval_ns) {
  return 1e-9 * static_cast<double>(interval_ns);
}

}  // namespace

void Attitude::visit_ports(PortVisitor& visitor) const {
  visitor.input("pairings", pairings);
  if (uses_gyro()) visitor.input("rates", rates);
  if (tuning.bound()) visitor.input("tuning", tuning.port());
  visitor.output("estimate", estimate);
}

void Attitude::step(const Tick& /*tick*/) noexcept {
  if (tuning.has_news()) {
    take_parameters(*tuning, parameters_);
    filter_.set_acceleration_density(parameters_.mekf.acceleration_density);
  }
  solve_frame_set();
  check_frame_set();
  if (parameters_.filter == AttitudeFilterKind::kMekf) filter_frame_set();
}

void Attitude::skipped(const Tick& /*tick*/) noexcept {
  withdraw();
  estimate->filtered.valid = false;
}

// Until it is solved this frame set has no attitude.
void Attitude::withdraw() noexcept {
  AttitudeEstimate& out = *estimate;
  out.frame = pairings->frame;
  out.time_ns = pairings->time_ns;
  out.valid = false;
  out.rate_valid = false;
  out.solution = {};
  out.used.clear();
  out.used.resize(pairings->sky.pairs.size());
}

void Attitude::solve_frame_set() noexcept {
  withdraw();
  AttitudeEstimate& out = *estimate;
  const SkyPairings& sky = pairings->sky;
  if (sky.state == TrackState::kLost) return;

  sights_.clear();
  for (const Pairing& pairing : sky.pairs) sights_.push_back(pairing.sight);
  out.solution =
      solve_attitude(sights_, sky.rig_from_j2000, parameters_.solve, {out.used.data(), out.used.size()});
  out.valid =
      (out.solution.status == SolveStatus::kSolved || out.solution.status == SolveStatus::kIterationCap) &&
      out.solution.pairs >= parameters_.least_pairs;
  if (!out.valid) return;

  // q and −q are one attitude; keep the sign that continues the last one.
  Eigen::Quaterniond& q = out.solution.rig_from_j2000;
  if (has_last_ && q.dot(last_) < 0) q.coeffs() = -q.coeffs();
  if (has_last_ && out.time_ns > last_time_ns_) {
    const MeanRate mean =
        mean_rate(last_, last_covariance_, q, out.solution.covariance, seconds(out.time_ns - last_time_ns_));
    out.rate = mean.rate;
    out.rate_covariance = mean.covariance;
    out.rate_valid = true;
  }
  has_last_ = true;
  last_ = q;
  last_covariance_ = out.solution.covariance;
  last_time_ns_ = out.time_ns;
}

void Attitude::check_frame_set() noexcept {
  AttitudeEstimate& out = *estimate;
  out.integrity = {};
  if (!out.valid) return;
  sources_.clear();
  for (const Pairing& pairing : pairings->sky.pairs) sources_.push_back({pairing.camera, pairing.entry});
  out.integrity =
      attitude_integrity(sights_, sources_, out.used, out.solution, parameters_.axes, parameters_.integrity);
  if (parameters_.integrity.calibration.any())
    calibration_ = out.integrity.rig.covariance.topLeftCorner<3, 3>() - out.solution.covariance;
}

void Attitude::filter_frame_set() noexcept {
  AttitudeEstimate& out = *estimate;
  predict_to(out.time_ns);
  out.filtered.innovation_chi2 = 0;
  if (out.valid) {
    const FilterUpdate update = filter_.update(out.solution.rig_from_j2000, out.solution.covariance);
    if (update != FilterUpdate::kStarted) out.filtered.innovation_chi2 = filter_.innovation_chi2();
  }
  out.filtered.valid = filter_.valid();
  out.filtered.rig_from_j2000 = filter_.rig_from_j2000();
  out.filtered.covariance = filter_.attitude_covariance() + calibration_;
  out.filtered.rate = filter_.rate();
  out.filtered.rate_covariance = filter_.rate_covariance();
  out.filtered.gyro_bias = filter_.gyro_bias();
}

// By the gyro where it measured, by the rate as it was where it did not.
void Attitude::predict_to(TimeNs time_ns) noexcept {
  if (uses_gyro()) {
    for (const RateMeasurement& measured : rates->intervals) {
      const TimeNs from = std::max(measured.from_ns, filter_time_ns_);
      const TimeNs to = std::min(measured.to_ns, time_ns);
      if (to <= from) continue;
      filter_.predict(seconds(from - filter_time_ns_));
      filter_.predict(seconds(to - from), measured.rate);
      filter_time_ns_ = to;
    }
  }
  filter_.predict(seconds(time_ns - filter_time_ns_));
  filter_time_ns_ = std::max(filter_time_ns_, time_ns);
}

}  // namespace omma
