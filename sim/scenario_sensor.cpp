// The [[sensor]] tables of a scenario.
#include <algorithm>
#include <numbers>
#include <string>

#include "sim/scenario_tables.hpp"

namespace omma::sim {
namespace {

LogResponse log_response_of(const TomlTable& table) {
  LogResponse r;
  r.volts_per_decade = 1e-3 * table.number("millivolts_per_decade", {1, 1000}, 1e3 * r.volts_per_decade);
  r.dynamic_range_db = table.number("dynamic_range_db", {20, 240}, r.dynamic_range_db);
  r.full_scale = table.number("full_scale_v", {0.01, 20}, r.full_scale);
  r.analog_gain = table.number("analog_gain", {0.1, 1000}, r.analog_gain);
  r.blacklevel = table.number("blacklevel", {-1000, 1000}, r.blacklevel);
  r.blacklevel_dark = table.number("blacklevel_dark", {-1000, 1000}, r.blacklevel_dark);
  r.blacklevel_step = 1e-3 * table.number("blacklevel_step_mv", {0, 1000}, 1e3 * r.blacklevel_step);
  r.junction = table.number("junction_e", {10, 1e9}, r.junction);
  r.fixed_pattern = 1e-3 * table.number("fixed_pattern_mv", {0, 1000}, 1e3 * r.fixed_pattern);
  r.read_noise = 1e-3 * table.number("read_noise_mv", {0, 1000}, 1e3 * r.read_noise);
  table.refuse_unknown_keys();
  return r;
}

SpectralResponse response_of(const TomlTable& table) {
  SpectralResponse response;
  if (!table.has("response")) return response;
  const std::vector<double> numbers = table.number_list("response", 2);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    const ResponsePoint point{numbers[i], numbers[i + 1]};
    if (!(point.wavelength >= 200 && point.wavelength <= 1200) || !(point.efficiency >= 0) ||
        (!response.empty() && point.wavelength <= response.back().wavelength)) {
      throw table.error("response",
                        "pairs of a wavelength, 200 to 1200 nm and rising, and an efficiency from 0",
                        std::to_string(point.wavelength) + ", " + std::to_string(point.efficiency));
    }
    response.push_back(point);
  }
  const bool any = std::any_of(response.begin(), response.end(),
                               [](const ResponsePoint& point) { return point.efficiency > 0; });
  if (response.size() < 2 || !any)
    throw table.error("response", "two points at least, not all of efficiency 0", "no light counted");
  return response;
}

void read_stray_light(const TomlTable& table, Sensor& sensor) {
  sensor.veil = table.number("veil", {0, 1}, 0);
  sensor.veil_width = kRadiansPerDegree * table.number("veil_width_deg", {0.1, 180}, 23);
  sensor.veil_reach = kRadiansPerDegree * table.number("veil_reach_deg", {0, 180}, 92);
  for (const TomlTable& ghost : table.tables_if("ghost")) {
    sensor.ghosts.push_back({ghost.number("place", {-5, 5}), ghost.number("radius_px", {0.5, 1e4}),
                             ghost.number("share", {0, 1})});
    ghost.refuse_unknown_keys();
  }
}

// What only a linear sensor has.
void read_linear(const TomlTable& table, Sensor& sensor) {
  sensor.gain = table.number("gain_e", {1e-3, 1e6});
  sensor.black_level = table.number("black_level", {0, 65535});
  sensor.read_noise = table.number("read_noise_e", {0.5, 1e4});
  sensor.full_well = table.number("full_well_e", {1, 1e9});
  sensor.blooming = table.number("blooming", {0, 1}, 0);
  if (sensor.black_level >= sensor.white_level()) {
    throw table.error("black_level", "a grey level below white, " + std::to_string(sensor.white_level()),
                      std::to_string(sensor.black_level));
  }
}

}  // namespace

Sensor sensor_of(const TomlTable& table) {
  Sensor sensor;
  sensor.bits = static_cast<int>(table.integer("bits", {8, 16}));
  sensor.dark_current = table.number("dark_current_e_s", {0, 1e9});
  sensor.exposure = table.number("exposure_s", {1e-9, 1e4});
  if (table.has("bracket_s")) {
    sensor.bracket = table.number_list("bracket_s");
    if (sensor.bracket.size() > 8)
      throw table.error("bracket_s", "8 exposures at most", std::to_string(sensor.bracket.size()));
    for (const double exposure : sensor.bracket)
      if (!(exposure >= 1e-9 && exposure <= 1e4))
        throw table.error("bracket_s", "exposures of 1e-9 to 10000 s", std::to_string(exposure));
  }
  sensor.zero_point = table.number("zero_point_e_s", {1e-6, 1e15});
  sensor.sky = table.number("sky_e_s", {0, 1e9});
  sensor.psf_sigma = table.number("psf_sigma_px", {0.2, 5});
  sensor.vignetting = table.number("vignetting", {0, 1});
  sensor.field = kRadiansPerDegree * table.number("field_deg", {0.01, 360});
  sensor.hot_pixels = table.number("hot_pixels", {0, 1}, 0);
  sensor.hot_pixel_current = table.number("hot_pixel_current_e_s", {0, 1e9}, 0);
  sensor.glare = table.number("glare", {0, 1}, 0);
  sensor.glare_radius = table.number("glare_radius_px", {0.1, 1e4}, 10);
  sensor.blur_samples = static_cast<int>(table.integer("blur_samples", {1, 256}, 1));
  sensor.fill_factor = table.number("fill_factor", {0.01, 1}, 1);
  sensor.response = response_of(table);
  read_stray_light(table, sensor);
  if (const auto logarithmic = table.table_if("logarithmic")) {
    sensor.logarithmic = log_response_of(*logarithmic);
    if (!(sensor.dark_current > 0))
      throw table.error("dark_current_e_s", "above 0: a logarithmic pixel's signal is light over it", "0");
  } else {
    read_linear(table, sensor);
  }
  table.refuse_unknown_keys();
  return sensor;
}

}  // namespace omma::sim
