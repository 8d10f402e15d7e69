// Solves photographs of the sky: images of one rig in, attitude out. The same boxes as in flight (extractor,
// identification, pairing, solver), without the flight program.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/observer.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/estimation/solution.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "components/geometry/rig.hpp"
#include "ground/photographs/solved_pairs.hpp"
#include "ground/solve/sky_hint.hpp"
#include "hal/image.hpp"

namespace omma::ground {

struct SolverOptions {
  Observer observer;
  ExtractorParameters extractor;
  float magnitude_limit = 6.5F;  ///< faintest star paired
  std::optional<SkyHint> near;   ///< looked for there first: fewer stars suffice
};

struct SolvedCamera {
  double right_ascension = 0;  ///< of the optical axis [rad], 0 to 2π
  double declination = 0;      ///< [rad]
  double roll = 0;  ///< position angle of the image's up direction, from north over east [rad], 0 to 2π
  int stars_used = 0;
};

struct SolveTimes {
  double extract_ms = 0;
  double identify_ms = 0;
  double attitude_ms = 0;
};

struct PhotographSolution {
  bool solved = false;
  std::string reason;  ///< why there is no solution; empty when solved
  AttitudeSolution attitude;
  std::vector<SolvedCamera> cameras;  ///< in the order of the rig
  std::vector<SolvedPair> pairs;
  std::vector<SolvedPair> solar;  ///< dots of Moon and planets; `entry` is a SolarBody. None without an epoch
  int stars_used = 0;
  double residual_rms_px = 0;
  bool away_from_hint = false;   ///< there was a hint, and the attitude was found elsewhere
  double log10_false_match = 0;  ///< bound on the probability that the identification is false
  SolveTimes times;
};

/// Angle of a pixel of the rig's finest camera [rad]: two stars within two of them are one dot.
double finest_pixel_angle(const Rig& rig);

/// One rig at one epoch; may be used for many sets of images. Holds the catalogue and all tables (megabytes).
class PhotographSolver {
 public:
  PhotographSolver(const Rig& rig, const SolverOptions& options);
  ~PhotographSolver();

  /// @param images  one per camera of the rig; an empty view where a camera has none
  PhotographSolution solve(const std::vector<ImageView>& images);

  /// The same from dots found before (by `find_dots`, one list a camera; a camera without an image has none).
  PhotographSolution solve(const DotLists& dots);
  /// The dots of images, as `solve` finds them.
  DotLists find_dots(const std::vector<ImageView>& images);

  /// The dots of the images solved last.
  const DotLists& dots() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace omma::ground
