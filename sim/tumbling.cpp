#include "sim/tumbling.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omma::sim {
namespace {

constexpr double kStepAngle = 0.01;  // [rad]
constexpr int kStride = 16;          // steps between two nodes

/// The largest rate that the body can come to: its energy in the smallest moment [rad/s].
double fastest(const Eigen::Vector3d& rate, const Eigen::Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(inertia);
  return std::sqrt(rate.dot(inertia * rate) / moments.eigenvalues()[0]);
}

struct Slope {
  Eigen::Vector4d rotation;
  Eigen::Vector3d rate;
};

}  // namespace

bool is_inertia(const Eigen::Matrix3d& inertia) {
  const double scale = inertia.cwiseAbs().maxCoeff();
  if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * scale)) return false;
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  return moments[0] > 0 && moments[2] <= (moments[0] + moments[1]) * (1 + 1e-9);
}

double Tumbling::steps(const Eigen::Vector3d& rate, const Eigen::Matrix3d& inertia, double duration) {
  return std::max(0.0, duration) * fastest(rate, inertia) / kStepAngle;
}

Tumbling::Tumbling(const State& start, const Eigen::Matrix3d& inertia, double duration)
    : inertia_(inertia), inverse_(inertia.inverse()) {
  step_ = kStepAngle / std::max(fastest(start.rate, inertia), 1e-6);
  const double node = kStride * step_;
  nodes_.push_back(start);
  while (static_cast<double>(nodes_.size()) * node < duration) {
    const State last = nodes_.back();
    nodes_.push_back(advance(last, node));
  }
}

Tumbling::State Tumbling::at(double time) const {
  const double node = kStride * step_;
  const double before = std::clamp(std::floor(time / node), 0.0, static_cast<double>(nodes_.size() - 1));
  return advance(nodes_[static_cast<std::size_t>(before)], time - before * node);
}

Tumbling::State Tumbling::advance(const State& state, double time) const {
  const auto count = std::max(1LL, std::llround(std::ceil(std::abs(time) / step_)));
  State now = state;
  for (long long k = 0; k < count; ++k) now = one_step(now, time / static_cast<double>(count));
  return now;
}

Tumbling::State Tumbling::one_step(const State& state, double step) const {
  const auto slope = [&](const Eigen::Vector4d& q, const Eigen::Vector3d& w) {
    // I ẇ = −w × I w;  q̇ = q (w, 0) / 2
    const Eigen::Quaterniond turned = Eigen::Quaterniond(q) * Eigen::Quaterniond(0, w.x(), w.y(), w.z());
    return Slope{0.5 * turned.coeffs(), inverse_ * -w.cross(inertia_ * w)};
  };
  const Eigen::Vector4d q = state.rotation.coeffs();
  const Eigen::Vector3d& w = state.rate;
  const Slope a = slope(q, w);
  const Slope b = slope(q + 0.5 * step * a.rotation, w + 0.5 * step * a.rate);
  const Slope c = slope(q + 0.5 * step * b.rotation, w + 0.5 * step * b.rate);
  const Slope d = slope(q + step * c.rotation, w + step * c.rate);
  State next;
  next.rotation = Eigen::Quaterniond(
      Eigen::Vector4d(q + step / 6 * (a.rotation + 2 * b.rotation + 2 * c.rotation + d.rotation)));
  next.rotation.normalize();
  next.rate = w + step / 6 * (a.rate + 2 * b.rate + 2 * c.rate + d.rate);
  return next;
}

}  // namespace omma::sim
