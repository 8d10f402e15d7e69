#include "components/surveillance/object_tracks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kLeastDensity = 0.05;  // of chance dots [1/sr]: none seen yet is not none to come
constexpr double kMemory = 0.02;        // weight of the newest frame set in running means
constexpr std::uint32_t kCandidatePatience = 2;
constexpr std::uint32_t kSettled = 8;  // sightings until the first, maybe of something else, counts no more

// Seen and expected both uncertain: how far a path of one end may seem to be of two.
bool moved(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double sigma) {
  return (to - from).norm() > 6 * sigma;
}

// Whenever the sightings have doubled: so no single dot decides for ever, and at least half of them are
// between.
void renew_start(ObjectTrack& track) noexcept {
  if (track.sightings < kSettled || !std::has_single_bit(track.sightings)) return;
  track.from = track.next_from;
  track.next_from = {track.state.direction(), track.ray};
}

}  // namespace

// A thing that moved against the stars and against the rig moves; one that did against neither may be
// anything.
ObjectMotion ObjectTrack::motion() const noexcept {
  const bool against_stars = moved(from.direction, state.direction(), largest_sigma);
  const bool against_rig = moved(from.ray, ray, largest_sigma);
  if (against_stars && against_rig) return ObjectMotion::kMoving;
  if (against_stars) return ObjectMotion::kWithTheRig;
  if (against_rig) return ObjectMotion::kWithTheStars;
  return ObjectMotion::kUndecided;
}

ObjectTracks::ObjectTracks(const SurveillanceParameters& parameters, const Rig& rig,
                           std::span<const double> solid_angle)
    : parameters_(parameters), rig_(rig) {
  for (std::size_t c = 0; c < solid_angle.size() && c < solid_angle_.size(); ++c)
    solid_angle_[c] = solid_angle[c];
  density_.fill(1.0);  // to be wary of the first frame sets
}

void ObjectTracks::predict(double seconds) noexcept {
  interval_s_ = std::max(seconds, 1e-3);
  for (std::size_t t = 0; t < in_use_; ++t) {
    if (!tracks_[t].active) continue;
    tracks_[t].state.predict(seconds, parameters_.acceleration);
    tracks_[t].bearing = {};
    tracks_[t].bearing.dot.fill(-1);
  }
}

void ObjectTracks::take(std::span<const LeftoverDot> dots, const SkyFrame& frame) noexcept {
  const Eigen::Matrix3d rig_from_j2000 = frame.rig_from_j2000.toRotationMatrix();
  const Eigen::Matrix3d common = rig_from_j2000.transpose() * frame.attitude_covariance * rig_from_j2000;
  std::fill_n(spent_.begin(), dots.size(), std::uint8_t{0});
  find_fits(dots, common);
  assign(dots, frame, common);
  for (std::size_t t = 0; t < in_use_; ++t) {
    ObjectTrack& track = tracks_[t];
    if (!track.active) continue;
    if (track.bearing.seen) {
      ++track.sightings;
      track.missed = 0;
      renew_start(track);
      track.last_seen_ns = frame.time_ns;
    } else {
      miss(track, frame);
    }
  }
  confirm();
  if (!frame.everywhere) return;
  begin_tracks(dots, frame);
  learn_density(dots);
}

void ObjectTracks::find_fits(std::span<const LeftoverDot> dots, const Eigen::Matrix3d& common) noexcept {
  fits_.clear();
  for (std::size_t t = 0; t < in_use_; ++t) {
    const ObjectTrack& track = tracks_[t];
    if (!track.active) continue;
    const double spread = std::sqrt(track.state.covariance().trace() + common.trace());
    for (std::size_t d = 0; d < dots.size(); ++d) {
      const double reach = std::sqrt(2 * parameters_.gate_chi2) * (spread + 2 * dots[d].sigma);
      if ((dots[d].direction - track.state.direction()).squaredNorm() > reach * reach) continue;
      const Innovation innovation = track.state.innovation(dots[d].whitener, common);
      if (innovation.distance2 > parameters_.gate_chi2) continue;
      const double cost = innovation.distance2 + 2 * std::log(innovation.area);
      if (!fits_.push_back({static_cast<std::uint16_t>(t), static_cast<std::uint16_t>(d),
                            static_cast<float>(cost), static_cast<float>(innovation.distance2),
                            track.number != 0}))
        return;
    }
  }
}

