// Dots and stars of one exposure paired by place alone, for calibration: the lens and attitude are known to a
// few pixels, and pairs are wanted out to the rim, where a lens not yet adjusted is worst. A pair counts only
// where neither its dot nor its star could belong to another.
#pragma once

#include <vector>

#include "components/catalogue/star.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "ground/calibrate/sky_adjustment.hpp"

namespace omma::ground {

/// @param stars  apparent places, brightest first; in each camera as many of them are looked for as it has
/// dots
/// @param gate   farthest a dot may be from its star [px]; nothing else may be within twice as much
/// @param frame  written to the sights
void pair_by_place(const DotLists& dots, const Rig& rig, const Eigen::Quaterniond& rig_from_j2000,
                   std::span<const SkyStar> stars, double gate, int frame, std::vector<StarSight>& sights);

}  // namespace omma::ground
