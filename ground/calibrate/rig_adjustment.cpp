#include "ground/calibrate/rig_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "ground/calibrate/normal_equations.hpp"

namespace omma::ground {
namespace {

constexpr int kMostIterations = 60;
constexpr int kCullPasses = 6;
constexpr double kNegligible = 1e-10;  // squared step in standard deviations
constexpr double kLeastFloor = 1e-3;   // [px]
constexpr double kLargestFloor = 20;
constexpr double kUnseen = 1e4;  // residual of a target that the lens can not see [px]

using Jacobian = Eigen::Matrix<double, 2, 6>;

Pose moved(const Pose& pose, const Vector6d& step) {
  return {(rotation_exp(step.head<3>()) * pose.rotation).normalized(), pose.translation + step.tail<3>()};
}

class Adjuster {
 public:
  Adjuster(const Rig& lenses, const RigGeometry& start, const std::vector<TargetSight>& sights,
           const RigAdjustmentOptions& options)
      : lenses_(lenses),
        sights_(sights),
        options_(options),
        geometry_(start),
        used_(sights.size(), 1),
        first_body_(6 * (static_cast<Eigen::Index>(start.rig_from_camera.size()) - 1)),
        first_set_(first_body_ + 6 * (static_cast<Eigen::Index>(start.room_from_body.size()) - 1)),
        size_(first_set_ + 6 * static_cast<Eigen::Index>(start.rig_from_room.size())) {}

  RigAdjustment run();

 private:
  // Where an unknown pose stands; −1: held.
  Eigen::Index camera_at(int c) const { return c == 0 ? -1 : 6 * (c - 1); }
  Eigen::Index body_at(int b) const { return b == 0 ? -1 : first_body_ + 6 * (b - 1); }
  Eigen::Index set_at(int s) const { return first_set_ + 6 * s; }
  Eigen::Matrix2d weight(const TargetSight& sight) const {
    return (sight.covariance + floor_ * floor_ * Eigen::Matrix2d::Identity()).inverse();
  }
  void residuals_of(const RigGeometry& geometry, std::vector<Eigen::Vector2d>& residuals) const;
  double cost_of(const std::vector<Eigen::Vector2d>& residuals) const;
  NormalEquations sums() const;
  void add(const TargetSight& sight, NormalEquations& sums) const;
  RigGeometry after(const Eigen::VectorXd& step) const;
  bool descend(RigAdjustment& result);
  void find_floor(const std::vector<Eigen::Vector2d>& residuals);
  bool cull(const std::vector<Eigen::Vector2d>& residuals);
  double count_used() const { return double(std::count(used_.begin(), used_.end(), 1)); }

  const Rig& lenses_;
  const std::vector<TargetSight>& sights_;
  RigAdjustmentOptions options_;
  RigGeometry geometry_;
  std::vector<std::uint8_t> used_;
  Eigen::Index first_body_, first_set_, size_;
  double floor_ = 0;
};

void Adjuster::residuals_of(const RigGeometry& g, std::vector<Eigen::Vector2d>& residuals) const {
  residuals.clear();
  for (const TargetSight& s : sights_) {
    const auto camera = static_cast<std::size_t>(s.camera);
    const Eigen::Vector3d in_rig = g.rig_from_room[static_cast<std::size_t>(s.set)] *
                                   (g.room_from_body[static_cast<std::size_t>(s.body)] * s.point);
    Eigen::Vector2d pixel = Eigen::Vector2d::Constant(-kUnseen);
    lenses_.cameras[camera].lens.project(g.rig_from_camera[camera].inverse() * in_rig, pixel);
    residuals.emplace_back(s.pixel - pixel);
  }
}

double Adjuster::cost_of(const std::vector<Eigen::Vector2d>& residuals) const {
  double cost = 0;
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    if (used_[i] != 0) cost += residuals[i].dot(weight(sights_[i]) * residuals[i]);
  }
  return cost;
}

// Camera point R_rcᵀ (p − t_rc), p = R_rr q + t_rr in the rig, q = R_b g + t_b in the room; each pose moves
// as exp(θ) R, t + δ.
void Adjuster::add(const TargetSight& s, NormalEquations& sums) const {
  const auto c = static_cast<std::size_t>(s.camera);
  const Pose& body = geometry_.room_from_body[static_cast<std::size_t>(s.body)];
  const Pose& set = geometry_.rig_from_room[static_cast<std::size_t>(s.set)];
  const Pose& camera = geometry_.rig_from_camera[c];
  const Eigen::Vector3d q = body * s.point;
  const Eigen::Vector3d p = set * q;
  const Eigen::Matrix3d camera_from_rig = camera.rotation.conjugate().toRotationMatrix();
  Eigen::Vector2d pixel = Eigen::Vector2d::Constant(-kUnseen);
  Eigen::Matrix<double, 2, 3> by_camera = Eigen::Matrix<double, 2, 3>::Zero();
  lenses_.cameras[c].lens.project(camera_from_rig * (p - camera.translation), pixel, by_camera);
  const Eigen::Matrix<double, 2, 3> by_rig = by_camera * camera_from_rig;
  const Eigen::Matrix<double, 2, 3> by_room = by_rig * set.rotation.toRotationMatrix();
  Jacobian jacobians[3];
  jacobians[0] << by_rig * skew(p - camera.translation), -by_rig;
  jacobians[1] << -by_room * skew(body.rotation * s.point), by_room;
  jacobians[2] << -by_rig * skew(set.rotation * q), by_rig;
  const Eigen::Index at[3] = {camera_at(s.camera), body_at(s.body), set_at(s.set)};
  const Eigen::Vector2d residual = s.pixel - pixel;
  const Eigen::Matrix2d w = weight(s);
  sums.cost += residual.dot(w * residual);
  for (int a = 0; a < 3; ++a) {
    if (at[a] < 0) continue;
    sums.gradient.segment<6>(at[a]) += jacobians[a].transpose() * w * residual;
    for (int b = 0; b < 3; ++b) {
      if (at[b] >= 0)
        sums.information.block<6, 6>(at[a], at[b]) += jacobians[a].transpose() * w * jacobians[b];
    }
  }
}

NormalEquations Adjuster::sums() const {
  NormalEquations sums{Eigen::MatrixXd::Zero(size_, size_), Eigen::VectorXd::Zero(size_), 0};
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    if (used_[i] != 0) add(sights_[i], sums);
  }
  return sums;
}

