#include "components/attitude/attitude.hpp"

namespace omma {

void Attitude::visit_ports(PortVisitor& visitor) const {
  visitor.input("pairings", pairings);
  visitor.output("estimate", estimate);
}

void Attitude::step(const Tick& /*tick*/) noexcept {
  AttitudeEstimate& out = *estimate;
  const SkyPairings& sky = pairings->sky;
  out.frame = pairings->frame;
  out.time_ns = pairings->time_ns;
  out.valid = false;
  out.rate_valid = false;
  out.solution = {};
  out.used.clear();
  out.used.resize(sky.pairs.size());
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
    // A star turns against the rig: R(t + dt) = exp(−[ω]× dt) R(t).
    const double dt = 1e-9 * static_cast<double>(out.time_ns - last_time_ns_);
    out.rate = -rotation_log(q * last_.conjugate()) / dt;
    out.rate_valid = true;
  }
  has_last_ = true;
  last_ = q;
  last_time_ns_ = out.time_ns;
}

}  // namespace omma
