#include "components/catalogue/observer_table.hpp"

#include <numbers>
#include <string>

#include "components/catalogue/apparent_place.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

GroundSite ground_site_of(const TomlTable& table) {
  const std::string text = table.text("site");
  GroundSite site;
  try {
    site = parse_ground_site(text);
  } catch (const InputError&) {
    throw table.error("site", "\"LAT,LON,HEIGHT\" in degrees, north and east, and metres", '"' + text + '"');
  }
  site.pressure = table.number("pressure_hpa", {0, 1200}, standard_pressure(site.height));
  site.temperature = table.number("temperature_k", {150, 350}, standard_temperature(site.height));
  return site;
}

Orbit orbit_of(const TomlTable& table) {
  constexpr double kLowest = 100e3;  // above the equator's radius: nothing orbits lower for long [m]
  OrbitElements elements;
  elements.eccentricity = table.number("eccentricity", {0, 0.99}, 0);
  elements.semi_major_axis = 1e3 * table.number("semi_major_axis_km", {6400, 1e6});
  elements.inclination = kDegree * table.number("inclination_deg", {0, 180});
  elements.ascending_node = kDegree * table.number("ascending_node_deg", {-360, 360});
  elements.argument_of_perigee = kDegree * table.number("argument_of_perigee_deg", {-360, 360}, 0);
  elements.true_anomaly = kDegree * table.number("true_anomaly_deg", {-360, 360}, 0);
  elements.j2 = table.flag("j2", true);
  const double perigee = elements.semi_major_axis * (1 - elements.eccentricity) - kEarthRadius;
  if (perigee < kLowest) {
    throw table.error("semi_major_axis_km", "a perigee at least 100 km high",
                      std::to_string(1e-3 * perigee) + " km");
  }
  table.refuse_unknown_keys();
  return Orbit(elements);
}

}  // namespace omma
