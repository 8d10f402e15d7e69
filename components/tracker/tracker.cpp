#include "components/tracker/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "components/estimation/covariance.hpp"

namespace omma {

Tracker::Tracker(const TrackerParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
                 std::span<const TargetBody> bodies, std::span<const PixelMask> masks)
    : parameters_(parameters),
      rig_(rig),
      catalogue_(catalogue),
      star_identification_(catalogue, sky_coverage(rig, masks)),
      sky_prediction_(parameters.sky_angular_acceleration),
      lost_sky_(parameters.sky_angular_acceleration) {
  bodies_.reserve(bodies.size());
  for (const TargetBody& body : bodies) {
    bodies_.push_back(
        {&body,
         TargetIdentifier(body),
         PosePrediction(parameters.body_angular_acceleration, parameters.body_linear_acceleration),
         blinks(body) ? std::make_unique<BlinkingBody>(body) : nullptr,
         {}});
  }
  pairings->bodies.resize(bodies_.size());
}

void Tracker::visit_ports(PortVisitor& visitor) const {
  visitor.input("dots", dots);
  visitor.input("attitude", attitude);
  visitor.input("poses", poses);
  if (tuning.bound()) visitor.input("tuning", tuning.port());
  visitor.output("pairings", pairings);
}

void Tracker::step(const Tick& /*tick*/) noexcept {
  ++steps_;
  if (tuning.has_news()) take_news();
  learn();
  if (forget_) forget();
  Pairings& out = *pairings;
  frame_interval_ns_ = out.time_ns > 0 ? dots->time_ns - out.time_ns : 0;
  out.frame = dots->frame;
  out.time_ns = dots->time_ns;
  seen_.build(*dots, rig_, parameters_.floor_px);
  place_solar_system();

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

void Tracker::take_news() noexcept {
  take_parameters(*tuning, parameters_);
  sky_prediction_.set_acceleration(parameters_.sky_angular_acceleration);
  lost_sky_.set_acceleration(parameters_.sky_angular_acceleration);
  for (TrackedBody& tracked : bodies_)
    tracked.prediction.set_accelerations(parameters_.body_angular_acceleration,
                                         parameters_.body_linear_acceleration);
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

void Tracker::forget() noexcept {
  sky_prediction_.reset();
  lost_sky_.reset();
  for (TrackedBody& tracked : bodies_) tracked.prediction.reset();
  forget_ = false;
}

void Tracker::skipped(const Tick& /*tick*/) noexcept {
  Pairings& out = *pairings;
  out.frame = dots->frame;
  out.time_ns = dots->time_ns;
  out.sky.state = TrackState::kLost;
  out.sky.pairs.clear();
  for (std::size_t b = 0; b < out.bodies.size(); ++b) {
    out.bodies[b].state = TrackState::kLost;
    out.bodies[b].body = static_cast<std::uint8_t>(b);
    out.bodies[b].pairs.clear();
  }
  out.unclaimed_dots = 0;
}

CommandOutcome Tracker::receive(const Command& /*command*/, const Tick& /*tick*/) noexcept {
  forget_ = true;  // in its own step, after the last estimates were learnt from
  return CommandOutcome::done();
}

// A prediction is trusted for a few frame sets after the last estimate it was made of.
bool Tracker::predictable(bool ready, TimeNs last_time_ns) const noexcept {
  return ready && dots->time_ns - last_time_ns <= (parameters_.patience + 1) * frame_interval_ns_;
}

// Once a second is enough: the Moon goes 0.6" in that time, and 5" of aberration turn by 0.06 degrees in a
// low orbit. The first frame set is of the mission's epoch.
void Tracker::place_solar_system() noexcept {
  constexpr TimeNs kRefreshNs = 1'000'000'000;
  if (!parameters_.observer.julian_date_utc) return;
  if (!first_time_ns_) {
    first_time_ns_ = dots->time_ns;
    sky_pairing_.look_for(solar_system_);
  } else if (dots->time_ns - solar_system_time_ns_ < kRefreshNs) {
    return;
  }
  Observer now = parameters_.observer;
  const double seconds = 1e-9 * static_cast<double>(dots->time_ns - *first_time_ns_);
  *now.julian_date_utc += seconds / 86400;
  std::optional<Eigen::Vector3d> position;
  if (parameters_.orbit) {
    const OrbitState state = parameters_.orbit->at(seconds);
    now.velocity = state.velocity;
    position = state.position;
  }
  solar_system_ = solar_system(now, parameters_.observer_sigma, position);
  solar_system_time_ns_ = dots->time_ns;
  if (!parameters_.orbit && !now.site) return;
  std::optional<ApparentPlace>& from_here = pairings->sky.from_here;
  sky_pairing_.look_from(&from_here.emplace(now));
}

void Tracker::claim_nothing(std::span<const Pairing> pairs) noexcept {
  for (const Pairing& pair : pairs) seen_.claimed(pair.camera)[pair.dot] = 0;
}

// All bodies that are predicted compete for the dots. One that turns out to be lost is to leave no dot
// unclaimed that another body wanted as well: then the rest is paired again.
bool Tracker::pair_bodies(std::size_t count) noexcept {
  const std::span<BodyPrediction> wanted(predictions_.data(), count);
  body_pairing_.pair(seen_, rig_, wanted, parameters_.gate);
  bool all_there = true;
  for (const BodyPrediction& prediction : wanted)
    all_there = all_there &&
                beyond_chance(prediction.pairs->size(), prediction.chance, parameters_.least_target_pairs);
  return all_there;
}

void Tracker::track_bodies(std::span<HiddenCone> cones, std::size_t& cone_count) noexcept {
  std::size_t count = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    TrackedBody& tracked = bodies_[b];
    BodyPairings& out = pairings->bodies[b];
    out.state = TrackState::kLost;
    out.body = static_cast<std::uint8_t>(b);
    out.pairs.clear();
    if (predictable(tracked.prediction.ready(), tracked.prediction.last_time_ns()))
      predictions_[count++] = {tracked.body, tracked.prediction.at(dots->time_ns), &out.pairs};
  }
  while (count > 0 && !pair_bodies(count)) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      BodyPrediction& prediction = predictions_[i];
      const bool there =
          beyond_chance(prediction.pairs->size(), prediction.chance, parameters_.least_target_pairs);
      claim_nothing(*prediction.pairs);
      prediction.pairs->clear();
      if (there) {
        predictions_[kept++] = prediction;
        continue;
      }
      for (TrackedBody& tracked : bodies_)
        if (tracked.body == prediction.body) tracked.prediction.reset();
    }
    count = kept;
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const BodyPrediction* found =
        std::find_if(predictions_.data(), predictions_.data() + count,
                     [&](const BodyPrediction& prediction) { return prediction.body == bodies_[b].body; });
    if (found == predictions_.data() + count) continue;
    BodyPairings& out = pairings->bodies[b];
    out.state = TrackState::kTracking;
    out.rig_from_body = found->pose.rig_from_body;
    cone_count += hidden_cones(rig_, *bodies_[b].body, out.rig_from_body, cones.subspan(cone_count));
  }
}

