#include "components/approach/approach.hpp"

#include <algorithm>
#include <cmath>

#include "components/approach/place_of_pose.hpp"
#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr std::uint32_t kSurePath = 10;  // sightings: on a shorter path warm pixels pass for stars
constexpr double kStarSnr = 10;          // fainter stars say little about the zero point
constexpr double kPartSigma = 0.3;  // of ln brightness: what a dot may lack of the light of a body that parts
constexpr double kAnotherChi2 = 30;  // the pose is elsewhere than the light: that was another thing
constexpr std::uint8_t kPartOfFlux = kDotSaturated | kDotAtEdge | kDotElongated | kDotHotPixel;

}  // namespace

Approach::Approach(const ApproachParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
                   std::span<const TargetBody> bodies, double floor_px)
    : parameters_(parameters), rig_(rig), catalogue_(catalogue), bodies_(bodies), floor_px_(floor_px) {
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

void Approach::learn_zero() noexcept {
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) zeros_[c].begin_frame();
  for (std::size_t i = 0; i < pairings->sky.pairs.size(); ++i) {
    const Pairing& pair = pairings->sky.pairs[i];
    const Dot& dot = dots->cameras[pair.camera].dots[pair.dot];
    const bool culled = i < attitude->used.size() && attitude->used[i] == 0;
    if (culled || dot.snr < kStarSnr || (dot.flags & kPartOfFlux) != 0 || !(dot.flux > 0)) continue;
    const RigCamera& camera = rig_.cameras[pair.camera];
    const Eigen::Vector3d axis = camera.rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
    const double cosine = axis.dot(rig_from_j2000_ * pair.sight.point);
    zeros_[pair.camera].add_star(std::log(dot.flux), 1 / dot.snr, magnitudes_[pair.entry],
                                 std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) zeros_[c].end_frame();
}

// A body that comes straight on keeps its direction; one that passes turns it faster the nearer it is.
void Approach::predict(double seconds) noexcept {
  for (Followed& body : followed_) {
    if (!body.followed) continue;
    const double turn = 2 * body.bearing.velocity().norm() * std::abs(body.range.closing());
    const bool known = body.range.log_range_sigma() < 1;
    const double push = known ? body.told.range.acceleration / body.range.range() : 0;
    body.bearing.predict(seconds, parameters_.bearing_acceleration + turn + push);
    body.range.predict(seconds);
  }
}

const PoseEstimate* Approach::pose_of(const Followed& body) const noexcept {
  for (const PoseEstimate& pose : poses->bodies)
    if (pose.body == body.told.body && pose.position_valid) return &pose;
  return nullptr;
}

bool Approach::is_free(std::uint32_t object) const noexcept {
  return std::none_of(followed_.begin(), followed_.end(), [object](const Followed& other) {
    return (other.followed && other.object == object) || other.commanded_object == object;
  });
}

void Approach::choose_light(Followed& body) noexcept {
  const UnknownObject* chosen = nullptr;
  if (body.commanded_object == 0) {
    chosen = brightest(body);
  } else {
    for (const UnknownObject& object : objects->objects)
      if (object.bearing.seen && object.number == body.commanded_object) chosen = &object;
  }
  if (chosen != nullptr) follow(body, *chosen);
}

// Of the sky, and not what is followed already, under whatever number.
const UnknownObject* Approach::brightest(const Followed& body) const noexcept {
  const UnknownObject* found = nullptr;
  for (const UnknownObject& object : objects->objects) {
    const bool of_the_sky =
        object.motion == ObjectMotion::kMoving || object.motion == ObjectMotion::kWithTheStars;
    if (!object.bearing.seen || !of_the_sky || object.sightings < kSurePath || !is_free(object.number))
      continue;
    const bool beside =
        body.followed && (object.direction - body.bearing.direction()).norm() < parameters_.largest_sigma;
    if (!beside && (found == nullptr || object.bearing.flux > found->bearing.flux)) found = &object;
  }
  return found;
}

void Approach::follow(Followed& body, const UnknownObject& light) noexcept {
  body.followed = true;
  body.missed = 0;
  body.object = light.number;
  body.flux = light.bearing.flux;
  body.bearing.start(light.direction, light.covariance, 0.5 * parameters_.largest_rate);
  body.range.restart();
  body.doubt.start(light.direction, rig_from_j2000_);
}

// The choice was made on a short path. Fiducials, the ground, or a brightness that told a range settle it.
void Approach::look_again(Followed& body) noexcept {
  if (!body.followed || body.object == 0 || body.commanded_object != 0 || !attitude->valid) return;
  const double sigma = std::sqrt(0.5 * body.bearing.covariance().trace());
  if (body.seen && body.doubt.stands_with_rig(body.bearing.direction(), sigma, rig_from_j2000_)) {
    lose(body);
    return;
  }
  if (body.modes.mode() != RangeMode::kFar) return;
  const UnknownObject* other = brightest(body);
  const double flux = body.seen ? body.flux : 0;
  if (body.doubt.outshone(other != nullptr ? other->number : 0, other != nullptr ? other->bearing.flux : 0,
                          flux) &&
      other != nullptr)
    follow(body, *other);
}

void Approach::see_pose(Followed& body, const PoseEstimate& pose) noexcept {
  body.seen = true;
  const PlaceOfPose place = place_of(pose);
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
        look(expected, c, whole) == Looked::kSeen)
      see_brightness(body, c, whole);
  }
}

