// What a rig on paper sees of the sky or of a body: sights as the solver takes them, without noise or with,
// with the calibration that is believed or one that is wrong.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "components/catalogue/star_catalogue.hpp"
#include "components/catalogue/target.hpp"
#include "components/estimation/sight.hpp"
#include "ground/design/paper_rig.hpp"
#include "sim/mistaken_calibration.hpp"

namespace omma::ground {

struct SeenSights {
  std::vector<Sight> sights;
  std::vector<SightSource> sources;
  void clear() {
    sights.clear();
    sources.clear();
  }
};

/// How the dots fall.
struct DotErrors {
  double sigma_px = 0.1;                          ///< each axis
  const MistakenCalibration* mistakes = nullptr;  ///< null: the calibration is right
  std::mt19937_64* random = nullptr;              ///< null: no noise, σ as said
  std::size_t most = SIZE_MAX;                    ///< stars, brightest first: what the flight program pairs
};

/// @param stars  unit directions in J2000
SeenSights seen_stars(const PaperRig& paper, std::span<const SkyStar> stars,
                      const Eigen::Quaterniond& rig_from_j2000, const DotErrors& errors);

/// The targets of a body, seen by every camera that has them in its image.
SeenSights seen_targets(const PaperRig& paper, const TargetBody& body, const Pose& rig_from_body,
                        const DotErrors& errors);

}  // namespace omma::ground
