// The tables of a scenario that say what is around the rig: [ground] and [earth].
#include "components/catalogue/observer_table.hpp"
#include "sim/scenario_tables.hpp"

namespace omma::sim {
namespace {

constexpr Range kMagnitudes{-30, 60};

NightSky night_sky_of(const TomlTable& table, bool has_site) {
  NightSky sky;
  sky.zenith = table.number("zenith_v_arcsec2", kMagnitudes, sky.zenith);
  sky.ground = table.number("ground_v_arcsec2", kMagnitudes, sky.ground);
  for (const TomlTable& one : table.tables_if("dome")) {
    if (!has_site) throw one.error("azimuth_deg", "a site in [ground], for a north", "none");
    LightDome dome;
    dome.azimuth = kRadiansPerDegree * one.number("azimuth_deg", {-360, 360});
    dome.width = kRadiansPerDegree * one.number("width_deg", {0.1, 360});
    dome.height = kRadiansPerDegree * one.number("height_deg", {0.1, 90});
    dome.magnitude = one.number("v_arcsec2", kMagnitudes);
    one.refuse_unknown_keys();
    sky.domes.push_back(dome);
  }
  table.refuse_unknown_keys();
  return sky;
}

}  // namespace

Ground ground_of(const TomlTable& table) {
  Ground ground;
  if (table.has("site")) {
    ground.site = ground_site_of(table);
    ground.refracts = table.flag("refraction", true);
    ground.pressure = *ground.site->pressure;
    ground.temperature = *ground.site->temperature;
  } else {
    ground.up = unit_vector_of(table, "up_rig");
    ground.refracts = table.flag("refraction", false);
    ground.pressure = table.number("pressure_hpa", {0, 1200}, ground.pressure);
    ground.temperature = table.number("temperature_k", {150, 350}, ground.temperature);
  }
  ground.skyline = kRadiansPerDegree * table.number("skyline_deg", {-5, 89}, 0);
  ground.extinction = table.number("extinction_mag", {0, 5}, 0);
  if (const auto glow = table.table_if("glow")) ground.glow = night_sky_of(*glow, ground.site.has_value());
  for (const TomlTable& one : table.tables_if("lamp")) {
    if (!ground.site) throw one.error("azimuth_deg", "a site in [ground], for a north", "none");
    ground.lamps.push_back({kRadiansPerDegree * one.number("azimuth_deg", {-360, 360}),
                            kRadiansPerDegree * one.number("elevation_deg", {-90, 90}),
                            one.number("magnitude", kMagnitudes)});
    one.refuse_unknown_keys();
  }
  table.refuse_unknown_keys();
  return ground;
}

EarthLook earth_of(const TomlTable& table) {
  EarthLook look;
  look.albedo = table.number("albedo", {0, 1}, look.albedo);
  look.scale_height = 1e3 * table.number("scale_height_km", {1, 50}, 1e-3 * look.scale_height);
  look.optical_depth = table.number("optical_depth", {1e-6, 10}, look.optical_depth);
  look.night_magnitude = table.number("night_v_arcsec2", kMagnitudes, look.night_magnitude);
  table.refuse_unknown_keys();
  return look;
}

}  // namespace omma::sim
