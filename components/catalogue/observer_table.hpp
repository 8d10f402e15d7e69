// The tables that say from where the sky is looked at: a site on the ground, or an orbit.
#pragma once

#include "components/catalogue/observer.hpp"
#include "components/catalogue/orbit.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {

/// `site` ("LAT,LON,HEIGHT" in degrees and metres) and optional `pressure_hpa`, `temperature_k`: a standard
/// atmosphere's where they are left out. @throws InputError naming file, line and field
GroundSite ground_site_of(const TomlTable& table);

/// `semi_major_axis_km`, `inclination_deg`, `ascending_node_deg`; optional `eccentricity`,
/// `argument_of_perigee_deg`, `true_anomaly_deg` (at the epoch), `j2`; nothing else.
/// @throws InputError naming file, line and field: also for an orbit less than 100 km high
Orbit orbit_of(const TomlTable& table);

}  // namespace omma
