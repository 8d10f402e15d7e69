#include "components/tracker/tracker.hpp"

#include <algorithm>
#include <cmath>

namespace omma {

Tracker::Tracker(const TrackerParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
                 std::span<const TargetBody> bodies, std::span<const PixelMask> masks)
    : parameters_(parameters),
      rig_(rig),
      catalogue_(catalogue),
      star_identification_(catalogue, sky_coverage(rig, masks)),
      sky_prediction_(parameters.sky_angular_acceleration) {
  bodies_.reserve(bodies.size());
  for (const TargetBody& body : bodies) {
    bodies_.push_back(
        {&body,
         TargetIdentifier(body),
         PosePrediction(parameters.body_angular_acceleration, parameters.body_linear_acceleration),
         {}});
  }
  pairings->bodies.resize(bodies_.size());
}

void Tracker::visit_ports(PortVisitor& visitor) const {
  visitor.input("dots", dots);
  visitor.input("attitude", attitude);
  visitor.input("poses", poses);
  visitor.output("pairings", pairings);
}

void Tracker::step(const Tick& /*tick*/) noexcept {
  learn();
  Pairings& out = *pairings;
  frame_interval_ns_ = out.time_ns > 0 ? dots->time_ns - out.time_ns : 0;
  out.frame = dots->frame;
  out.time_ns = dots->time_ns;
  seen_.build(*dots, rig_, parameters_.floor_px);

  // Tracked bodies first: where one stands no star is to be looked for.
  std::array<HiddenCone, std::size_t{limits::kCameras} * limits::kTargetBodies> cones;
  std::size_t cone_count = 0;
  track_bodies(cones, cone_count);
  const std::span<const HiddenCone> hidden(cones.data(), cone_count);
  track_sky(hidden);
  if (out.sky.state == TrackState::kLost) acquire_sky(hidden);
  // A body's targets outshine the stars: once they are claimed the sky may be found among the rest.
  if (acquire_bodies() > 0 && out.sky.state == TrackState::kLost) acquire_sky(hidden);
  count_persistence();
  count_unclaimed();
}

void Tracker::learn() noexcept {
  if (attitude->valid) {
    sky_prediction_.update(attitude->time_ns, attitude->solution.rig_from_j2000,
                           attitude->solution.covariance);
  }
  for (const PoseEstimate& pose : poses->bodies) {
    if (pose.valid && pose.body < bodies_.size()) {
      bodies_[pose.body].prediction.update(pose.time_ns, pose.solution.rig_from_body,
                                           pose.solution.covariance);
    }
  }
}

// A prediction is trusted for a few frame sets after the last estimate it was made of.
bool Tracker::predictable(bool ready, TimeNs last_time_ns) const noexcept {
  return ready && dots->time_ns - last_time_ns <= (parameters_.patience + 1) * frame_interval_ns_;
}

void Tracker::track_bodies(std::span<HiddenCone> cones, std::size_t& cone_count) noexcept {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    TrackedBody& tracked = bodies_[b];
    BodyPairings& out = pairings->bodies[b];
    out.state = TrackState::kLost;
    out.body = static_cast<std::uint8_t>(b);
    out.pairs.clear();
    if (!predictable(tracked.prediction.ready(), tracked.prediction.last_time_ns())) continue;
    const PredictedPose prediction = tracked.prediction.at(dots->time_ns);
    body_pairing_.pair(seen_, rig_, *tracked.body, prediction, parameters_.gate, out.pairs);
    if (!beyond_chance(out.pairs.size(), body_pairing_.chance(), parameters_.least_target_pairs)) {
      for (const Pairing& pair : out.pairs) seen_.claimed(pair.camera)[pair.dot] = 0;
      out.pairs.clear();
      tracked.prediction.reset();
      continue;
    }
    out.state = TrackState::kTracking;
    out.rig_from_body = prediction.rig_from_body;
    cone_count += hidden_cones(rig_, *tracked.body, prediction.rig_from_body, cones.subspan(cone_count));
  }
}