// Another dot of the camera for this object, or another object for this dot, that fits nearly as well.
bool ObjectTracks::is_ambiguous(const Fit& fit, std::span<const LeftoverDot> dots) const noexcept {
  for (const Fit& other : fits_) {
    if (!other.confirmed) break;  // they stand first
    const bool other_dot =
        other.track == fit.track && other.dot != fit.dot && dots[other.dot].camera == dots[fit.dot].camera;
    const bool other_track = other.dot == fit.dot && other.track != fit.track;
    if ((other_dot || other_track) && std::abs(other.distance2 - fit.distance2) < parameters_.ambiguity)
      return true;
  }
  return false;
}

void ObjectTracks::assign(std::span<const LeftoverDot> dots, const SkyFrame& frame,
                          const Eigen::Matrix3d& common) noexcept {
  std::sort(fits_.begin(), fits_.end(), [](const Fit& a, const Fit& b) {
    if (a.confirmed != b.confirmed) return a.confirmed;
    if (a.cost != b.cost) return a.cost < b.cost;
    return a.track != b.track ? a.track < b.track : a.dot < b.dot;
  });
  for (const Fit& fit : fits_) {
    ObjectTrack& track = tracks_[fit.track];
    const LeftoverDot& dot = dots[fit.dot];
    if (spent_[fit.dot] != 0 || track.bearing.dot[dot.camera] >= 0) continue;
    if (fit.confirmed && is_ambiguous(fit, dots)) {
      spent_[fit.dot] = 2;
      continue;
    }
    // Another camera's dot may have moved the object meanwhile; it is not asked for its gate again.
    spent_[fit.dot] = 1;
    see(track, dot, frame, common);
  }
}

void ObjectTracks::see(ObjectTrack& track, const LeftoverDot& dot, const SkyFrame& /*frame*/,
                       const Eigen::Matrix3d& common) noexcept {
  const Innovation innovation = track.state.innovation(dot.whitener, common);
  const double chance = density_[dot.camera] * 2 * std::numbers::pi * innovation.area;
  track.score += std::log(parameters_.detection_probability / chance) - 0.5 * innovation.distance2;
  track.state.update(innovation);
  track.ray = dot.ray;
  track.largest_sigma = std::max(track.largest_sigma, dot.sigma);

  ObjectBearing& bearing = track.bearing;
  bearing.dot[dot.camera] = static_cast<std::int16_t>(dot.dot);
  const Eigen::Matrix3d covariance = direction_covariance(dot);
  if (!bearing.seen) {
    bearing.seen = true;
    bearing.direction = dot.direction;
    bearing.covariance = covariance;
    bearing.flux = dot.flux;
    bearing.snr = dot.snr;
    return;
  }
  // Two cameras saw it: the weighted mean, across the line of sight.
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(bearing.direction);
  const Eigen::Matrix2d first = (basis.transpose() * bearing.covariance * basis).inverse();
  const Eigen::Matrix2d second = (basis.transpose() * covariance * basis).inverse();
  const Eigen::Matrix2d mean = (first + second).inverse();
  const Eigen::Vector2d step = mean * second * (basis.transpose() * dot.direction);
  bearing.direction = (bearing.direction + basis * step).normalized();
  bearing.covariance = basis * mean * basis.transpose();
  if (dot.flux > bearing.flux) {
    bearing.flux = dot.flux;
    bearing.snr = dot.snr;
  }
}

bool ObjectTracks::should_be_seen(const ObjectTrack& track, const SkyFrame& frame) const noexcept {
  const Eigen::Vector3d in_rig = frame.rig_from_j2000 * track.state.direction();
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    Eigen::Vector2d pixel;
    const RigCamera& camera = rig_.cameras[c];
    if (frame.looking[c] && camera.lens.project(camera.rig_from_camera.rotation.conjugate() * in_rig, pixel))
      return true;
  }
  return false;
}

