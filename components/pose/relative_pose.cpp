#include "components/pose/relative_pose.hpp"

namespace omma {

void RelativePose::visit_ports(PortVisitor& visitor) const {
  visitor.input("pairings", pairings);
  visitor.output("estimates", estimates);
}

void RelativePose::step(const Tick& /*tick*/) noexcept {
  estimates->bodies.resize(pairings->bodies.size());
  for (std::size_t b = 0; b < pairings->bodies.size(); ++b) {
    solve_body(pairings->bodies[b], estimates->bodies[b]);
    check_body(pairings->bodies[b], estimates->bodies[b]);
    refer_to_first(estimates->bodies[b]);
  }
}

void RelativePose::skipped(const Tick& /*tick*/) noexcept {
  estimates->bodies.resize(pairings->bodies.size());
  for (std::size_t b = 0; b < pairings->bodies.size(); ++b)
    withdraw(pairings->bodies[b], estimates->bodies[b]);
}

// Until it is solved this frame set has no pose of the body.
void RelativePose::withdraw(const BodyPairings& body, PoseEstimate& out) noexcept {
  out.frame = pairings->frame;
  out.time_ns = pairings->time_ns;
  out.body = body.body;
  out.valid = false;
  out.solution = {};
  out.motion = {};
  out.used.clear();
  out.used.resize(body.pairs.size());
}

void RelativePose::solve_body(const BodyPairings& body, PoseEstimate& out) noexcept {
  withdraw(body, out);
  if (body.state == TrackState::kLost) return;

  sights_.clear();
  for (const Pairing& pairing : body.pairs) sights_.push_back(pairing.sight);
  // The dots of each frame set decide alone between the two minima of a flat card: trust in the pose before
  // would confirm its mistakes.
  out.solution =
      solve_pose(sights_, body.rig_from_body, parameters_.solve, {out.used.data(), out.used.size()});
  out.valid =
      (out.solution.status == SolveStatus::kSolved || out.solution.status == SolveStatus::kIterationCap) &&
      out.solution.pairs >= parameters_.least_pairs;
  if (!out.valid) return;
  Eigen::Quaterniond& q = out.solution.rig_from_body.rotation;
  if (has_last_[body.body] && q.dot(last_[body.body]) < 0) q.coeffs() = -q.coeffs();
  has_last_[body.body] = true;
  last_[body.body] = q;
}

void RelativePose::check_body(const BodyPairings& body, PoseEstimate& out) noexcept {
  out.integrity = {};
  const bool enough = out.solution.pairs >= parameters_.least_pairs;
  out.position_valid = out.valid || (enough && out.solution.status == SolveStatus::kUnobservable &&
                                     out.solution.position_observable);
  out.rotation_valid = out.valid && out.solution.rotation_observable;
  if (!out.position_valid) return;
  sources_.clear();
  for (const Pairing& pairing : body.pairs) sources_.push_back({pairing.camera, pairing.entry});
  out.integrity =
      pose_integrity(sights_, sources_, out.used, out.solution, parameters_.axes, parameters_.integrity);
}

// What calibration does to both poses cancels only as far as it does so alike: it is worked out anew.
void RelativePose::refer_to_first(PoseEstimate& out) noexcept {
  std::optional<SeenPose>& first = first_[out.body];
  if (!out.valid || !out.rotation_valid || (!first && !may_be_first(out))) return;
  const SeenPose now = seen_pose(out, sights_, sources_, parameters_.integrity.calibration, parameters_.axes);
  if (!first) first = now;
  out.motion = motion_between(*first, now);
}

}  // namespace omma
