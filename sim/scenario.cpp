#include "sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "components/catalogue/apparent_place.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "sim/faint_stars.hpp"

namespace omma::sim {

std::size_t Scenario::bracket_length() const {
  std::size_t length = 1;
  for (const Sensor& sensor : sensors)
    if (!sensor.bracket.empty()) length = std::lcm(length, sensor.bracket.size());
  return length;
}

Scenario Scenario::exposed(std::uint64_t frame) const {
  Scenario other = *this;
  for (Sensor& sensor : other.sensors)
    if (!sensor.bracket.empty()) sensor.exposure = sensor.bracket[frame % sensor.bracket.size()];
  return other;
}

std::vector<std::uint8_t> faces_of(const TargetBody& body, const std::vector<Face>& faces) {
  constexpr double kAlike = 0.99;  // cosine
  std::vector<std::uint8_t> found;
  for (const Target& target : body.targets) {
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Pose face_from_body = faces[f].body_from_face.inverse();
      const double facing = (face_from_body.rotation * target.normal).z();
      const Eigen::Vector3d place = face_from_body * target.position;
      const Eigen::Vector2d outside =
          (place.head<2>().cwiseAbs() - 0.5 * Eigen::Vector2d(faces[f].width, faces[f].height)).cwiseMax(0);
      double distance = std::hypot(place.z(), outside.norm());
      if (!target.normal.isZero(0) && facing < kAlike) distance += 1e6;
      if (distance >= nearest) continue;
      nearest = distance;
      best = f;
    }
    found.push_back(static_cast<std::uint8_t>(best));
  }
  return found;
}

namespace {

/// j2000_from_frame of the rig's motion, and that frame's turn [rad/s].
GroundAxes rig_axes_at(const Scenario& scenario, double time) {
  if (scenario.rig_frame == RigFrame::kGround) return ground_axes_at(scenario, time);
  if (scenario.rig_frame == RigFrame::kJ2000) return {};
  const OrbitState state = scenario.orbit->at(time);
  return {orbit_axes(state), orbit_axes_rate(state)};
}

/// Frame of the rig's motion from the rig: the gimbal's own turn comes last.
Pose frame_from_rig_at(const Scenario& scenario, double time) {
  Pose pose = scenario.rig_motion.at(time);
  if (scenario.gimbal) pose.rotation = (pose.rotation * scenario.gimbal->turn_at(time)).normalized();
  return pose;
}

/// Turn of the rig against that frame, rig axes [rad/s].
Eigen::Vector3d rate_in_frame_at(const Scenario& scenario, double time) {
  if (!scenario.gimbal) return scenario.rig_motion.rate(time);
  // Its pulses come in steps: the mean over eight beats.
  constexpr double kStep = 4 * GimbalRun::kBeat;
  const Eigen::Quaterniond before = frame_from_rig_at(scenario, time - kStep).rotation;
  const Eigen::Quaterniond after = frame_from_rig_at(scenario, time + kStep).rotation;
  return rotation_log(before.conjugate() * after) / (2 * kStep);
}

}  // namespace

SceneInstant scene_at(const Scenario& scenario, double time) {
  SceneInstant instant;
  const GroundAxes frame = rig_axes_at(scenario, time);
  const Eigen::Quaterniond rig_from_frame =
      scenario.rig_turn * frame_from_rig_at(scenario, time).rotation.conjugate();
  instant.rig_from_j2000 = rig_from_frame * frame.j2000_from_ground.conjugate();
  instant.rig_rate = scenario.rig_turn * rate_in_frame_at(scenario, time) + rig_from_frame * frame.rate;
  if (scenario.ground) {
    instant.up_rig = scenario.ground->up;
    if (scenario.ground->site) {
      const Eigen::Quaterniond rig_from_ground =
          instant.rig_from_j2000 * ground_axes_at(scenario, time).j2000_from_ground;
      instant.up_rig = rig_from_ground * Eigen::Vector3d::UnitZ();
      instant.north_rig = rig_from_ground * Eigen::Vector3d::UnitY();
    }
  }
  const Pose rig_from_j2000{instant.rig_from_j2000, Eigen::Vector3d::Zero()};
  instant.rig_from_body.reserve(scenario.cards.size());
  for (const Card& card : scenario.cards) {
    Pose pose = card.motion.at(time);
    if (card.orbit) pose.translation = card.orbit->at(time).position - scenario.orbit->at(time).position;
    instant.rig_from_body.push_back(card.inertial ? rig_from_j2000 * pose : pose);
    // A card that the rig carries along turns with it.
    Eigen::Vector3d rate = card.motion.rate(time);
    if (!card.inertial) rate += pose.rotation.conjugate() * instant.rig_rate;
    instant.body_rate.push_back(rate);
  }
  return instant;
}

std::vector<SkyStar> sky_of(const Scenario& scenario) {
  Observer observer;
  observer.julian_date_utc = scenario.julian_date_utc;
  const auto catalogue = std::make_unique<StarCatalogue>(
      observer, StarCatalogueParameters{static_cast<float>(scenario.faintest), 0});
  std::vector<SkyStar> stars(catalogue->stars().begin(), catalogue->stars().end());
  const ApparentPlace place(observer);
  for (const CatalogueStar& star : faint_stars()) {
    SkyStar seen{Eigen::Vector3d::Zero(), star.magnitude, star.hr};
    if (star.magnitude <= scenario.faintest && place.direction(star, seen.direction)) stars.push_back(seen);
  }
  return stars;
}

}  // namespace omma::sim
