#include "components/approach/approach.hpp"

#include <algorithm>
#include <cmath>

#include "components/approach/place_of_pose.hpp"
#include "components/approach/sky_pull.hpp"
#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kAnotherChi2 = 30;  // the pose is elsewhere than the light: that was another thing
constexpr double kOfPull = 0.5;      // the filter has the rest

}  // namespace

Approach::Approach(const ApproachParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
                   std::span<const TargetBody> bodies, double floor_px)
    : parameters_(parameters),
      rig_(rig),
      catalogue_(catalogue),
      bodies_(bodies),
      floor_px_(floor_px),
      candidates_(parameters.candidates) {
  for (const RigCamera& camera : rig.cameras)
    finest_pixel_ = std::min(finest_pixel_, camera.lens.pixel_angle());
  for (const SkyStar& star : catalogue.stars()) magnitudes_[star.hr] = star.magnitude;
  followed_.reserve(parameters.bodies.size());
  for (const FollowedBody& told : parameters.bodies) {
    followed_.emplace_back(told, size_of(bodies[told.body]), parameters.modes);
    estimates->bodies.push_back({.body = told.body});
  }
}

void Approach::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.input("dots", dots);
  visitor.input("pairings", pairings);
  visitor.input("attitude", attitude);
  visitor.input("poses", poses);
  visitor.input("objects", objects);
  visitor.input("leftovers", leftovers);
  visitor.output("estimates", estimates);
}

void Approach::step(const Tick& /*tick*/) noexcept {
  if (followed_.empty()) return;
  if (time_ns_ > 0 && dots->time_ns > time_ns_) predict(1e-9 * static_cast<double>(dots->time_ns - time_ns_));
  time_ns_ = dots->time_ns;
  if (attitude->valid) {
    rig_from_j2000_ = attitude->solution.rig_from_j2000.toRotationMatrix();
    attitude_covariance_ = rig_from_j2000_.transpose() * attitude->solution.covariance * rig_from_j2000_;
    learn_zero();
    look_at_candidates();
  }
  for (std::size_t i = 0; i < followed_.size(); ++i) {
    Followed& body = followed_[i];
    body.seen = false;
    body.snr = 0;
    const PoseEstimate* pose = pose_of(body);
    if (pose != nullptr) {
      see_pose(body, *pose);
    } else {
      if (!body.followed) choose_light(body);
      if (body.followed && attitude->valid) see_light(body);
      look_again(body);
    }
    body.missed = body.seen ? 0 : body.missed + 1;
    const bool vague =
        body.bearing.covariance().trace() > 2 * parameters_.largest_sigma * parameters_.largest_sigma;
    if (body.followed && (body.missed > parameters_.patience || vague)) lose(body);
    body.modes.step({.followed = body.followed,
                     .range_sigma = body.range.log_range_sigma(),
                     .snr = body.snr,
                     .pose = pose != nullptr});
    tell(body, pose, estimates->bodies[i]);
  }
}

void Approach::skipped(const Tick& /*tick*/) noexcept {
  for (ApproachEstimate& out : estimates->bodies)
    out = {.frame = dots->frame, .time_ns = dots->time_ns, .body = out.body};
}

CommandOutcome Approach::receive(const Command& command, const Tick& /*tick*/) noexcept {
  for (Followed& body : followed_) {
    if (body.told.body != static_cast<std::uint8_t>(command.arguments[0])) continue;
    body.commanded_object = static_cast<std::uint32_t>(command.arguments[1]);
    lose(body);
    return CommandOutcome::done();
  }
  return CommandOutcome::refused(CommandReason::kRefused);
}

// A body that comes straight on keeps its direction; one that passes turns it faster the nearer it is.
void Approach::predict(double seconds) noexcept {
  for (Followed& body : followed_) {
    if (!body.followed) continue;
    const double speed = body.bearing.velocity().norm();
    const RangeFilter& range = body.range;
    if (range.log_range_sigma() < kRangeKnown) {
      const double push = body.told.range.acceleration / (range.range() * std::sqrt(seconds));
      const double turn = 2 * speed * range.closing_sigma();
      body.bearing.predict(seconds, root_sum_square(push, turn), range.closing());
    } else {
      body.bearing.predict(seconds, parameters_.bearing_acceleration + 2 * speed * std::abs(range.closing()));
    }
    body.range.predict(seconds);
  }
}

