#include "ground/compare_motion/motion_match.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/calibrate/normal_equations.hpp"
#include "ground/compare_motion/earth_fixed.hpp"

namespace omma::ground {
namespace {

constexpr int kIterations = 60;
constexpr int kStarts = 24;        // attitudes of the right transform tried
constexpr int kOffsetSteps = 160;  // of the coarse search for the offset, either way

// rig_from_j2000(t) turn(ω t) is at rest where the rig is (stationary_rig).
std::vector<TimedPose> derotated(std::vector<TimedPose> samples) {
  for (TimedPose& s : samples) s.pose.rotation = s.pose.rotation * rotation_exp({0, 0, kEarthRate * s.time});
  return samples;
}

struct Guess {
  Pose left;
  Pose right;
  double offset = 0;
};

Pose moved(const Pose& pose, const Vector6d& step) {
  return {(rotation_exp(step.head<3>()) * pose.rotation).normalized(), pose.translation + step.tail<3>()};
}

class Matcher {
 public:
  Matcher(const TimedPoses& a, const TimedPoses& b, const MatchOptions& options)
      : options_(options), rotations_(a.rotations || b.rotations) {
    a_ = options.derotate_measured ? derotated(a.samples) : a.samples;
    b_ = options.derotate_truth ? derotated(b.samples) : b.samples;
    if (options.invert)
      for (TimedPose& s : b_) s.pose = s.pose.inverse();
    const bool left = options.align == Align::kLeft || options.align == Align::kBoth;
    const bool right = options.align == Align::kRight || options.align == Align::kBoth;
    const int each = rotations_ ? 3 : 6;
    left_at_ = left ? 0 : -1;
    right_at_ = right ? (left ? each : 0) : -1;
    size_ = (left ? each : 0) + (right ? each : 0);
    offset_at_ = options.find_offset ? size_++ : -1;
  }

  MotionMatch run();

 private:
  bool residual(const TimedPose& a, const Guess& g, Vector6d& residual) const;
  bool jacobian_at(const TimedPose& a, const Guess& g, const Vector6d& here, Eigen::MatrixXd& jacobian) const;
  std::vector<MatchPoint> residuals(const Guess& g) const;
  double cost(const Guess& g) const;
  Guess moved_by(const Guess& g, const Eigen::VectorXd& step) const;
  bool sums_at(const Guess& g, NormalEquations& sums) const;
  bool descend(Guess& g, NormalEquations& sums) const;
  double coarse_offset() const;
  std::vector<Guess> starts(double offset) const;

  Vector6d weight() const {
    Vector6d w = Vector6d::Ones();
    if (rotations_) w.tail<3>().setZero();
    return w.cwiseProduct(scale_);
  }
  Vector6d part(const Eigen::VectorXd& x, int at) const {
    Vector6d v = Vector6d::Zero();
    if (at >= 0) v.head(rotations_ ? 3 : 6) = x.segment(at, rotations_ ? 3 : 6);
    return v;
  }