void Tracker::track_sky(std::span<const HiddenCone> cones) noexcept {
  SkyPairings& sky = pairings->sky;
  sky.state = TrackState::kLost;
  sky.pairs.clear();
  sky.solar.clear();
  if (!predictable(sky_prediction_.ready(), sky_prediction_.last_time_ns())) return;
  const PredictedAttitude prediction = sky_prediction_.at(dots->time_ns);
  sky_pairing_.pair(seen_, rig_, catalogue_.stars(), prediction, parameters_.faintest_star, parameters_.gate,
                    cones, sky.pairs);
  if (!beyond_chance(sky.pairs.size(), sky_pairing_.chance(), parameters_.least_star_pairs)) {
    claim_nothing(sky.pairs);
    claim_nothing(sky_pairing_.solar_pairs());
    sky.pairs.clear();
    lost_sky_ = sky_prediction_;
    sky_prediction_.reset();
    return;
  }
  for (const Pairing& pair : sky_pairing_.solar_pairs()) sky.solar.push_back(pair);
  sky.state = TrackState::kTracking;
  sky.rig_from_j2000 = prediction.rig_from_j2000;
}

void Tracker::acquire_sky(std::span<const HiddenCone> cones) noexcept {
  const std::span<const RigDot> rays(unclaimed_.data(), seen_.unclaimed(unclaimed_));
  if (!recall_sky(rays)) {
    ++searches_of_the_whole_sky_;
    star_identification_.identify(rays, identification_);
    if (identification_.status != IdentificationStatus::kIdentified) return;
    if (!continues(identification_.rig_from_j2000)) lost_sky_.reset();
  }
  // Known too badly to pair its stars, and yet where it was expected: the rate still holds.
  if (!sky_prediction_.ready() && lost_sky_.ready()) sky_prediction_ = lost_sky_;
  // The identified attitude predicts all the other stars, as a tracked one would.
  SkyPairings& sky = pairings->sky;
  const PredictedAttitude found{identification_.rig_from_j2000, identification_.covariance};
  sky_pairing_.pair(seen_, rig_, catalogue_.stars(), found, parameters_.faintest_star, parameters_.gate,
                    cones, sky.pairs);
  for (const Pairing& pair : sky_pairing_.solar_pairs()) sky.solar.push_back(pair);
  sky.state = TrackState::kAcquired;
  sky.rig_from_j2000 = found.rig_from_j2000;
}