const PoseEstimate* Approach::pose_of(const Followed& body) const noexcept {
  for (const PoseEstimate& pose : poses->bodies)
    if (pose.body == body.told.body && pose.position_valid) return &pose;
  return nullptr;
}

bool Approach::is_followed(std::uint32_t object) const noexcept {
  return std::any_of(followed_.begin(), followed_.end(),
                     [object](const Followed& other) { return other.followed && other.object == object; });
}

bool Approach::is_free(std::uint32_t object) const noexcept {
  return !is_followed(object) &&
         std::none_of(followed_.begin(), followed_.end(),
                      [object](const Followed& other) { return other.commanded_object == object; });
}

void Approach::look_at_candidates() noexcept {
  candidates_.begin(time_ns_);
  for (const UnknownObject& object : objects->objects)
    candidates_.show(object, light_of(object), is_followed(object.number));
  candidates_.end();
}

const UnknownObject* Approach::object_of(std::uint32_t number) const noexcept {
  for (const UnknownObject& object : objects->objects)
    if (object.bearing.seen && object.number == number) return &object;
  return nullptr;
}

// Not what is followed already, under whatever number.
const LightCandidate* Approach::likeliest(const Followed& body) const noexcept {
  return candidates_.best([&](const LightCandidate& one) {
    const bool beside =
        body.followed && (one.direction - body.bearing.direction()).norm() < parameters_.largest_sigma;
    return !beside && is_free(one.number);
  });
}

void Approach::choose_light(Followed& body) noexcept {
  const LightCandidate* one = body.commanded_object == 0 ? likeliest(body) : nullptr;
  const UnknownObject* chosen = object_of(one != nullptr ? one->number : body.commanded_object);
  if (chosen != nullptr) follow(body, *chosen);
}

void Approach::follow(Followed& body, const UnknownObject& light) noexcept {
  body.followed = true;
  body.missed = 0;
  body.object = light.number;
  body.flux = light.bearing.flux;
  body.summed = 0;
  Eigen::Matrix3d pull = Eigen::Matrix3d::Zero();
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c)
    if (light.bearing.dot[c] >= 0) pull += pull_of_stars(light.direction, light.bearing.flux, c);
  body.pull = pull;
  body.bearing.start(light.direction, light.covariance + pull, 0.5 * parameters_.largest_rate);
  body.range.restart();
  body.doubt.start(light.direction, rig_from_j2000_);
}

// The choice was made on a short path. Fiducials or the ground settle it.
void Approach::look_again(Followed& body) noexcept {
  if (!body.followed || body.object == 0 || body.commanded_object != 0 || !attitude->valid) return;
  const double sigma = std::sqrt(0.5 * body.bearing.covariance().trace());
  if (body.seen && body.doubt.stands_with_rig(body.bearing.direction(), sigma, rig_from_j2000_)) {
    lose(body);
    return;
  }
  const LightCandidate* other = likeliest(body);
  if (other == nullptr || body.modes.mode() == RangeMode::kClose) return;
  const LightCandidate* own = candidates_.find(body.object);
  bool better = own != nullptr && LightCandidates::outgrows(*other, *own);
  // A brightness that told a range is believed in, and so is one that grows.
  if (body.modes.mode() == RangeMode::kFar && !(own != nullptr && own->growth.grows()))
    better = body.doubt.outshone(other->number, other->flux, body.seen ? body.flux : 0) || better;
  const UnknownObject* object = better ? object_of(other->number) : nullptr;
  if (object != nullptr) follow(body, *object);
}

double Approach::sky_pull(const PoseEstimate& pose) const noexcept {
  for (const BodyPairings& body : pairings->bodies)
    if (body.body == pose.body)
      return size_error_of_sky({body.pairs.data(), body.pairs.size()}, {pose.used.data(), pose.used.size()},
                               *dots, parameters_.gain, parameters_.black_level);
  return 0;
}