  MatchOptions options_;
  bool rotations_;
  std::vector<TimedPose> a_, b_;
  int left_at_, right_at_, offset_at_, size_;
  Vector6d scale_ = Vector6d::Ones();  // inverse variance of the residuals of each axis
};

Vector6d rms_of(const std::vector<MatchPoint>& points) {
  Vector6d squares = Vector6d::Zero();
  for (const MatchPoint& p : points) squares += p.residual.cwiseAbs2();
  return (squares / std::max<double>(1, double(points.size()))).cwiseSqrt();
}

// False where B's time does not reach.
bool Matcher::residual(const TimedPose& a, const Guess& g, Vector6d& residual) const {
  Pose b;
  if (!pose_at(b_, a.time + g.offset, b)) return false;
  const Pose expected = g.left * b * g.right;
  residual.setZero();
  residual.head<3>() = rotation_log(a.pose.rotation * expected.rotation.conjugate());
  if (!rotations_) residual.tail<3>() = a.pose.translation - expected.translation;
  return true;
}

std::vector<MatchPoint> Matcher::residuals(const Guess& g) const {
  std::vector<MatchPoint> points;
  for (const TimedPose& a : a_) {
    MatchPoint point{a.time, Vector6d::Zero()};
    if (residual(a, g, point.residual)) points.push_back(point);
  }
  return points;
}

double Matcher::cost(const Guess& g) const {
  const std::vector<MatchPoint> points = residuals(g);
  if (points.size() < 3) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const MatchPoint& p : points) sum += p.residual.dot(weight().cwiseProduct(p.residual));
  return sum / double(points.size());
}

Guess Matcher::moved_by(const Guess& g, const Eigen::VectorXd& step) const {
  return {moved(g.left, part(step, left_at_)), moved(g.right, part(step, right_at_)),
          g.offset + (offset_at_ >= 0 ? step[offset_at_] : 0)};
}

// Derivatives by differences: a handful of unknowns, once. False where a step leaves B's time.
bool Matcher::jacobian_at(const TimedPose& a, const Guess& g, const Vector6d& here,
                          Eigen::MatrixXd& jacobian) const {
  constexpr double kStep = 1e-6;
  jacobian.resize(6, size_);
  for (int k = 0; k < size_; ++k) {
    Vector6d ahead;
    if (!residual(a, moved_by(g, kStep * Eigen::VectorXd::Unit(size_, k)), ahead)) return false;
    jacobian.col(k) = (here - ahead) / kStep;
  }
  return true;
}

bool Matcher::sums_at(const Guess& g, NormalEquations& sums) const {
  sums = {Eigen::MatrixXd::Zero(size_, size_), Eigen::VectorXd::Zero(size_), 0};
  int count = 0;
  for (const TimedPose& a : a_) {
    Vector6d here;
    Eigen::MatrixXd jacobian;
    if (!residual(a, g, here) || !jacobian_at(a, g, here, jacobian)) continue;
    sums.information += jacobian.transpose() * weight().asDiagonal() * jacobian;
    sums.gradient += jacobian.transpose() * weight().cwiseProduct(here);
    sums.cost += here.dot(weight().cwiseProduct(here));
    ++count;
  }
  return count >= 3;
}

bool Matcher::descend(Guess& g, NormalEquations& sums) const {
  double damping = 1e-6;
  double now = cost(g);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (!sums_at(g, sums)) return false;
    Eigen::VectorXd step;
    if (!solve_scaled(sums, damping, step, nullptr)) return false;
    const Guess next = moved_by(g, step);
    const double then = cost(next);
    if (then <= now) {
      const bool small = now - then <= 1e-10 * now;
      g = next;
      now = then;
      damping = std::max(1e-12, 0.1 * damping);
      if (small) return true;
    } else {
      damping *= 10;
      if (damping > 1e3) return true;
    }
  }
  return false;
}

// How fast both turn does not depend on their frames: the offset at which their rates are most alike.
double Matcher::coarse_offset() const {
  const auto rate = [](const std::vector<TimedPose>& samples, double time, double span, double& value) {
    Pose from, to;
    if (!pose_at(samples, time - 0.5 * span, from) || !pose_at(samples, time + 0.5 * span, to)) return false;
    value = rotation_log(from.rotation.conjugate() * to.rotation).norm() / span;
    return true;
  };
  const double span = 2 * (a_.back().time - a_.front().time) / double(a_.size());
  double best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = -kOffsetSteps; k <= kOffsetSteps; ++k) {
    const double offset = options_.largest_offset * k / kOffsetSteps;
    double sum = 0;
    int count = 0;
    for (const TimedPose& a : a_) {
      double of_a = 0;
      double of_b = 0;
      if (!rate(a_, a.time, span, of_a) || !rate(b_, a.time + offset, span, of_b)) continue;
      sum += (of_a - of_b) * (of_a - of_b);
      ++count;
    }
    if (count < 3 || sum / count >= least) continue;
    least = sum / count;
    best = offset;
  }
  return best;
}