ExpectedLight Approach::expected(const Followed& body) const noexcept {
  ExpectedLight light{.direction = body.bearing.direction(),
                      .range = body.range.range(),
                      .log_range_sigma = body.range.log_range_sigma(),
                      .size = body.size,
                      .summed = body.summed};
  light.sigma = std::sqrt(0.5 * (body.bearing.covariance() + attitude_covariance_).trace());
  return light;
}

void Approach::see_light(Followed& body) noexcept {
  const ExpectedLight expected = this->expected(body);
  find_light(*leftovers, *dots, rig_, rig_from_j2000_, expected, sightings_);
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    LightSighting& sighting = sightings_[c];
    LightSighting whole;
    const Looked looked = look(expected, c, whole);
    if (looked == Looked::kSeen) {
      sighting = whole;
    } else if (aperture_radius(expected, rig_.cameras[c]) > 0) {
      sighting.whole = false;  // too faint to be added up, and dots may leave a part of the light out
    }
    if (!sighting.seen) continue;
    body.flux = body.seen ? std::max(body.flux, sighting.flux) : sighting.flux;
    body.seen = true;
    body.summed = looked == Looked::kSeen;
    body.bearing.update(body.bearing.innovation(sighting.whitener, attitude_covariance_));
    see_brightness(body, c, sighting);
  }
}

// The light of the image, where it is well over the noise.
Looked Approach::look(const ExpectedLight& expected, std::size_t camera, LightSighting& out) noexcept {
  const DotList& list = dots->cameras[camera];
  if (list.status != FrameStatus::kFresh || camera >= frames->cameras.size() ||
      !(parameters_.gain[camera] > 0))
    return Looked::kNothing;
  find_stars(expected, camera);
  const Aperture aperture{
      .noise = list.noise, .black_level = parameters_.black_level[camera], .gain = parameters_.gain[camera]};
  const Looked looked =
      look_at_light(frames->cameras[camera].image, rig_.cameras[camera], static_cast<std::uint8_t>(camera),
                    aperture, stars_, floor_px_, rig_from_j2000_, expected, out);
  const bool faint = looked == Looked::kSeen && out.flux < parameters_.modes.snr_leave * out.flux_sigma;
  return faint ? Looked::kNothing : looked;
}

// Stars that may shine into the circle whose light is taken for the body's.
void Approach::find_stars(const ExpectedLight& expected, std::size_t camera) noexcept {
  const RigCamera& seen_by = rig_.cameras[camera];
  const double reach = (aperture_radius(expected, seen_by) + 3) * seen_by.lens.pixel_angle();
  const Eigen::Vector3d axis = seen_by.rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  const double off_axis = std::acos(std::clamp(axis.dot(rig_from_j2000_ * expected.direction), -1.0, 1.0));
  double sigma = 0;
  const double zero = zeros_[camera].at(off_axis, sigma);
  stars_.clear();
  catalogue_.near(expected.direction, reach, [&](std::uint16_t s) {
    const SkyStar& star = catalogue_.stars()[s];
    if ((star.direction - expected.direction).squaredNorm() > reach * reach) return;
    stars_.push_back({star.direction, std::exp(zero - kLogPerMagnitude * star.magnitude)});
  });
}

// Noise in proportion to the light expected: with the light seen, a faint measurement would count for less.
void Approach::see_brightness(Followed& body, std::size_t camera, const LightSighting& light) noexcept {
  const double snr = light.flux / light.flux_sigma;
  body.snr = std::max(body.snr, snr);
  if (!zeros_[camera].known() || !light.whole || snr < parameters_.modes.snr_leave) return;
  double zero_sigma = 0;
  const double zero = zeros_[camera].at(light.axis_angle, zero_sigma);
  const bool expects = body.range.expected_brightness_sigma() < 0.3;
  const double flux = expects ? std::exp(body.range.expected_brightness() + zero) : light.flux;
  // While its range is not known the light may be more than one dot.
  const double part = body.range.log_range_sigma() < kRangeKnown ? 0.0 : kPartSigma;
  const double sigma =
      root_sum_square(root_sum_square(light.flux_sigma, light.unsure) / flux, zero_sigma, part);
  const double brightness = std::log(light.flux) - zero;
  // A thing beside it, or a glint: not for once. Many in a row, and the light has changed.
  const bool fits = body.range.fits(brightness, sigma);
  body.unlike = fits ? 0 : body.unlike + 1;
  if (!fits && body.unlike <= parameters_.patience) return;
  if (!fits) body.range.restart();
  body.unlike = 0;
  body.range.see_brightness(brightness, sigma);
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
    const PlaceOfPose place = place_of(*pose);
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
  // Where in the body its light's centre is, is an error that no averaging makes smaller.
  const Eigen::Matrix3d across_sky =
      Eigen::Matrix3d::Identity() - out.direction_j2000 * out.direction_j2000.transpose();
  out.covariance_j2000 += centre_variance(expected(body)) * across_sky;
  out.direction = turn * out.direction_j2000;
  const Eigen::Matrix3d by_turn = skew(out.direction);
  out.covariance =
      turn * out.covariance_j2000 * turn.transpose() + by_turn * of_attitude * by_turn.transpose();
}

}  // namespace omma