void ObjectTracks::miss(ObjectTrack& track, const SkyFrame& frame) noexcept {
  if (track.number == 0 && !frame.everywhere) return;  // windows are about confirmed objects only
  if (std::sqrt(track.state.covariance().trace()) > parameters_.largest_sigma && track.sightings > 1) {
    track.active = false;
    return;
  }
  if (!should_be_seen(track, frame)) {
    track.active = track.number != 0;  // what was hardly seen is not waited for
    return;
  }
  ++track.missed;
  track.score += std::log(1 - parameters_.detection_probability);
  const auto patience =
      track.number != 0 ? static_cast<std::uint32_t>(parameters_.patience) : kCandidatePatience;
  if (track.missed > patience || (track.number == 0 && track.score < 0)) track.active = false;
}

double ObjectTracks::threshold() const noexcept {
  const double births_per_hour = std::max(births_, 0.1) / interval_s_ * 3600;
  return std::log(std::max(births_per_hour / parameters_.false_objects_per_hour, 1e3));
}

void ObjectTracks::confirm() noexcept {
  candidates_ = 0;
  std::size_t told = 0;
  for (std::size_t t = 0; t < in_use_; ++t) told += tracks_[t].active && tracks_[t].number != 0 ? 1 : 0;
  const double enough = threshold();
  for (std::size_t t = 0; t < in_use_; ++t) {
    ObjectTrack& track = tracks_[t];
    if (!track.active || track.number != 0) continue;
    const bool sure = track.score >= enough &&
                      track.sightings >= static_cast<std::uint32_t>(parameters_.least_sightings) &&
                      track.state.velocity().norm() <= parameters_.largest_rate;
    if (sure && told < limits::kUnknownObjects) {
      track.number = ++confirmed_;
      ++told;
    } else {
      ++candidates_;
    }
  }
}

ObjectTrack* ObjectTracks::free_track() noexcept {
  for (std::size_t t = 0; t < in_use_; ++t)
    if (!tracks_[t].active) return &tracks_[t];
  if (in_use_ < tracks_.size()) return &tracks_[in_use_++];
  return nullptr;
}

void ObjectTracks::begin_tracks(std::span<const LeftoverDot> dots, const SkyFrame& frame) noexcept {
  not_followed_ = 0;
  int begun = 0;
  for (std::size_t d = 0; d < dots.size(); ++d) {
    if (spent_[d] != 0) continue;
    ++begun;
    ObjectTrack* track = free_track();
    if (track == nullptr) {
      ++not_followed_;
      continue;
    }
    const LeftoverDot& dot = dots[d];
    *track = {};
    track->active = true;
    track->state.start(dot.direction, direction_covariance(dot), 0.5 * parameters_.largest_rate);
    track->first_seen_ns = track->last_seen_ns = frame.time_ns;
    track->sightings = 1;
    track->from = track->next_from = {dot.direction, dot.ray};
    track->ray = dot.ray;
    track->largest_sigma = dot.sigma;
  }
  births_ += kMemory * (begun - births_);
}

// Dots of objects that are known are not chance's.
void ObjectTracks::learn_density(std::span<const LeftoverDot> dots) noexcept {
  std::array<int, limits::kCameras> count{};
  for (std::size_t d = 0; d < dots.size(); ++d) ++count[dots[d].camera];
  for (std::size_t t = 0; t < in_use_; ++t) {
    if (!tracks_[t].active || tracks_[t].number == 0) continue;
    for (std::size_t c = 0; c < count.size(); ++c) count[c] -= tracks_[t].bearing.dot[c] >= 0 ? 1 : 0;
  }
  for (std::size_t c = 0; c < count.size(); ++c) {
    if (!(solid_angle_[c] > 0)) continue;
    const double now = std::max(count[c], 0) / solid_angle_[c];
    density_[c] = std::max(kLeastDensity, density_[c] + kMemory * (now - density_[c]));
  }
}

}  // namespace omma
