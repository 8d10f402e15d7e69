#include "ground/calibrate/sky_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "components/geometry/pose.hpp"
#include "ground/calibrate/normal_equations.hpp"

namespace omma::ground {
namespace {

constexpr int kMostIterations = 60;
constexpr int kCullPasses = 6;
constexpr double kNegligible = 1e-8;  // squared step in standard deviations
constexpr double kLeastFloor = 1e-3;  // [px]
constexpr double kLargestFloor = 20;

// Where each unknown is in the vector of all.
struct Layout {
  explicit Layout(const SkyRig& rig) {
    for (const LensShape& shape : rig.lenses) {
      lens.push_back(size);
      size += static_cast<int>(shape.parameters.size());
    }
    for (std::size_t c = 0; c < rig.camera_from_rig.size(); ++c) {
      camera.push_back(c == 0 ? -1 : size);
      if (c > 0) size += 3;
    }
    for (std::size_t f = 0; f < rig.rig_from_j2000.size(); ++f) {
      frame.push_back(size);
      size += 3;
    }
  }
  std::vector<int> lens;
  std::vector<int> camera;
  std::vector<int> frame;
  int size = 0;
};

// Which unknowns are held: radial numbers beyond those asked for, aspect and skew.
std::vector<bool> held_unknowns(const SkyRig& rig, const Layout& layout, const AdjustmentOptions& options) {
  std::vector<bool> held(static_cast<std::size_t>(layout.size), false);
  for (std::size_t c = 0; c < rig.lenses.size(); ++c) {
    const bool ocam = rig.lenses[c].model == LensModel::kOcam;
    const auto count = static_cast<int>(rig.lenses[c].parameters.size());
    for (int k = 0; k < count; ++k) {
      const bool aspect = ocam ? k == 2 || k == 3 : k == 3;
      const int radial = ocam ? k - 4 : (k == 2 ? 0 : k - 3);
      const bool is_radial = k >= 2 && !aspect;
      held[static_cast<std::size_t>(layout.lens[c]) + static_cast<std::size_t>(k)] =
          (aspect && !options.free_aspect) || (is_radial && radial >= options.free_radial);
    }
  }
  return held;
}

class Adjuster {
 public:
  Adjuster(const SkyRig& start, const std::vector<StarSight>& sights, const AdjustmentOptions& options)
      : sights_(sights),
        options_(options),
        layout_(start),
        held_(held_unknowns(start, layout_, options)),
        used_(sights.size(), 1),
        rig_(start) {}

  SkyAdjustment run();

 private:
  bool lenses_of(const SkyRig& rig, std::vector<Lens>& lenses) const;
  bool residuals_of(const SkyRig& rig, std::vector<Eigen::Vector2d>& residuals) const;
  bool equations_at(const SkyRig& rig, double floor, NormalEquations& sums) const;
  double cost_of(const std::vector<Eigen::Vector2d>& residuals, double floor) const;
  SkyRig moved(const SkyRig& rig, const Eigen::VectorXd& step) const;
  bool descend(double floor, SkyAdjustment& result);
  double floor_of(const std::vector<Eigen::Vector2d>& residuals) const;
  bool cull(const std::vector<Eigen::Vector2d>& residuals, double floor);

  Eigen::Matrix2d weight(const StarSight& sight, double floor) const {
    return (sight.covariance + floor * floor * Eigen::Matrix2d::Identity()).inverse();
  }

  const std::vector<StarSight>& sights_;
  AdjustmentOptions options_;
  Layout layout_;
  std::vector<bool> held_;
  std::vector<std::uint8_t> used_;
  SkyRig rig_;
};

bool Adjuster::lenses_of(const SkyRig& rig, std::vector<Lens>& lenses) const {
  lenses.clear();
  for (const LensShape& shape : rig.lenses) {
    const std::optional<Lens> lens = shape.lens();
    if (!lens) return false;
    lenses.push_back(*lens);
  }
  return true;
}

// Directions beyond the lens's end get an infinite residual: a step that pushes a star out is refused.
bool Adjuster::residuals_of(const SkyRig& rig, std::vector<Eigen::Vector2d>& residuals) const {
  std::vector<Lens> lenses;
  if (!lenses_of(rig, lenses)) return false;
  residuals.assign(sights_.size(), Eigen::Vector2d::Constant(1e6));
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const StarSight& s = sights_[i];
    const auto c = static_cast<std::size_t>(s.camera);
    const Eigen::Vector3d direction =
        rig.camera_from_rig[c] * (rig.rig_from_j2000[static_cast<std::size_t>(s.frame)] * s.star);
    Eigen::Vector2d pixel = Eigen::Vector2d::Constant(-1e6);
    lenses[c].project(direction, pixel);
    residuals[i] = s.pixel - pixel;
  }
  return true;
}

double Adjuster::cost_of(const std::vector<Eigen::Vector2d>& residuals, double floor) const {
  double cost = 0;
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    if (used_[i] != 0) cost += residuals[i].dot(weight(sights_[i], floor) * residuals[i]);
  }
  return cost;
}

