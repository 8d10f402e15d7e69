#include "ground/calibrate/axis_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ground/calibrate/normal_equations.hpp"
#include "ground/format.hpp"

namespace omma::ground {
namespace {

constexpr int kShared = 10;  // unknowns beside the angles: the axis's four, the first pose's six
constexpr int kIterations = 60;
constexpr int kVariancePasses = 6;
constexpr double kLeastArc = std::numbers::pi / 180;  // a smaller turn has no axis worth telling [rad]
constexpr double kStep = 1e-6;                        // of differences [rad, m]

using Shared = Eigen::Matrix<double, kShared, 1>;

// Each sample sees the shared unknowns and its own angle: the angles are eliminated one by one.
class Fitter {
 public:
  explicit Fitter(const TimedPoses& motion) : motion_(motion), angles_(motion.samples.size(), 0.0) {}
  AxisFit run();

 private:
  struct State {
    Axis axis;
    Pose first;  ///< the platform's at angle zero
  };
  struct Sums {
    NormalEquations reduced;
    std::vector<Shared> coupling;       // of each angle with the shared unknowns
    std::vector<double> own, gradient;  // of each angle alone
  };

  void start(AxisFit& fit);
  Vector6d residual(std::size_t i, const State& state, double angle) const;
  Eigen::Matrix<double, 6, kShared + 1> jacobian(std::size_t i) const;
  Sums sums(const Vector6d& weight) const;
  double cost(const State& state, const std::vector<double>& angles) const;
  State after(const Shared& step) const;
  bool descend();
  void weigh();

  const TimedPoses& motion_;
  State state_;
  std::vector<double> angles_;  // the first stays zero
  Vector6d weight_ = Vector6d::Ones();
};

// Angles from the turns against the first sample, each continued from the one before.
void Fitter::start(AxisFit& fit) {
  fit.circle = circle_axis(motion_, kVirtualPoint);
  state_.axis = fit.circle;
  state_.first = motion_.samples.front().pose;
  for (std::size_t i = 1; i < angles_.size(); ++i) {
    const Eigen::Quaterniond step =
        motion_.samples[i].pose.rotation * motion_.samples[i - 1].pose.rotation.conjugate();
    angles_[i] = angles_[i - 1] + rotation_log(step).dot(state_.axis.direction);
  }
  Vector6d squares = Vector6d::Zero();
  for (std::size_t i = 0; i < angles_.size(); ++i)
    squares += residual(i, state_, angles_[i]).cwiseAbs2() / static_cast<double>(angles_.size());
  weight_ = squares.cwiseMax(1e-18).cwiseInverse();
}

Vector6d Fitter::residual(std::size_t i, const State& state, double angle) const {
  const Eigen::Quaterniond turn = rotation_exp(angle * state.axis.direction);
  const Pose& measured = motion_.samples[i].pose;
  Vector6d residual;
  residual << rotation_log(measured.rotation * (turn * state.first.rotation).conjugate()),
      measured.translation - (turn * (state.first.translation - state.axis.point) + state.axis.point);
  return residual;
}

Fitter::State Fitter::after(const Shared& step) const {
  return {moved(state_.axis, step.head<4>()),
          {(rotation_exp(step.segment<3>(4)) * state_.first.rotation).normalized(),
           state_.first.translation + step.tail<3>()}};
}

// Of the prediction, by central differences; the last column is the sample's own angle.
Eigen::Matrix<double, 6, kShared + 1> Fitter::jacobian(std::size_t i) const {
  Eigen::Matrix<double, 6, kShared + 1> jacobian;
  for (int k = 0; k < kShared; ++k) {
    const Shared step = kStep * Shared::Unit(k);
    jacobian.col(k) =
        (residual(i, after(-step), angles_[i]) - residual(i, after(step), angles_[i])) / (2 * kStep);
  }
  jacobian.col(kShared) =
      (residual(i, state_, angles_[i] - kStep) - residual(i, state_, angles_[i] + kStep)) / (2 * kStep);
  return jacobian;
}

Fitter::Sums Fitter::sums(const Vector6d& weight) const {
  Sums sums{{Eigen::MatrixXd::Zero(kShared, kShared), Eigen::VectorXd::Zero(kShared), 0}, {}, {}, {}};
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const auto j = jacobian(i);
    const auto shared = j.leftCols<kShared>();
    const Vector6d own = j.col(kShared);
    const Vector6d r = residual(i, state_, angles_[i]);
    sums.reduced.information += shared.transpose() * weight.asDiagonal() * shared;
    sums.reduced.gradient += shared.transpose() * weight.cwiseProduct(r);
    sums.reduced.cost += r.dot(weight.cwiseProduct(r));
    sums.coupling.push_back(i == 0 ? Shared::Zero() : Shared(shared.transpose() * weight.cwiseProduct(own)));
    sums.own.push_back(i == 0 ? 1 : own.dot(weight.cwiseProduct(own)));
    sums.gradient.push_back(i == 0 ? 0 : own.dot(weight.cwiseProduct(r)));
  }
  return sums;
}

void eliminate_angles(const std::vector<Shared>& coupling, const std::vector<double>& own,
                      const std::vector<double>& gradient, NormalEquations& reduced) {
  for (std::size_t i = 0; i < own.size(); ++i) {
    reduced.information -= coupling[i] * coupling[i].transpose() / own[i];
    reduced.gradient -= coupling[i] * gradient[i] / own[i];
  }
}

double Fitter::cost(const State& state, const std::vector<double>& angles) const {
  double cost = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Vector6d r = residual(i, state, angles[i]);
    cost += r.dot(weight_.cwiseProduct(r));
  }
  return cost;
}

