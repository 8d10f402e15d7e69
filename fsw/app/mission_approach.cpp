#include "fsw/app/mission_approach.hpp"

#include <numbers>
#include <string>

#include "components/approach/light_candidates.hpp"
#include "components/approach/photometric_zero.hpp"

namespace omma {

FollowedBody read_light(const TomlTable& table, std::uint8_t body) {
  FollowedBody followed{.body = body, .range = {}};
  RangeFilterParameters& p = followed.range;
  p.magnitude_at_1m = table.number("magnitude_at_1m", {-40, 30});
  p.magnitude_sigma = table.number("magnitude_sigma", {0.01, 10});
  p.brightness_floor =
      kLogPerMagnitude * table.number("magnitude_floor", {0, 2}, p.brightness_floor / kLogPerMagnitude);
  p.acceleration = table.number("acceleration_m_s2", {1e-9, 100}, p.acceleration);
  p.range_prior = table.number("range_m", {0.01, 1e7}, p.range_prior);
  table.refuse_unknown_keys();
  return followed;
}

void read_approach(const TomlTable& table, ApproachParameters& parameters) {
  constexpr double kDegree = std::numbers::pi / 180;
  RangeModeParameters& m = parameters.modes;
  m.range_sigma_enter = table.number("range_sigma_enter", {1e-3, 1}, m.range_sigma_enter);
  m.range_sigma_leave = table.number("range_sigma_leave", {1e-3, 2}, m.range_sigma_leave);
  m.snr_enter = table.number("snr_enter", {1, 1000}, m.snr_enter);
  m.snr_leave = table.number("snr_leave", {1, 1000}, m.snr_leave);
  m.settle = static_cast<int>(table.integer("settle", {1, 1000}, m.settle));
  m.patience = static_cast<int>(table.integer("patience", {1, 1000}, m.patience));
  parameters.candidates = static_cast<int>(
      table.integer("candidates", {1, std::int64_t{LightCandidates::kMost}}, parameters.candidates));
  if (m.range_sigma_leave < m.range_sigma_enter) {
    throw table.error("range_sigma_leave",
                      "no less than range_sigma_enter, " + std::to_string(m.range_sigma_enter),
                      std::to_string(m.range_sigma_leave));
  }
  if (m.snr_leave > m.snr_enter) {
    throw table.error("snr_leave", "no more than snr_enter, " + std::to_string(m.snr_enter),
                      std::to_string(m.snr_leave));
  }
  parameters.bearing_acceleration = kDegree * table.number("bearing_acceleration_deg_s2", {1e-9, 90},
                                                           parameters.bearing_acceleration / kDegree);
  parameters.largest_rate =
      kDegree * table.number("largest_rate_deg_s", {0.001, 90}, parameters.largest_rate / kDegree);
  table.refuse_unknown_keys();
}

}  // namespace omma
