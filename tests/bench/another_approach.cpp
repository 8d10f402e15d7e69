#include "tests/bench/another_approach.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "sim/scenario_file.hpp"
#include "tests/bench/flown_scenario.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPush = 0.005;  // white acceleration of the body, as the mission's acceleration_m_s2

Eigen::Quaterniond any_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const double x = gauss(random), y = gauss(random), z = gauss(random), w = gauss(random);
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

// An even velocity from start to end, and white acceleration: sum of a pulse a second, the drift of its sum
// taken out again so that the way ends where it should.
std::vector<sim::PoseKey> disturbed_way(const sim::Motion& even, double seconds, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const int steps = static_cast<int>(std::ceil(seconds)) + 1;
  std::vector<Eigen::Vector3d> off{Eigen::Vector3d::Zero()};
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d push = kPush * Eigen::Vector3d(gauss(random), gauss(random), gauss(random));
    off.push_back(off.back() + velocity + 0.5 * push);
    velocity += push;
  }
  std::vector<sim::PoseKey> keys;
  for (int i = 0; i <= steps; ++i) {
    Pose pose = even.at(i);
    pose.translation += off[static_cast<std::size_t>(i)] - double(i) / steps * off.back();
    keys.push_back({double(i), pose});
  }
  return keys;
}

}  // namespace

sim::Scenario another_approach(std::mt19937_64& random) {
  sim::Scenario scenario = sim::read_scenario_file(config_file("scenarios/range_modes_scenario.toml"));
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  const Eigen::Quaterniond turn = any_rotation(random);
  const Eigen::Vector3d rate =
      0.3 * kDegree * Eigen::Vector3d(gauss(random), gauss(random), gauss(random)) / std::sqrt(3.0);
  scenario.rig_motion =
      sim::Motion::constant({turn.conjugate(), Eigen::Vector3d::Zero()}, Eigen::Vector3d::Zero(), rate);
  const sim::Motion there = scenario.cards[0].motion;
  const double speed = std::exp(std::log(0.5) + std::log(3.0) * uniform(random));  // 0.5 to 1.5 m/s
  Pose start = there.at(0);
  const double ahead = 55 / start.translation.norm();
  const Eigen::Vector3d aside = 1.5 * Eigen::Vector3d(gauss(random), gauss(random), 0);
  start.translation = ahead * start.translation;
  const Eigen::Vector3d end = 3.5 * start.translation.normalized() + 0.2 * aside;
  const double seconds = (start.translation - end).norm() / speed;
  scenario.frames = static_cast<int>(seconds * scenario.frame_rate);
  const Pose turned{turn.conjugate() * start.rotation, turn.conjugate() * start.translation};
  const Eigen::Vector3d velocity = turn.conjugate() * ((end - start.translation) / seconds);
  sim::Card& body = scenario.cards[0];
  body.motion = sim::Motion::through(
      disturbed_way(sim::Motion::constant(turned, velocity, there.rate(0)), seconds, random));
  body.faces[0].width = 0.30 + 0.10 * uniform(random);  // the lights stand 0 to 5 cm from its edges
  body.faces[0].height = 0.27 + 0.08 * uniform(random);
  scenario.seed = random();
  return scenario;
}

void add_decoys(sim::Scenario& scenario, int number, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  constexpr double kFar = 400;  // m
  const Pose body = scenario.cards[0].motion.at(0);
  for (int i = 0; i < number; ++i) {
    sim::Card decoy = scenario.cards[0];
    const Eigen::Vector3d aside(gauss(random), gauss(random), gauss(random));
    const Pose start{body.rotation, kFar * (body.translation.normalized() + 0.3 * aside).normalized()};
    const Eigen::Vector3d drift = 0.3 * Eigen::Vector3d(gauss(random), gauss(random), gauss(random));
    decoy.motion = sim::Motion::constant(start, drift, Eigen::Vector3d::Zero());
    const double as_body_at = 15 + 10 * uniform(random);  // m
    decoy.disc_magnitude += 5 * std::log10(as_body_at / start.translation.norm());
    scenario.cards.push_back(decoy);
  }
}

double magnitude_at_1m(const sim::Scenario& scenario, double time) {
  const Pose place = sim::scene_at(scenario, time).rig_from_body[0];
  const sim::Card& card = scenario.cards[0];
  const double area = 0.25 * std::numbers::pi * card.disc_diameter * card.disc_diameter;
  const double arcsec2 = std::pow(3600 / kDegree, 2);  // of a steradian
  const double range = place.translation.norm();
  double light = 0;
  for (const Target& target : card.body.targets) {
    const Eigen::Vector3d there = place * target.position;
    const double cosine = -place.rotation.inverse().toRotationMatrix().row(2).dot(there.normalized());
    light += std::max(cosine, 0.0) * area * arcsec2 * range * range / there.squaredNorm();
  }
  return card.disc_magnitude - 2.5 * std::log10(light);
}

}  // namespace omma
