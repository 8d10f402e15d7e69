// The tables of a mission that describe one camera: what its sensor is like, where it is blind, how its dots
// are found, how it is exposed.
#pragma once

#include "components/exposure/exposure_control.hpp"
#include "components/extractor/camera_dots.hpp"
#include "components/geometry/lens.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {

// Each reads the table of that name inside `camera`, where there is one; InputError names file, line and
// field.

/// extractor: what is looked for and how; also_extractor: tables for other kinds of things; into `dots`.
void read_extractors(const TomlTable& camera, ExtractorCamera& dots);
/// sensor: black frame, response, fill factor, illumination; into `dots`, whose size and parameters are set;
/// and the read noise [electrons].
void read_sensor(const TomlTable& camera, const Lens& lens, ExtractorCamera& dots, double& read_noise_e);
/// mask: lens circle, picture, boxes, polygons, glare; into `dots`, whose size is set.
void read_mask(const TomlTable& camera, const Lens& lens, ExtractorCamera& dots);
/// exposure: automatic, with its limits, or a bracket.
ExposureParameters read_exposure(const TomlTable& camera);

}  // namespace omma