void Tracker::track_sky(std::span<const HiddenCone> cones) noexcept {
  SkyPairings& sky = pairings->sky;
  sky.state = TrackState::kLost;
  sky.pairs.clear();
  if (!predictable(sky_prediction_.ready(), sky_prediction_.last_time_ns())) return;
  const PredictedAttitude prediction = sky_prediction_.at(dots->time_ns);
  sky_pairing_.pair(seen_, rig_, catalogue_.stars(), prediction, parameters_.faintest_star, parameters_.gate,
                    cones, sky.pairs);
  if (!beyond_chance(sky.pairs.size(), sky_pairing_.chance(), parameters_.least_star_pairs)) {
    for (const Pairing& pair : sky.pairs) seen_.claimed(pair.camera)[pair.dot] = 0;
    sky.pairs.clear();
    sky_prediction_.reset();
    return;
  }
  sky.state = TrackState::kTracking;
  sky.rig_from_j2000 = prediction.rig_from_j2000;
}

void Tracker::acquire_sky(std::span<const HiddenCone> cones) noexcept {
  const std::size_t count = seen_.unclaimed(unclaimed_);
  star_identification_.identify({unclaimed_.data(), count}, identification_);
  if (identification_.status != IdentificationStatus::kIdentified) return;
  // The identified attitude predicts all the other stars, as a tracked one would.
  SkyPairings& sky = pairings->sky;
  const PredictedAttitude found{identification_.rig_from_j2000, identification_.covariance};
  sky_pairing_.pair(seen_, rig_, catalogue_.stars(), found, parameters_.faintest_star, parameters_.gate,
                    cones, sky.pairs);
  sky.state = TrackState::kAcquired;
  sky.rig_from_j2000 = found.rig_from_j2000;
}

int Tracker::acquire_bodies() noexcept {
  int acquired = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    BodyPairings& out = pairings->bodies[b];
    if (out.state != TrackState::kLost) continue;
    acquire_body(bodies_[b], out);
    acquired += out.state == TrackState::kAcquired ? 1 : 0;
  }
  return acquired;
}

void Tracker::acquire_body(TrackedBody& tracked, BodyPairings& out) noexcept {
  const std::size_t count = seen_.unclaimed(unclaimed_);
  const TargetIdentification found = tracked.identifier.identify({unclaimed_.data(), count});
  if (found.status != TargetIdentificationStatus::kIdentified) return;
  for (const TargetPair& pair : found.pairs) {
    const RigDot& dot = unclaimed_[pair.dot];
    Pairing pairing;
    pairing.sight = SeenDots::sight(dot, tracked.body->targets[pair.target].position);
    pairing.camera = dot.camera;
    pairing.dot = dot.index;
    pairing.entry = pair.target;
    if (!out.pairs.push_back(pairing)) break;
    seen_.claimed(dot.camera)[dot.index] = 1;
  }
  out.state = TrackState::kAcquired;
  out.rig_from_body = found.pose.rig_from_body;
}

void Tracker::count_persistence() noexcept {
  star_persistence_now_.fill(0);
  for (Pairing& pair : pairings->sky.pairs) {
    pair.persistence = star_persistence_[pair.entry] + 1;
    star_persistence_now_[pair.entry] = pair.persistence;
  }
  std::swap(star_persistence_, star_persistence_now_);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    std::array<std::uint32_t, limits::kTargetsPerBody> now{};
    for (Pairing& pair : pairings->bodies[b].pairs) {
      pair.persistence = bodies_[b].persistence[pair.entry] + 1;
      now[pair.entry] = pair.persistence;
    }
    bodies_[b].persistence = now;
  }
}

void Tracker::count_unclaimed() noexcept {
  pairings->unclaimed_dots = 0;
  for (std::size_t c = 0; c < seen_.cameras(); ++c) {
    for (const std::uint8_t claimed : seen_.claimed(c)) pairings->unclaimed_dots += claimed == 0 ? 1U : 0U;
  }
}

}  // namespace omma