void Approach::see_pose(Followed& body, const PoseEstimate& pose) noexcept {
  body.seen = true;
  const PlaceOfPose place = place_of(pose, sky_pull(pose));
  if (attitude->valid) {
    const Eigen::Vector3d direction = rig_from_j2000_.transpose() * place.direction;
    const Eigen::Matrix3d seen = rig_from_j2000_.transpose() * place.covariance * rig_from_j2000_;
    const auto whitener = direction_whitener(direction, seen);
    Innovation innovation = body.bearing.innovation(whitener, attitude_covariance_);
    // What was followed as its light was something else.
    if (body.followed && body.modes.mode() != RangeMode::kClose && innovation.distance2 > kAnotherChi2)
      lose(body);
    if (body.followed) {
      body.bearing.update(innovation);
    } else {
      body.bearing.start(direction, seen + attitude_covariance_, 0.5 * parameters_.largest_rate);
      body.range.restart();
      body.followed = true;
    }
  }
  body.range.see_range(place.range, place.range_sigma);
  see_targets(body, pose.solution.rig_from_body.translation);
}

// Where its range is known from elsewhere the light of all targets together tells how bright it is at 1 m.
void Approach::see_targets(Followed& body, const Eigen::Vector3d& position) noexcept {
  if (!attitude->valid) return;
  ExpectedLight expected{.size = body.size};
  expected.range = position.norm();
  expected.direction = rig_from_j2000_.transpose() * position / expected.range;
  expected.log_range_sigma = 0;
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    LightSighting whole;
    if (aperture_radius(expected, rig_.cameras[c]) < Aperture::kLargest &&
        look(expected, c, whole) == Looked::kSeen) {
      body.snr = std::max(body.snr, whole.flux / whole.flux_sigma);
      see_brightness(body, c, whole, true);
    }
  }
}

void Approach::lose(Followed& body) noexcept {
  body.followed = false;
  body.missed = 0;
  body.object = 0;
  body.range.restart();
}

void Approach::tell(const Followed& body, const PoseEstimate* pose, ApproachEstimate& out) const noexcept {
  out = {.frame = dots->frame, .time_ns = dots->time_ns, .body = body.told.body, .mode = body.modes.mode()};
  out.magnitude_at_1m = body.range.magnitude_at_1m();
  out.magnitude_sigma = body.range.magnitude_sigma();
  if (out.mode == RangeMode::kNone) return;
  out.seen = body.seen;
  out.object = body.object;
  out.snr = static_cast<float>(body.snr);
  out.inertial_valid = attitude->valid;
  out.range_valid = out.mode != RangeMode::kFar;
  out.range = body.range.range();
  out.range_sigma = body.range.range_sigma();
  out.range_rate = body.range.range_rate();
  out.range_rate_sigma = body.range.range_rate_sigma();
  const Eigen::Matrix3d& turn = rig_from_j2000_;
  const Eigen::Matrix3d of_attitude = turn * attitude_covariance_ * turn.transpose();
  if (out.mode == RangeMode::kClose && pose != nullptr) {
    const PlaceOfPose place = place_of(*pose, sky_pull(*pose));
    out.range = place.range;
    out.range_sigma = place.range_sigma;
    out.direction = place.direction;
    out.covariance = place.covariance;
    const Eigen::Matrix3d by_turn = skew(out.direction);
    const Eigen::Matrix3d in_sky = out.covariance + by_turn * of_attitude * by_turn.transpose();
    out.direction_j2000 = turn.transpose() * out.direction;
    out.covariance_j2000 = turn.transpose() * in_sky * turn;
    return;
  }
  out.direction_j2000 = body.bearing.direction();
  out.covariance_j2000 = body.bearing.covariance();
  // Where in the body its light's centre is, and a star beside it, are errors that no averaging makes
  // smaller.
  const Eigen::Matrix3d across_sky =
      Eigen::Matrix3d::Identity() - out.direction_j2000 * out.direction_j2000.transpose();
  out.covariance_j2000 += centre_variance(expected(body)) * across_sky;
  out.covariance_j2000 += kOfPull * across_sky * body.pull * across_sky;
  out.direction = turn * out.direction_j2000;
  const Eigen::Matrix3d by_turn = skew(out.direction);
  out.covariance =
      turn * out.covariance_j2000 * turn.transpose() + by_turn * of_attitude * by_turn.transpose();
}

}  // namespace omma
