#include "sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"

namespace omma::sim {

double moon_magnitude(double phase_angle) {
  const double degrees = phase_angle * 180 / std::numbers::pi;
  return -12.73 + 0.026 * std::abs(degrees) + 4e-9 * std::pow(degrees, 4);
}

double phase_angle(const Eigen::Vector3d& to_moon, const Eigen::Vector3d& to_sun) {
  return std::numbers::pi - std::acos(std::clamp(to_moon.dot(to_sun), -1.0, 1.0));
}

SceneInstant scene_at(const Scenario& scenario, double time) {
  SceneInstant instant;
  instant.rig_from_j2000 = scenario.rig_turn * scenario.rig_motion.at(time).rotation.conjugate();
  instant.rig_rate = scenario.rig_turn * scenario.rig_motion.rate(time);
  const Pose rig_from_j2000{instant.rig_from_j2000, Eigen::Vector3d::Zero()};
  instant.rig_from_body.reserve(scenario.cards.size());
  for (const Card& card : scenario.cards) {
    const Pose pose = card.motion.at(time);
    instant.rig_from_body.push_back(card.inertial ? rig_from_j2000 * pose : pose);
  }
  return instant;
}

std::vector<SkyStar> sky_of(const Scenario& scenario) {
  Observer observer;
  observer.julian_date_utc = scenario.julian_date_utc;
  const auto catalogue = std::make_unique<StarCatalogue>(
      observer, StarCatalogueParameters{static_cast<float>(scenario.faintest), 0});
  return {catalogue->stars().begin(), catalogue->stars().end()};
}

}  // namespace omma::sim
