#include "ground/calibrate/sky_drift.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ground/format.hpp"

namespace omma::ground {
namespace {

constexpr int kFocal = 2;              // where a Kannala-Brandt shape has its focal length
constexpr std::size_t kLeastSets = 3;  // of a window

using Sets = std::vector<const FlightSet*>;

// At most `most`, evenly taken.
Sets taken(const std::vector<FlightSet>& sets, std::size_t first, std::size_t last, std::size_t most) {
  Sets some;
  const std::size_t count = last - first;
  const std::size_t number = std::min(count, most);
  for (std::size_t k = 0; k < number; ++k) some.push_back(&sets[first + k * count / number]);
  return some;
}

SkyRig start_of(const SkyRig& rig, const Sets& sets, std::vector<StarSight>& sights) {
  SkyRig start = rig;
  start.rig_from_j2000.clear();
  for (const FlightSet* set : sets) {
    for (StarSight sight : set->sights) {
      sight.frame = static_cast<int>(start.rig_from_j2000.size());
      sights.push_back(sight);
    }
    start.rig_from_j2000.push_back(set->rig_from_j2000);
  }
  return start;
}

class DriftFinder {
 public:
  DriftFinder(const Rig& rig, const std::vector<std::vector<FlightSet>>& recordings,
              const DriftOptions& options)
      : rig_(rig), recordings_(recordings), options_(options) {}

  SkyDrift run();

 private:
  bool find_mean(SkyDrift& drift);
  void add_window(const Sets& sets, SkyDrift& drift) const;

  const Rig& rig_;
  const std::vector<std::vector<FlightSet>>& recordings_;
  DriftOptions options_;
  SkyRig mean_;  // Kannala-Brandt
  int radial_ = kEvenPowers;
  bool aspect_ = true;
};

// As many radial numbers as the stars tell: where they do not reach the rim, fewer. The mean for the drift is
// Kannala-Brandt, whose focal length is one number; the one that is handed out has the model asked for.
bool DriftFinder::find_mean(SkyDrift& drift) {
  Sets sets;
  for (const auto& recording : recordings_)
    for (const FlightSet* set : taken(recording, 0, recording.size(), options_.mean_sets))
      sets.push_back(set);
  SkyRig rig;
  for (const RigCamera& camera : rig_.cameras) {
    rig.lenses.push_back(nearest_shape(camera.lens, LensModel::kKannalaBrandt, options_.max_angle));
    rig.camera_from_rig.push_back(camera.rig_from_camera.rotation.conjugate());
  }
  SkyCalibration& mean = drift.mean;
  const SkyRig start = start_of(rig, sets, mean.sights);
  for (int radial = kEvenPowers; radial >= 1; --radial) {
    radial_ = radial;
    aspect_ = radial == kEvenPowers;
    mean.adjustment = adjust_to_sky(start, mean.sights, {radial_, aspect_});
    if (!mean.adjustment.converged) continue;
    mean_ = mean.adjustment.rig;
    mean_.rig_from_j2000.clear();
    SkyRig again = mean.adjustment.rig;
    for (LensShape& shape : again.lenses)
      shape = nearest_shape(shape.lens().value(), options_.model, shape.max_angle);
    SkyAdjustment asked = adjust_to_sky(again, mean.sights, {radial_, aspect_});
    if (asked.converged) mean.adjustment = std::move(asked);
    break;
  }
  if (!mean.adjustment.converged) {
    drift.reason = format("the stars of %zu frame sets do not fix the rig", sets.size());
    return false;
  }
  mean.rig = rig_;
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    mean.rig.cameras[c].lens = mean.adjustment.rig.lenses[c].lens().value();
    mean.rig.cameras[c].rig_from_camera.rotation = mean.adjustment.rig.camera_from_rig[c].conjugate();
  }
  for (const FlightSet* set : sets)
    mean.magnitudes.insert(mean.magnitudes.end(), set->magnitudes.begin(), set->magnitudes.end());
  mean.passes = 1;
  mean.done = true;
  return true;
}

// Lenses and turns of one window, with everything free that the mean had free.
void DriftFinder::add_window(const Sets& sets, SkyDrift& drift) const {
  std::vector<StarSight> sights;
  const SkyRig start = start_of(mean_, sets, sights);
  const SkyAdjustment found = adjust_to_sky(start, sights, {radial_, aspect_});
  if (!found.converged) return;
  // One entry a number told: where it is in the adjustment, its scale, and what it is.
  std::vector<Eigen::Index> at;
  std::vector<double> scale, numbers;
  const auto add = [&](Eigen::Index where, double unit, double value) {
    at.push_back(where);
    scale.push_back(unit);
    numbers.push_back(unit * value);
  };
  const auto lens_number = [&](std::size_t c, Eigen::Index k) {
    const double then = mean_.lenses[c].parameters[k];
    add(found.lens_offset(c) + k, k == kFocal ? 1 / then : 1, found.rig.lenses[c].parameters[k] - then);
  };
  for (std::size_t c = 0; c < drift.layout.cameras; ++c)
    for (Eigen::Index k = 0; k < 3; ++k) lens_number(c, k);
  const std::size_t last = drift.layout.cameras - 1;
  Eigen::Index turns = found.lens_offset(last) + found.rig.lenses[last].parameters.size();
  for (std::size_t c = 1; c < drift.layout.cameras; ++c) {
    const Eigen::Vector3d turn =
        rotation_log(found.rig.camera_from_rig[c] * mean_.camera_from_rig[c].conjugate());
    for (Eigen::Index k = 0; k < 3; ++k) add(turns++, 1, turn[k]);
  }
  for (std::size_t c = 0; c < drift.layout.cameras; ++c) {
    for (Eigen::Index k = 3; k < mean_.lenses[c].parameters.size(); ++k) {
      const Eigen::Index where = found.lens_offset(c) + k;
      if (found.covariance(where, where) > 0) lens_number(c, k);  // others were held
    }
  }
  DriftWindow window;
  window.sets = sets.size();
  window.stars = sights.size();
  for (const FlightSet* set : sets) window.time += set->time / static_cast<double>(sets.size());
  const auto size = static_cast<Eigen::Index>(numbers.size());
  window.numbers = Eigen::Map<const Eigen::VectorXd>(numbers.data(), size);
  window.numbers_covariance.resize(size, size);
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t k = 0; k < at.size(); ++k)
      window.numbers_covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          scale[i] * scale[k] * found.covariance(at[i], at[k]);
  drift.windows.push_back(std::move(window));
}