// How far the attitude may be from where it is expected, by what is assumed of the rig [rad].
double Tracker::farthest_expected(const PredictedAttitude& expected) noexcept {
  constexpr double kSigmas = 5;
  constexpr double kUnforeseen = 0.02;  // [rad] beside what the prediction knows of
  return kUnforeseen + kSigmas * largest_sigma(expected.covariance);
}

bool Tracker::continues(const Eigen::Quaterniond& rig_from_j2000) const noexcept {
  constexpr double kJump = 1.0;  // [rad]
  if (!lost_sky_.ready()) return false;
  const PredictedAttitude expected = lost_sky_.at(dots->time_ns);
  return expected.rig_from_j2000.angularDistance(rig_from_j2000) <
         std::min(farthest_expected(expected), kJump);
}

// The sky is looked for where the last attitudes expect it, as long as that says anything: fewer stars prove
// an attitude that is expected. Where the rig was seen to accelerate less than it may, nearer. A wrong
// expectation costs the aided search and nothing else: what it accepts is proved by the same bound.
bool Tracker::recall_sky(std::span<const RigDot> rays) noexcept {
  constexpr double kFarther = 3;    // than the last attitudes were from their predictions ...
  constexpr double kLeast = 0.03;   // ... and this [rad]
  constexpr double kWidest = 0.8;   // [rad] then it excludes too little
  constexpr double kAnyRate = 0.5;  // [rad] from the only attitude there was
  const AttitudePrediction& last = sky_prediction_.ready() ? sky_prediction_ : lost_sky_;
  if (last.ready()) {
    const PredictedAttitude expected = last.at(dots->time_ns);
    const double angle =
        std::min(farthest_expected(expected), kLeast + kFarther * last.farthest_seen(dots->time_ns));
    if (!(angle < kWidest)) return false;
    star_identification_.identify_near(expected.rig_from_j2000, angle, rays, identification_);
  } else if (sky_prediction_.without_rate()) {
    star_identification_.identify_near(sky_prediction_.last(), kAnyRate, rays, identification_);
  } else {
    return false;
  }
  return identification_.status == IdentificationStatus::kIdentified;
}

int Tracker::acquire_bodies() noexcept {
  int acquired = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    BodyPairings& out = pairings->bodies[b];
    if (out.state != TrackState::kLost) {
      if (bodies_[b].codes) bodies_[b].codes->watch(dots->frame, seen_, out);
      continue;
    }
    if (bodies_[b].codes)
      acquire_blinking(*bodies_[b].codes, out);
    else
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

void Tracker::acquire_blinking(BlinkingBody& codes, BodyPairings& out) noexcept {
  if (!codes.look(dots->frame, seen_, out)) {
    out.pairs.clear();
    return;
  }
  for (const Pairing& pair : out.pairs) seen_.claimed(pair.camera)[pair.dot] = 1;
  out.state = TrackState::kAcquired;
}

// Two dots of one star, in two cameras, are one thing.
void Tracker::count_persistence(Pairing& pair, Persistence& persistence) const noexcept {
  if (persistence.last_step != steps_) {
    const bool goes_on = persistence.frame_sets > 0 && persistence.last_step + 1 == steps_;
    persistence.frame_sets = goes_on ? persistence.frame_sets + 1 : 1;
    if (!goes_on) persistence.since_ns = dots->time_ns;
    persistence.last_step = steps_;
  }
  pair.persistence = persistence.frame_sets;
  pair.since_ns = persistence.since_ns;
}

void Tracker::count_persistence() noexcept {
  for (Pairing& pair : pairings->sky.pairs) count_persistence(pair, star_persistence_[pair.entry]);
  for (Pairing& pair : pairings->sky.solar) count_persistence(pair, solar_persistence_[pair.entry]);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    for (Pairing& pair : pairings->bodies[b].pairs)
      count_persistence(pair, bodies_[b].persistence[pair.entry]);
  }
}

void Tracker::count_unclaimed() noexcept {
  pairings->unclaimed_dots = 0;
  for (std::size_t c = 0; c < seen_.cameras(); ++c) {
    for (const std::uint8_t claimed : seen_.claimed(c)) pairings->unclaimed_dots += claimed == 0 ? 1U : 0U;
  }
}

}  // namespace omma
