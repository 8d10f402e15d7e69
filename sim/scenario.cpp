#include "sim/scenario.hpp"

#include <memory>

#include "components/catalogue/star_catalogue.hpp"

namespace omma::sim {

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