SkyDrift DriftFinder::run() {
  SkyDrift drift;
  drift.layout.cameras = rig_.cameras.size();
  if (!find_mean(drift)) return drift;
  std::size_t asked = 0;
  for (const auto& recording : recordings_) {
    for (std::size_t w = 0; w < options_.windows; ++w) {
      const std::size_t first = recording.size() * w / options_.windows;
      const std::size_t last = recording.size() * (w + 1) / options_.windows;
      ++asked;
      if (last - first >= kLeastSets) add_window(taken(recording, first, last, options_.window_sets), drift);
    }
  }
  drift.done = fit_line(drift);
  if (!drift.done)
    drift.reason = format("%zu of %zu windows have stars enough to fix every camera; two are needed",
                          drift.windows.size(), asked);
  return drift;
}

}  // namespace

double SkyDrift::squared_in_sigmas_of(Eigen::Index at) const {
  const Eigen::Vector3d three = rate.segment<3>(at);
  const Eigen::Index row = rate.size() + at;
  const Eigen::Vector3d sigma = covariance.block<3, 3>(row, row).diagonal().cwiseSqrt();
  const Eigen::Matrix3d correlation = sigma.cwiseInverse().asDiagonal() * covariance.block<3, 3>(row, row) *
                                      sigma.cwiseInverse().asDiagonal();
  const Eigen::Vector3d scaled = three.cwiseQuotient(sigma);
  return scaled.dot(correlation.ldlt().solve(scaled));
}