RigGeometry Adjuster::after(const Eigen::VectorXd& step) const {
  RigGeometry next = geometry_;
  for (std::size_t c = 1; c < next.rig_from_camera.size(); ++c)
    next.rig_from_camera[c] = moved(next.rig_from_camera[c], step.segment<6>(camera_at(int(c))));
  for (std::size_t b = 1; b < next.room_from_body.size(); ++b)
    next.room_from_body[b] = moved(next.room_from_body[b], step.segment<6>(body_at(int(b))));
  for (std::size_t s = 0; s < next.rig_from_room.size(); ++s)
    next.rig_from_room[s] = moved(next.rig_from_room[s], step.segment<6>(set_at(int(s))));
  return next;
}

bool Adjuster::descend(RigAdjustment& result) {
  NormalEquations here = sums();
  double damping = 0;
  result.converged = false;
  for (int iteration = 0; iteration < kMostIterations && !result.converged; ++iteration) {
    Eigen::VectorXd step;
    if (!solve_scaled(here, damping, step, nullptr)) {
      if (damping > 1) return false;
      damping = damping > 0 ? 10 * damping : 1e-6;
      continue;
    }
    const bool small = step.dot(here.information * step) < kNegligible;
    const RigGeometry next = after(step);
    std::vector<Eigen::Vector2d> residuals;
    residuals_of(next, residuals);
    if (cost_of(residuals) <= here.cost * (1 + 1e-12)) {
      geometry_ = next;
      here = sums();
      damping = damping > 1e-7 ? 0.1 * damping : 0;
      result.converged = small && damping == 0;
    } else {
      result.converged = small;
      damping = damping > 0 ? 8 * damping : 1e-5;
    }
  }
  result.chi2 = here.cost;
  Eigen::VectorXd unused;
  return solve_scaled(here, 0, unused, &result.covariance);
}

// The standard deviation per axis that, added to the dots' own, makes the residuals as large as they are.
void Adjuster::find_floor(const std::vector<Eigen::Vector2d>& residuals) {
  const double target = std::max(1.0, 2 * count_used() - double(size_));
  double low = kLeastFloor;
  double high = kLargestFloor;
  for (int halving = 0; halving < 40; ++halving) {
    floor_ = std::sqrt(low * high);
    (cost_of(residuals) > target ? low : high) = floor_;
  }
}

bool Adjuster::cull(const std::vector<Eigen::Vector2d>& residuals) {
  bool changed = false;
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const double squared = residuals[i].dot(weight(sights_[i]) * residuals[i]);
    const std::uint8_t used = squared <= options_.gate * options_.gate ? 1 : 0;
    changed = changed || used != used_[i];
    used_[i] = used;
  }
  return changed;
}

RigAdjustment Adjuster::run() {
  RigAdjustment result;
  floor_ = options_.find_floor ? 0.5 : 0;
  for (int pass = 0; pass < kCullPasses; ++pass) {
    if (!descend(result)) {
      result.converged = false;
      return result;
    }
    residuals_of(geometry_, result.residuals);
    const double before = floor_;
    if (options_.find_floor) find_floor(result.residuals);
    const bool changed = cull(result.residuals);
    if (!changed && std::abs(floor_ - before) <= 1e-3 * before) break;
  }
  result.geometry = geometry_;
  result.floor_px = floor_;
  result.used = used_;
  double sum = 0;
  for (std::size_t i = 0; i < used_.size(); ++i) sum += used_[i] != 0 ? result.residuals[i].squaredNorm() : 0;
  result.rms_px = std::sqrt(sum / std::max(1.0, count_used()));
  result.degrees = static_cast<int>(2 * count_used()) - static_cast<int>(size_);
  return result;
}

}  // namespace

RigAdjustment adjust_rig(const Rig& lenses, const RigGeometry& start, const std::vector<TargetSight>& sights,
                         const RigAdjustmentOptions& options) {
  return Adjuster(lenses, start, sights, options).run();
}

}  // namespace omma::ground
