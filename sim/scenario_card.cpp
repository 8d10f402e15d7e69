// The [[card]] tables of a scenario: bodies with targets.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "components/catalogue/target_file.hpp"
#include "sim/scenario_tables.hpp"

namespace omma::sim {
namespace {

constexpr Range kMagnitudes{-20, 60};

// Discs must differ from the plate the way their type says.
void check_contrast(const TomlTable& table, const Card& card) {
  const bool brighter =
      card.printed ? card.printed->disc > card.printed->plate : card.disc_magnitude < card.plate_magnitude;
  for (const Target& target : card.body.targets) {
    const bool light = target.type == 1;
    if ((light && card.led) || brighter == light) continue;
    const std::string field = card.printed ? "disc_albedo" : "disc_v_arcsec2";
    throw table.error(
        field,
        std::string("discs ") + (light ? "brighter" : "darker") + " than the plate: target " +
            std::string(target.id.view()) + " is of type " + (light ? "1" : "0"),
        card.printed ? std::to_string(card.printed->disc) + " on " + std::to_string(card.printed->plate)
                     : std::to_string(card.disc_magnitude) + " on " + std::to_string(card.plate_magnitude));
  }
}

std::pair<double, double> plate_of(const TomlTable& table) {
  const auto plate = table.numbers("plate_m", 2);
  if (!(plate[0] > 0 && plate[1] > 0)) throw table.error("plate_m", "two lengths above 0", "one that is not");
  return {plate[0], plate[1]};
}

std::vector<Face> faces_of_table(const TomlTable& table) {
  constexpr std::size_t kMost = 64;
  std::vector<Face> faces;
  for (const TomlTable& one : table.tables_if("face")) {
    Face face;
    face.body_from_face = {quaternion_of(one, "quaternion_xyzw"), vector_of(one, "centre_m")};
    std::tie(face.width, face.height) = plate_of(one);
    one.refuse_unknown_keys();
    if (faces.size() == kMost) throw one.error("plate_m", "at most 64 faces", "another one");
    faces.push_back(face);
  }
  if (!faces.empty()) return faces;
  Face plate;
  std::tie(plate.width, plate.height) = plate_of(table);
  return {plate};
}

Printed printed_of(const TomlTable& table) {
  Printed printed;
  printed.plate = table.number("plate_albedo", {0, 1});
  printed.disc = table.number("disc_albedo", {0, 1});
  printed.ambient = table.number("ambient_v_arcsec2", kMagnitudes, printed.ambient);
  return printed;
}

Led led_of(const TomlTable& table) {
  Led led;
  led.magnitude = table.number("v_at_1m", {-40, 40});
  const double half = kRadiansPerDegree * table.number("half_angle_deg", {1, 89}, 60);
  led.order = -std::log(2.0) / std::log(std::cos(half));
  table.refuse_unknown_keys();
  return led;
}

void read_light(const TomlTable& table, Card& card) {
  if (const auto led = table.table_if("led")) card.led = led_of(*led);
  if (table.has("plate_albedo")) {
    card.printed = printed_of(table);
    return;
  }
  card.plate_magnitude = table.number("plate_v_arcsec2", kMagnitudes);
  card.disc_magnitude = table.number("disc_v_arcsec2", kMagnitudes);
}

/// Where the motion begins, as the other's orbit.
Orbit orbit_beside(const TomlTable& table, const Orbit& rig_orbit, const Motion& motion) {
  // Osculating states: the drift of both orbits comes after.
  OrbitElements elements = rig_orbit.elements();
  elements.j2 = false;
  OrbitState state = Orbit(elements).at(0);
  state.position += motion.at(0).translation;
  // The motion is a straight line until it is bent here.
  state.velocity += motion.at(1).translation - motion.at(0).translation;
  const bool bound = 2 / state.position.norm() > state.velocity.squaredNorm() / kEarthGravity;
  if (!bound) throw table.error("velocity_m_s", "a body that stays with the Earth", "one that leaves it");
  return Orbit(elements_through(state, rig_orbit.elements().j2));
}

Card card_of(const TomlTable& table, double duration, const Orbit* rig_orbit) {
  Card card;
  const std::string name = table.text("name");
  if (name.empty() || name.size() > limits::kNameLength) {
    throw table.error("name", "1 to " + std::to_string(limits::kNameLength) + " characters",
                      '"' + name + '"');
  }
  card.target_file = table.path("targets");
  const std::string frame = table.text("frame");
  if (frame != "rig" && frame != "j2000")
    throw table.error("frame", "\"rig\" or \"j2000\"", '"' + frame + '"');
  card.inertial = frame == "j2000";
  card.faces = faces_of_table(table);
  read_light(table, card);
  card.disc_diameter = table.number("disc_diameter_m", {1e-6, 100});
  card.motion = card_motion_of(table, duration);
  if (table.flag("free_flight", false)) {
    if (rig_orbit == nullptr || !card.inertial || table.has("key"))
      throw table.error("free_flight", "a rig with an [orbit], frame = \"j2000\", and no keys",
                        "another one");
    card.orbit = orbit_beside(table, *rig_orbit, card.motion);
  }
  table.refuse_unknown_keys();
  card.body = read_target_file(card.target_file);
  card.body.name = Name(name);
  card.face_of = faces_of(card.body, card.faces);
  check_contrast(table, card);
  return card;
}

}  // namespace

std::vector<Card> cards_of(const TomlTable& root, double duration, const Orbit* rig_orbit) {
  std::vector<Card> cards;
  for (const TomlTable& table : root.tables_if("card")) {
    if (cards.size() == static_cast<std::size_t>(limits::kTargetBodies)) {
      throw table.error("name",
                        "at most " + std::to_string(limits::kTargetBodies) + " cards (limits::kTargetBodies)",
                        "another one");
    }
    Card card = card_of(table, duration, rig_orbit);
    for (const Card& other : cards) {
      if (other.body.name == card.body.name) {
        throw table.error("name", "a name no other card has", '"' + table.text("name") + "\" again");
      }
    }
    cards.push_back(std::move(card));
  }
  return cards;
}

}  // namespace omma::sim