namespace {

// What may drift in a window, the other numbers given.
void given_the_others(DriftWindow& window, const Eigen::VectorXd& others, Eigen::Index drifting) {
  const Eigen::Index rest = window.numbers.size() - drifting;
  const Eigen::MatrixXd& c = window.numbers_covariance;
  const Eigen::VectorXd unit = c.diagonal().cwiseSqrt();
  const Eigen::MatrixXd scaled =
      unit.cwiseInverse().asDiagonal() * c * unit.cwiseInverse().asDiagonal();  // correlations
  Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(drifting, rest);
  if (rest > 0)
    gain = scaled.bottomRightCorner(rest, rest)
               .ldlt()
               .solve(scaled.bottomLeftCorner(rest, drifting))
               .transpose();
  const Eigen::VectorXd off = (window.numbers.tail(rest) - others).cwiseQuotient(unit.tail(rest));
  window.offset = window.numbers.head(drifting) - unit.head(drifting).cwiseProduct(gain * off);
  window.covariance =
      unit.head(drifting).asDiagonal() *
      (scaled.topLeftCorner(drifting, drifting) - gain * scaled.bottomLeftCorner(rest, drifting)) *
      unit.head(drifting).asDiagonal();
}

}  // namespace

bool fit_line(SkyDrift& drift) {
  if (drift.windows.size() < 2) return false;
  double span = 0;
  drift.middle = 0;
  for (const DriftWindow& w : drift.windows) drift.middle += w.time / double(drift.windows.size());
  for (const DriftWindow& w : drift.windows) span = std::max(span, std::abs(w.time - drift.middle));
  if (!(span > 0)) return false;
  const Eigen::Index all = drift.windows.front().numbers.size();
  const Eigen::Index n = drift.layout.size();
  // Numbers in their own deviations, times in the span: all of one size. Unknown: the numbers in the middle
  // of the time, and how far those that drift have gone at the end of the span.
  Eigen::VectorXd unit(all + n);
  unit.head(all) = drift.windows.front().numbers_covariance.diagonal().cwiseSqrt();
  unit.tail(n) = unit.head(n);
  const Eigen::VectorXd inverse = unit.head(all).cwiseInverse();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(all + n, all + n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(all + n);
  double squares = 0;
  for (const DriftWindow& w : drift.windows) {
    const Eigen::MatrixXd scaled = inverse.asDiagonal() * w.numbers_covariance * inverse.asDiagonal();
    const Eigen::MatrixXd weight = scaled.ldlt().solve(Eigen::MatrixXd::Identity(all, all));
    const Eigen::VectorXd numbers = inverse.cwiseProduct(w.numbers);
    const double t = (w.time - drift.middle) / span;
    information.topLeftCorner(all, all) += weight;
    information.topRightCorner(all, n) += t * weight.leftCols(n);
    information.bottomLeftCorner(n, all) += t * weight.topRows(n);
    information.bottomRightCorner(n, n) += t * t * weight.topLeftCorner(n, n);
    right.head(all) += weight * numbers;
    right.tail(n) += t * (weight * numbers).head(n);
    squares += numbers.dot(weight * numbers);
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(information);
  const Eigen::VectorXd line = factor.solve(right);
  drift.degrees = static_cast<int>(drift.windows.size()) * static_cast<int>(all) - static_cast<int>(all + n);
  drift.scatter = drift.degrees > 0 ? (squares - line.dot(right)) / drift.degrees : 1;
  const Eigen::VectorXd numbers = unit.head(all).cwiseProduct(line.head(all));
  unit.tail(n) /= span;
  drift.offset = numbers.head(n);
  drift.rate = unit.tail(n).cwiseProduct(line.tail(n));
  const Eigen::MatrixXd whole = std::max(1.0, drift.scatter) * unit.asDiagonal() *
                                factor.solve(Eigen::MatrixXd::Identity(all + n, all + n)) * unit.asDiagonal();
  drift.covariance.resize(2 * n, 2 * n);
  drift.covariance << whole.topLeftCorner(n, n), whole.topRightCorner(n, n), whole.bottomLeftCorner(n, n),
      whole.bottomRightCorner(n, n);
  for (DriftWindow& w : drift.windows) given_the_others(w, numbers.tail(all - n), n);
  return line.allFinite() && drift.covariance.allFinite();
}

SkyDrift drift_from_flight(const Rig& rig, const std::vector<std::vector<FlightSet>>& recordings,
                           const DriftOptions& options) {
  return DriftFinder(rig, recordings, options).run();
}

}  // namespace omma::ground