bool Adjuster::equations_at(const SkyRig& rig, double floor, NormalEquations& sums) const {
  std::vector<Lens> lenses;
  if (!lenses_of(rig, lenses)) return false;
  // Lenses with one number moved up and down, for the derivatives by it.
  std::vector<std::vector<std::pair<Lens, Lens>>> moved_lenses(rig.lenses.size());
  std::vector<Eigen::VectorXd> steps;
  for (std::size_t c = 0; c < rig.lenses.size(); ++c) {
    steps.push_back(rig.lenses[c].steps());
    for (Eigen::Index k = 0; k < steps[c].size(); ++k) {
      LensShape up = rig.lenses[c];
      LensShape down = up;
      up.parameters[k] += steps[c][k];
      down.parameters[k] -= steps[c][k];
      moved_lenses[c].emplace_back(up.lens().value_or(lenses[c]), down.lens().value_or(lenses[c]));
    }
  }
  sums.information = Eigen::MatrixXd::Zero(layout_.size, layout_.size);
  sums.gradient = Eigen::VectorXd::Zero(layout_.size);
  sums.cost = 0;
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    if (used_[i] == 0) continue;
    const StarSight& s = sights_[i];
    const auto c = static_cast<std::size_t>(s.camera);
    const Eigen::Matrix3d camera_from_rig = rig.camera_from_rig[c].toRotationMatrix();
    const Eigen::Vector3d in_rig = rig.rig_from_j2000[static_cast<std::size_t>(s.frame)] * s.star;
    const Eigen::Vector3d direction = camera_from_rig * in_rig;
    Eigen::Vector2d pixel = Eigen::Vector2d::Constant(-1e6);
    Eigen::Matrix<double, 2, 3> by_direction = Eigen::Matrix<double, 2, 3>::Zero();
    lenses[c].project(direction, pixel, by_direction);
    const auto lens_size = static_cast<int>(steps[c].size());
    // Columns of this sight: lens, camera, frame; and where they stand among all.
    Eigen::MatrixXd jacobian(2, lens_size + 6);
    std::vector<int> at;
    for (int k = 0; k < lens_size; ++k) {
      Eigen::Vector2d up = pixel;
      Eigen::Vector2d down = pixel;
      moved_lenses[c][static_cast<std::size_t>(k)].first.project(direction, up);
      moved_lenses[c][static_cast<std::size_t>(k)].second.project(direction, down);
      jacobian.col(k) = (up - down) / (2 * steps[c][k]);
      at.push_back(layout_.lens[c] + k);
    }
    jacobian.middleCols<3>(lens_size) = -by_direction * skew(direction);
    jacobian.rightCols<3>() = -by_direction * camera_from_rig * skew(in_rig);
    for (int k = 0; k < 3; ++k) at.push_back(layout_.camera[c] < 0 ? -1 : layout_.camera[c] + k);
    for (int k = 0; k < 3; ++k) at.push_back(layout_.frame[static_cast<std::size_t>(s.frame)] + k);
    const Eigen::Vector2d residual = s.pixel - pixel;
    const Eigen::Matrix2d w = weight(s, floor);
    sums.cost += residual.dot(w * residual);
    for (int a = 0; a < jacobian.cols(); ++a) {
      const int row = at[static_cast<std::size_t>(a)];
      if (row < 0 || held_[static_cast<std::size_t>(row)]) continue;
      const Eigen::Vector2d weighted = w * jacobian.col(a);
      sums.gradient[row] += weighted.dot(residual);
      for (int b = 0; b < jacobian.cols(); ++b) {
        const int column = at[static_cast<std::size_t>(b)];
        if (column >= 0 && !held_[static_cast<std::size_t>(column)])
          sums.information(row, column) += weighted.dot(jacobian.col(b));
      }
    }
  }
  for (int k = 0; k < layout_.size; ++k) {
    if (held_[static_cast<std::size_t>(k)]) sums.information(k, k) = 1;
  }
  return true;
}

