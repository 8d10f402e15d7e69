#include "ground/solve/photograph_solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "components/estimation/least_squares.hpp"
#include "components/extractor/dot_extractor.hpp"
#include "components/geometry/angles.hpp"
#include "components/tracker/seen_dots.hpp"
#include "components/tracker/sky_pairing.hpp"
#include "components/tracker/star_identification.hpp"

namespace omma::ground {
namespace {

constexpr int kPasses = 4;
constexpr double kEarthRadius =
    6.4e6;  // a photograph of an unknown site: how far from the Earth's centre [m]
// Nobody waits for a photograph as a spacecraft waits for its attitude: about half a second at most.
constexpr std::uint32_t kHypothesisLimit = 1'000'000;

class Stopwatch {
 public:
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

double finest_pixel_angle(const Rig& rig) {
  double finest = std::numeric_limits<double>::infinity();
  for (const RigCamera& camera : rig.cameras) finest = std::min(finest, camera.lens.pixel_angle());
  return finest;
}

struct PhotographSolver::Work {
  Work(const Rig& the_rig, const SolverOptions& the_options)
      : rig(the_rig),
        options(the_options),
        // Two stars within two pixels are one dot.
        catalogue(options.observer, {options.magnitude_limit, 2 * finest_pixel_angle(rig)}),
        places(solar_system(options.observer, options.observer.site ? 0 : kEarthRadius)),
        identification(catalogue, sky_coverage(rig),
                       {.hypothesis_limit = kHypothesisLimit, .aided_limit = kHypothesisLimit}) {
    if (options.observer.julian_date_utc) sky_pairing.look_for(places);
    for (const RigCamera& camera : rig.cameras) {
      extractors.push_back(std::make_unique<DotExtractor>(camera.lens.width(), camera.lens.height()));
    }
  }

  void extract(const std::vector<ImageView>& images);
  bool identify(PhotographSolution& solution);
  void pair_and_solve(const PredictedAttitude& prediction, double error, PhotographSolution& solution);
  void residuals(PhotographSolution& solution) const;
  const Dot& dot_of(const SolvedPair& pair) const {
    return dots.cameras[pair.pairing.camera].dots[pair.pairing.dot];
  }
  void finish(PhotographSolution& solution) const;
  PhotographSolution solve();

