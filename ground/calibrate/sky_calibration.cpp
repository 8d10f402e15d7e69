#include "ground/calibrate/sky_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "components/catalogue/star.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "ground/calibrate/star_pairing.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/solve/photograph_solver.hpp"

namespace omma::ground {
namespace {

constexpr int kMostPasses = 12;
constexpr double kFirstGate = 8;    // of pairs, with a guessed lens [px]
constexpr double kLeastGate = 1.5;  // [px]
constexpr double kGateOverRms = 5;
constexpr double kFocalStep = 1.02;
// The radial numbers come in one by one, so that the first pairs, near the axis, do not bend the lens at the
// rim.
constexpr int kFirstRadial = 2;

Rig rig_with(const Rig& guess, const std::vector<LensShape>& shapes) {
  Rig rig = guess;
  for (std::size_t c = 0; c < shapes.size(); ++c) rig.cameras[c].lens = shapes[c].lens().value();
  return rig;
}

// 1, up and down in turn, ever farther.
std::vector<double> focal_factors(double most) {
  std::vector<double> factors{1.0};
  const int steps = static_cast<int>(std::log(most) / std::log(kFocalStep));
  for (int k = 1; k <= steps; ++k) {
    factors.push_back(std::pow(kFocalStep, k));
    factors.push_back(std::pow(kFocalStep, -k));
  }
  return factors;
}

std::vector<LensShape> scaled(std::vector<LensShape> shapes, double factor) {
  for (LensShape& shape : shapes) shape.parameters[2] *= factor;
  return shapes;
}

class Calibrator {
 public:
  Calibrator(const Rig& guess, const std::vector<SkyExposure>& exposures,
             const SkyCalibrationOptions& options)
      : guess_(guess), exposures_(exposures), options_(options) {
    for (const RigCamera& camera : guess.cameras)
      shapes_.push_back(nearest_shape(camera.lens, LensModel::kKannalaBrandt, options.max_angle));
    const double merged = 2 * finest_pixel_angle(guess);
    for (const SkyExposure& exposure : exposures)
      stars_.emplace_back(exposure.observer, StarCatalogueParameters{options.magnitude_limit, merged});
    for (const CatalogueStar& star : bright_star_catalogue()) magnitude_[star.hr] = star.magnitude;
  }

  SkyCalibration run();

 private:
  PhotographSolution solve(const Rig& rig, const SkyExposure& exposure) const {
    SolverOptions solver_options;
    solver_options.observer = exposure.observer;
    solver_options.magnitude_limit = options_.magnitude_limit;
    return PhotographSolver(rig, solver_options).solve(exposure.dots);
  }
  bool recognise(SkyCalibration& result);
  std::size_t pair_all(const Rig& rig, double gate, SkyRig& start, std::vector<StarSight>& sights) const;
  SkyRig sky_rig(const Rig& rig) const;
  void take(const SkyAdjustment& adjustment);
  void change_model();
  bool pass(double gate, int free_radial, SkyCalibration& result);

  Rig guess_;
  const std::vector<SkyExposure>& exposures_;
  SkyCalibrationOptions options_;
  std::vector<LensShape> shapes_;
  std::vector<StarCatalogue> stars_;  ///< of each exposure
  std::map<std::uint16_t, float> magnitude_;
};

// The focal length at which the first exposure's stars are recognised.
bool Calibrator::recognise(SkyCalibration& result) {
  std::string reason;
  for (const double factor : focal_factors(options_.focal_search)) {
    const std::vector<LensShape> trial = scaled(shapes_, factor);
    for (const SkyExposure& exposure : exposures_) {
      const PhotographSolution solution = solve(rig_with(guess_, trial), exposure);
      if (!solution.solved) {
        if (reason.empty()) reason = solution.reason;
        continue;
      }
      shapes_ = trial;
      result.focal_factor = factor;
      return true;
    }
  }
  result.reason = format("no stars recognised with any focal length from %.2f to %.2f times the guess (",
                         1 / options_.focal_search, options_.focal_search) +
                  reason + ")";
  return false;
}

SkyRig Calibrator::sky_rig(const Rig& rig) const {
  SkyRig sky;
  sky.lenses = shapes_;
  for (const RigCamera& camera : rig.cameras)
    sky.camera_from_rig.push_back(camera.rig_from_camera.rotation.conjugate());
  return sky;
}

// The solver's attitude, and every star within the gate of where the lens puts it.
// @return exposures whose stars were recognised
std::size_t Calibrator::pair_all(const Rig& rig, double gate, SkyRig& start,
                                 std::vector<StarSight>& sights) const {
  sights.clear();
  start = sky_rig(rig);
  for (std::size_t e = 0; e < exposures_.size(); ++e) {
    const PhotographSolution solution = solve(rig, exposures_[e]);
    if (!solution.solved) continue;
    const int frame = static_cast<int>(start.rig_from_j2000.size());
    start.rig_from_j2000.push_back(solution.attitude.rig_from_j2000);
    pair_by_place(exposures_[e].dots, rig, solution.attitude.rig_from_j2000, stars_[e].stars(), gate, frame,
                  sights);
  }
  return start.rig_from_j2000.size();
}

void Calibrator::take(const SkyAdjustment& adjustment) {
  shapes_ = adjustment.rig.lenses;
  for (std::size_t c = 0; c < guess_.cameras.size(); ++c)
    guess_.cameras[c].rig_from_camera.rotation = adjustment.rig.camera_from_rig[c].conjugate();
}

void Calibrator::change_model() {
  for (LensShape& shape : shapes_)
    shape = nearest_shape(shape.lens().value(), options_.model, shape.max_angle);
}

// One pass: pair, adjust, take over. False with a reason where it cannot go on.
bool Calibrator::pass(double gate, int free_radial, SkyCalibration& result) {
  ++result.passes;
  SkyRig start;
  if (pair_all(rig_with(guess_, shapes_), gate, start, result.sights) == 0) {
    result.reason = "the stars recognised at first were lost when the lens was adjusted";
    return false;
  }
  result.adjustment = adjust_to_sky(start, result.sights, {free_radial, free_radial >= kEvenPowers});
  if (!result.adjustment.converged) {
    result.reason = "the adjustment did not converge: too few stars (" +
                    std::to_string(result.sights.size()) + "), or none towards the rim";
    return false;
  }
  take(result.adjustment);
  return true;
}

SkyCalibration Calibrator::run() {
  SkyCalibration result;
  if (!recognise(result)) return result;
  double gate = kFirstGate;
  for (int radial = kFirstRadial; radial <= kEvenPowers; ++radial) {
    if (!pass(gate, radial, result)) return result;
    gate = std::clamp(kGateOverRms * result.adjustment.rms_px, kLeastGate, gate);
  }
  change_model();
  std::size_t pairs_before = 0;
  for (int k = 0; k < kMostPasses; ++k) {
    if (!pass(gate, kEvenPowers, result)) return result;
    if (result.sights.size() == pairs_before && gate == kLeastGate) break;
    pairs_before = result.sights.size();
    gate = std::clamp(kGateOverRms * result.adjustment.rms_px, kLeastGate, gate);
  }
  result.rig = rig_with(guess_, shapes_);
  for (const StarSight& sight : result.sights) result.magnitudes.push_back(magnitude_[sight.hr]);
  result.done = true;
  return result;
}

}  // namespace

SkyCalibration calibrate_from_sky(const Rig& guess, const std::vector<SkyExposure>& exposures,
                                  const SkyCalibrationOptions& options) {
  return Calibrator(guess, exposures, options).run();
}

}  // namespace omma::ground
