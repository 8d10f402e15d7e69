// Pose of a body with known targets from one image of each camera of a rig, by its pattern alone. The same
// boxes as in flight (extractor, target identification, pairing, solver), without the flight program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/estimation/solution.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "components/geometry/rig.hpp"
#include "ground/photographs/solved_pairs.hpp"
#include "ground/resect/manual_pairs.hpp"
#include "hal/image.hpp"

namespace omma::ground {

/// The side of the background the targets of a body are on, from their types.
DotPolarity polarity_of(const TargetBody& body);

struct Resection {
  bool solved = false;
  std::string reason;  ///< why there is no pose; empty when solved
  PoseSolution pose;   ///< rig_from_body; covariance with the lens error that the residuals show
  std::vector<SolvedPair> pairs;
  std::vector<int> targets_used;  ///< of each camera
  double residual_rms_px = 0;
  double lens_error_px = 0;       ///< added to the dots' own standard deviation, per axis
  double range = 0;               ///< from the rig's origin to the middle of the targets [m]
  double range_sigma = 0;         ///< [m]
  bool by_hand = false;           ///< begun from pairs picked by hand, not from the pattern
  double log10_chance_match = 0;  ///< of the expected number of such labellings among dots at random
};

class CardResector {
 public:
  CardResector(const Rig& rig, const TargetBody& body, const ExtractorParameters& extractor);
  ~CardResector();

  /// @param images  one per camera of the rig; an empty view where a camera has none
  /// @param by_hand  where to begin; without any, from the pattern alone
  Resection resect(const std::vector<ImageView>& images, const std::vector<ManualPair>& by_hand = {});

  /// The dots of the images resected last.
  const DotLists& dots() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace omma::ground