  Rig rig;
  SolverOptions options;
  StarCatalogue catalogue;
  SolarSystem places;  // of meaning with an epoch
  StarIdentification identification;
  std::vector<std::unique_ptr<DotExtractor>> extractors;
  DotLists dots;
  SeenDots seen;
  SkyPairing sky_pairing;
  Identification identified;
};

void PhotographSolver::Work::extract(const std::vector<ImageView>& images) {
  dots.cameras.resize(rig.cameras.size());
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    dots.cameras[c] = {};
    if (c < images.size() && !images[c].empty()) {
      extractors[c]->extract(images[c], options.extractor, dots.cameras[c]);
      dots.cameras[c].status = FrameStatus::kFresh;
    }
  }
}

bool PhotographSolver::Work::identify(PhotographSolution& solution) {
  seen.build(dots, rig, kLensErrorAtFirst);
  if (options.near) {
    const Eigen::Vector3d axis = rig.cameras[0].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
    identification.identify_pointing(axis, options.near->direction, options.near->radius, seen.rays(),
                                     identified);
  }
  if (!options.near || identified.status != IdentificationStatus::kIdentified) {
    identification.identify(seen.rays(), identified);
    solution.away_from_hint =
        options.near.has_value() && identified.status == IdentificationStatus::kIdentified;
  }
  solution.log10_false_match = identified.log10_false_match;
  if (identified.status == IdentificationStatus::kIdentified) return true;
  solution.reason = reason(identified.status);
  if (identified.status == IdentificationStatus::kTooFewDots)
    solution.reason += " (" + std::to_string(seen.rays().size()) + ")";
  return false;
}

// Every dot the attitude explains, and the least squares over them.
void PhotographSolver::Work::pair_and_solve(const PredictedAttitude& prediction, double error,
                                            PhotographSolution& solution) {
  seen.build(dots, rig, error);
  AssignmentGate gate;
  gate.floor_px = error;
  static thread_local StaticVector<Pairing, limits::kStarPairs> pairs;
  pairs.clear();
  sky_pairing.pair(seen, rig, catalogue.stars(), prediction, options.magnitude_limit, gate, {}, pairs);
  std::vector<Sight> sights;
  for (const Pairing& pairing : pairs) sights.push_back(pairing.sight);
  std::vector<std::uint8_t> used(sights.size());
  solution.attitude = solve_attitude(sights, prediction.rig_from_j2000, SolveOptions{}, used);
  solution.pairs.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) solution.pairs.push_back({pairs[i], used[i] != 0, 0});
  solution.solar.clear();
  for (const Pairing& pairing : sky_pairing.solar_pairs()) solution.solar.push_back({pairing, false, 0});
}

// Distance of each dot from its star or planet [px].
void PhotographSolver::Work::residuals(PhotographSolution& solution) const {
  for (std::vector<SolvedPair>* pairs : {&solution.pairs, &solution.solar}) {
    for (SolvedPair& pair : *pairs) {
      const RigCamera& camera = rig.cameras[pair.pairing.camera];
      const Eigen::Vector3d direction = camera.rig_from_camera.rotation.conjugate() *
                                        (solution.attitude.rig_from_j2000 * pair.pairing.sight.point);
      Eigen::Vector2d pixel;
      if (camera.lens.project(direction, pixel)) pair.residual_px = (dot_of(pair).pixel - pixel).norm();
    }
  }
  solution.residual_rms_px = residual_rms(solution.pairs);
}

void PhotographSolver::Work::finish(PhotographSolution& solution) const {
  for (const RigCamera& camera : rig.cameras) {
    const Pointing axis =
        pointing(camera.rig_from_camera.rotation.conjugate() * solution.attitude.rig_from_j2000);
    solution.cameras.push_back({axis.right_ascension, axis.declination, axis.roll});
  }
  for (const SolvedPair& pair : solution.pairs) {
    if (pair.used) ++solution.cameras[pair.pairing.camera].stars_used;
  }
  solution.stars_used = solution.attitude.pairs;
}

PhotographSolver::PhotographSolver(const Rig& rig, const SolverOptions& options)
    : work_(std::make_unique<Work>(rig, options)) {}
PhotographSolver::~PhotographSolver() = default;
const DotLists& PhotographSolver::dots() const {
  return work_->dots;
}

PhotographSolution PhotographSolver::solve(const std::vector<ImageView>& images) {
  Stopwatch stopwatch;
  work_->extract(images);
  const double extract_ms = stopwatch.lap_ms();
  PhotographSolution solution = work_->solve();
  solution.times.extract_ms = extract_ms;
  return solution;
}

PhotographSolution PhotographSolver::solve(const DotLists& dots) {
  work_->dots = dots;
  return work_->solve();
}

DotLists PhotographSolver::find_dots(const std::vector<ImageView>& images) {
  work_->extract(images);
  return work_->dots;
}

PhotographSolution PhotographSolver::Work::solve() {
  PhotographSolution solution;
  Stopwatch stopwatch;
  const bool found = identify(solution);
  solution.times.identify_ms = stopwatch.lap_ms();
  if (!found) return solution;

  // The dots' own covariances do not know what the lens file is wrong by; the residuals do. Solve with a
  // guess, measure, solve again with what was measured: the uncertainty reported then includes it.
  PredictedAttitude attitude{identified.rig_from_j2000, identified.covariance};
  double error = kLensErrorAtFirst * identified.widening;
  for (int pass = 0; pass < kPasses; ++pass) {
    pair_and_solve(attitude, error, solution);
    if (solution.attitude.status != SolveStatus::kSolved &&
        solution.attitude.status != SolveStatus::kIterationCap) {
      solution.reason = "identified stars do not agree on one attitude";
      return solution;
    }
    residuals(solution);
    attitude = {solution.attitude.rig_from_j2000, solution.attitude.covariance};
    error = lens_error(solution.pairs, dots, 3);
  }
  solution.times.attitude_ms = stopwatch.lap_ms();
  solution.solved = true;
  finish(solution);
  return solution;
}

}  // namespace omma::ground