// Given the right transform the left one follows from one sample, and the other way round.
std::vector<Guess> Matcher::starts(double offset) const {
  std::vector<Guess> guesses{{options_.left, options_.right, offset}};
  if (options_.align == Align::kNothing) return guesses;
  std::size_t middle = a_.size() / 2;
  Pose b;
  while (!pose_at(b_, a_[middle].time + offset, b)) middle = (middle + 1) % a_.size();
  const Pose a = a_[middle].pose;
  if (options_.align == Align::kRight) {
    guesses.push_back({options_.left, (options_.left * b).inverse() * a, offset});
    return guesses;
  }
  const int count = options_.align == Align::kBoth ? kStarts : 1;
  for (int k = 0; k < count; ++k) {
    Pose right = options_.right;
    if (k > 0) {  // evenly over the axes, half a turn at most
      const Eigen::Vector3d axis(std::cos(2.4 * k), std::sin(2.4 * k), 1 - 2.0 * k / kStarts);
      right.rotation = right.rotation * rotation_exp(M_PI * (0.3 + 0.7 * (k % 3) / 2.0) * axis.normalized());
    }
    guesses.push_back({a * (b * right).inverse(), right, offset});
  }
  return guesses;
}

MotionMatch Matcher::run() {
  MotionMatch match;
  match.before = residuals({options_.left, options_.right, 0});
  match.rms_before = rms_of(match.before);
  Guess best{options_.left, options_.right, 0};
  NormalEquations sums;
  if (size_ > 0) {
    const double offset = options_.find_offset ? coarse_offset() : 0;
    double least = std::numeric_limits<double>::infinity();
    match.converged = false;
    for (Guess guess : starts(offset)) {
      NormalEquations last;
      const bool converged = descend(guess, last);
      const double value = cost(guess);
      if (!(value < least)) continue;
      least = value;
      best = guess;
      match.converged = converged;
    }
    // Turns and shifts weigh by how far each axis scatters.
    for (int pass = 0; pass < 3; ++pass) {
      scale_ = rms_of(residuals(best)).cwiseMax(1e-12).cwiseAbs2().cwiseInverse();
      descend(best, sums);
    }
    match.observable = sums_at(best, sums);
    Eigen::VectorXd unused;
    Eigen::MatrixXd covariance;
    match.observable = match.observable && solve_scaled(sums, 0, unused, &covariance);
    if (match.observable) {
      const Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
      match.left_sigma = part(sigma, left_at_);
      match.right_sigma = part(sigma, right_at_);
      if (offset_at_ >= 0) match.offset_sigma = sigma[offset_at_];
      match.observable =
          match.left_sigma.head<3>().maxCoeff() < 1 && match.right_sigma.head<3>().maxCoeff() < 1;
    }
  }
  match.left = best.left;
  match.right = best.right;
  match.offset = best.offset;
  match.after = residuals(best);
  match.rms_after = rms_of(match.after);
  return match;
}

}  // namespace

bool pose_at(const std::vector<TimedPose>& samples, double time, Pose& pose) {
  if (samples.empty() || time < samples.front().time || time > samples.back().time) return false;
  const auto after = std::upper_bound(samples.begin(), samples.end(), time,
                                      [](double t, const TimedPose& s) { return t < s.time; });
  if (after == samples.end()) {
    pose = samples.back().pose;
    return true;
  }
  const TimedPose& b = *after;
  const TimedPose& a = *std::prev(after);
  const double part = (time - a.time) / (b.time - a.time);
  pose.rotation = a.pose.rotation.slerp(part, b.pose.rotation).normalized();
  pose.translation = (1 - part) * a.pose.translation + part * b.pose.translation;
  return true;
}

MotionMatch match_motions(const TimedPoses& a, const TimedPoses& b, const MatchOptions& options) {
  return Matcher(a, b, options).run();
}

}  // namespace omma::ground