SkyRig Adjuster::moved(const SkyRig& rig, const Eigen::VectorXd& step) const {
  SkyRig next = rig;
  for (std::size_t c = 0; c < rig.lenses.size(); ++c) {
    next.lenses[c].parameters += step.segment(layout_.lens[c], rig.lenses[c].parameters.size());
    if (layout_.camera[c] >= 0) {
      next.camera_from_rig[c] =
          (rotation_exp(step.segment<3>(layout_.camera[c])) * rig.camera_from_rig[c]).normalized();
    }
  }
  for (std::size_t f = 0; f < rig.rig_from_j2000.size(); ++f) {
    next.rig_from_j2000[f] =
        (rotation_exp(step.segment<3>(layout_.frame[f])) * rig.rig_from_j2000[f]).normalized();
  }
  return next;
}

bool Adjuster::descend(double floor, SkyAdjustment& result) {
  NormalEquations here;
  if (!equations_at(rig_, floor, here)) return false;
  double damping = 0;
  result.converged = false;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    ++result.iterations;
    Eigen::VectorXd step;
    if (!solve_scaled(here, damping, step, nullptr)) {
      if (damping > 1) return false;
      damping = damping > 0 ? 10 * damping : 1e-6;
      continue;
    }
    const double promised = step.dot(here.information * step);
    const SkyRig next = moved(rig_, step);
    std::vector<Eigen::Vector2d> residuals;
    const bool possible = residuals_of(next, residuals);
    if (possible && cost_of(residuals, floor) <= here.cost * (1 + 1e-12)) {
      rig_ = next;
      if (!equations_at(rig_, floor, here)) return false;
      damping = damping > 1e-7 ? 0.1 * damping : 0;
      if (damping == 0 && promised < kNegligible) {
        result.converged = true;
        break;
      }
    } else {
      if (promised < kNegligible) {
        result.converged = true;
        break;
      }
      damping = damping > 0 ? 8 * damping : 1e-5;
      if (damping > 1e6) break;
    }
  }
  result.chi2 = here.cost;
  Eigen::VectorXd unused;
  return solve_scaled(here, 0, unused, &result.covariance);
}

// The standard deviation per axis that, added to the dots' own, makes the residuals as large as they are.
double Adjuster::floor_of(const std::vector<Eigen::Vector2d>& residuals) const {
  double count = 0;
  for (const std::uint8_t used : used_) count += used != 0 ? 1 : 0;
  int unknowns = layout_.size - static_cast<int>(std::count(held_.begin(), held_.end(), true));
  const double target = std::max(1.0, 2 * count - unknowns);
  double low = kLeastFloor;
  double high = kLargestFloor;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = std::sqrt(low * high);
    (cost_of(residuals, middle) > target ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

bool Adjuster::cull(const std::vector<Eigen::Vector2d>& residuals, double floor) {
  bool changed = false;
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const double squared = residuals[i].dot(weight(sights_[i], floor) * residuals[i]);
    const std::uint8_t used = squared <= options_.gate * options_.gate ? 1 : 0;
    changed = changed || used != used_[i];
    used_[i] = used;
  }
  return changed;
}

SkyAdjustment Adjuster::run() {
  SkyAdjustment result;
  double floor = 0.5;
  for (int pass = 0; pass < kCullPasses; ++pass) {
    if (!descend(floor, result)) {
      result.converged = false;
      break;
    }
    if (!residuals_of(rig_, result.residuals)) break;
    const double before = floor;
    floor = floor_of(result.residuals);
    const bool changed = cull(result.residuals, floor);
    if (!changed && std::abs(floor - before) < 1e-3 * before) break;
  }
  result.rig = rig_;
  result.floor_px = floor;
  result.used = used_;
  result.residuals.resize(sights_.size(), Eigen::Vector2d::Zero());
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i] == 0) continue;
    sum += result.residuals[i].squaredNorm();
    ++count;
  }
  result.rms_px = count > 0 ? std::sqrt(sum / count) : 0;
  result.degrees =
      2 * count - (layout_.size - static_cast<int>(std::count(held_.begin(), held_.end(), true)));
  if (result.covariance.rows() == layout_.size) {
    for (int k = 0; k < layout_.size; ++k) {
      if (!held_[static_cast<std::size_t>(k)]) continue;
      result.covariance.row(k).setZero();
      result.covariance.col(k).setZero();
    }
  }
  return result;
}

}  // namespace

int SkyAdjustment::lens_offset(std::size_t camera) const {
  return Layout(rig).lens[camera];
}

SkyAdjustment adjust_to_sky(const SkyRig& start, const std::vector<StarSight>& sights,
                            const AdjustmentOptions& options) {
  return Adjuster(start, sights, options).run();
}

}  // namespace omma::ground