bool Fitter::descend() {
  double damping = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Sums here = sums(weight_);
    const double before = here.reduced.cost;
    eliminate_angles(here.coupling, here.own, here.gradient, here.reduced);
    Eigen::VectorXd step;
    if (!solve_scaled(here.reduced, damping, step, nullptr)) return false;
    const State next = after(step);
    std::vector<double> angles = angles_;
    for (std::size_t i = 1; i < angles.size(); ++i)
      angles[i] += (here.gradient[i] - here.coupling[i].dot(step)) / here.own[i];
    const double then = cost(next, angles);
    if (!(then <= before * (1 + 1e-9) + 1e-9)) {
      damping = damping > 0 ? 10 * damping : 1e-6;
      if (damping > 1e3) return false;
      continue;
    }
    state_ = next;
    angles_ = angles;
    damping = damping > 1e-9 ? 0.1 * damping : 0;
    if (before - then <= 1e-9 * before + 1e-9 && damping == 0) return true;
  }
  return false;
}

// The variance of each of a pose's six numbers: its residuals' squares over what the fit leaves them free,
// n less the trace of (whole information)⁻¹ (information of that number alone).
void Fitter::weigh() {
  Sums whole = sums(weight_);
  eliminate_angles(whole.coupling, whole.own, whole.gradient, whole.reduced);
  Eigen::VectorXd unused;
  Eigen::MatrixXd covariance;
  if (!solve_scaled(whole.reduced, 0, unused, &covariance)) return;
  Vector6d next = weight_;
  for (int k = 0; k < 6; ++k) {
    const Sums one = sums(weight_[k] * Vector6d::Unit(k));
    double taken = (covariance * one.reduced.information).trace();
    double squares = 0;
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      const double r = residual(i, state_, angles_[i])[k];
      squares += r * r;
      if (i == 0) continue;
      const Shared across = covariance * whole.coupling[i] / whole.own[i];
      taken += -2 * across.dot(one.coupling[i]) +
               (1 / whole.own[i] + whole.coupling[i].dot(across) / whole.own[i]) * one.own[i];
    }
    const double left = static_cast<double>(angles_.size()) - taken;
    if (left > 0.5) next[k] = 1 / std::max(1e-18, squares / left);
  }
  weight_ = next;
}

AxisFit Fitter::run() {
  AxisFit fit;
  start(fit);
  const auto [low, high] = std::minmax_element(angles_.begin(), angles_.end());
  fit.arc = *high - *low;
  if (!(fit.arc >= kLeastArc)) {
    fit.reason = "turns by " + format("%.2f", fit.arc / kLeastArc) + " degrees: too little for an axis";
    return fit;
  }
  for (int pass = 0; pass < kVariancePasses; ++pass) {
    if (!descend()) {
      fit.reason = "its poses fit no axis";
      return fit;
    }
    weigh();
  }
  Sums last = sums(weight_);
  eliminate_angles(last.coupling, last.own, last.gradient, last.reduced);
  Eigen::VectorXd unused;
  Eigen::MatrixXd covariance;
  fit.found = descend() && solve_scaled(last.reduced, 0, unused, &covariance);
  if (!fit.found) {
    fit.reason = "its poses fit no axis";
    return fit;
  }
  // The point told is the line's nearest to the platform: there it is known best, and shims are put there.
  const Axis& found = state_.axis;
  const double along = found.direction.dot(state_.first.translation - found.point);
  Eigen::Matrix4d slide = Eigen::Matrix4d::Identity();
  slide.block<2, 2>(2, 0) = along * Eigen::Matrix2d::Identity();
  fit.axis = {found.direction, found.point + along * found.direction};
  fit.covariance = slide * covariance.topLeftCorner<4, 4>() * slide.transpose();
  fit.angles = angles_;
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    fit.times.push_back(motion_.samples[i].time);
    fit.residuals.push_back(residual(i, state_, angles_[i]));
    fit.rms += fit.residuals.back().cwiseAbs2() / static_cast<double>(angles_.size());
  }
  fit.rms = fit.rms.cwiseSqrt();
  fit.sigma = weight_.cwiseInverse().cwiseSqrt();
  return fit;
}

}  // namespace

Axis moved(const Axis& axis, const Eigen::Vector4d& step) {
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(axis.direction);
  return {(axis.direction + basis * step.head<2>()).normalized(), axis.point + basis * step.tail<2>()};
}

AxisFit fit_axis(const TimedPoses& motion) {
  if (motion.samples.size() < 6) {
    AxisFit fit;
    fit.reason = std::to_string(motion.samples.size()) + " poses: at least six make an axis";
    return fit;
  }
  return Fitter(motion).run();
}

}  // namespace omma::ground
