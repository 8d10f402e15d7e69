#include "components/estimation/integrity.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "components/estimation/calibration_terms.hpp"
#include "components/estimation/chance.hpp"
#include "components/estimation/covariance.hpp"

namespace omma {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// How the risk is shared out.
constexpr double kNoiseShare = 0.5;
constexpr double kDotShare = 0.25;
constexpr double kCameraShare = 0.25;

/// σ to allow for an event of which there are `count`, each with probability `prior`, that together may use
/// up `share` of the risk. 0: so unlikely that it needs no allowance.
double sigmas_for(double share, double prior, double count) {
  return prior > 0 ? two_sided_sigmas(share / (prior * std::max(1.0, count))) : 0;
}

/// Sums of one camera's sights.
template <int kUnknowns>
struct CameraSums {
  Eigen::Matrix<double, kUnknowns, kUnknowns> information =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
  Eigen::Matrix<double, kUnknowns, 1> gradient = Eigen::Matrix<double, kUnknowns, 1>::Zero();
  double cost = 0;
  double calibration = 0;  // expected of its squared residuals from errors of calibration
  int sights = 0;
};

/// Lives on the stack of one call.
template <int kUnknowns>
class Check {
 public:
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  Check(std::span<const Sight> sights, std::span<const SightSource> sources,
        std::span<const std::uint8_t> used, const Pose& pose, const Matrix& bend, const CameraAxes& axes,
        const IntegrityOptions& options, Integrity& out) noexcept
      : sights_(sights),
        sources_(sources),
        used_(used),
        pose_(pose),
        bend_(bend),
        options_(options),
        out_(out),
        rotation_(pose.rotation.toRotationMatrix()),
        terms_(options.calibration, axes),
        to_body_(in_body_frame(pose).template topLeftCorner<kUnknowns, kUnknowns>()),
        calibrated_wrongly_(options.calibration.any()),
        allowance_(two_sided_sigmas(options.false_alarm)) {}

  void run() noexcept {
    sum();
    if (!covariance_of<kUnknowns>(information_, covariance_)) {
      give_up();
      return;
    }
    spread_ = terms_.spread();
    total_ = covariance_ + bend_ + covariance_ * spread_ * covariance_;
    out_.rig.covariance.template topLeftCorner<kUnknowns, kUnknowns>() = total_;
    out_.body.covariance.template topLeftCorner<kUnknowns, kUnknowns>() =
        to_body_ * total_ * to_body_.transpose();
    out_.weakest_rotation = weakest_direction(total_.template topLeftCorner<3, 3>());
    if constexpr (kUnknowns == kPoseUnknowns)
      out_.weakest_position = weakest_direction(total_.template bottomRightCorner<3, 3>());
    out_.risk = options_.risk;
    out_.freedom = static_cast<std::uint16_t>(std::max(0, 2 * count_ - kUnknowns));
    if (out_.freedom < 2) {  // a dot less would fix nothing
      give_up();
      return;
    }
    out_.state = IntegrityState::kSound;
    // What calibration leaves in the residuals: what it moves them by, less what the solution takes up.
    const double calibration = std::max(0.0, calibration_ - (covariance_ * spread_).trace());
    out_.chi2_probability = chi_square_tail(cost_ - allowance2() * calibration, out_.freedom);
    if (out_.chi2_probability < options_.false_alarm) out_.state = IntegrityState::kAlert;
    protect(Vector::Zero(), total_, two_sided_sigmas(kNoiseShare * options_.risk));
    leave_out_dots();
    leave_out_cameras();
  }

  /// The pose may be `other` instead.
  void allow(const Pose& other) noexcept {
    Vector apart;
    apart << rotation_log(other.rotation * pose_.rotation.conjugate()), other.translation - pose_.translation;
    protect(apart, total_, two_sided_sigmas(kNoiseShare * options_.risk));
  }

  void give_up() noexcept {
    out_.state = IntegrityState::kUnchecked;
    withhold();
  }
  void withhold() noexcept {
    out_.rig.protection_level.template head<kUnknowns>().setConstant(kNever);
    out_.body.protection_level.template head<kUnknowns>().setConstant(kNever);
  }

 private:
  bool is_used(std::size_t i) const { return i < used_.size() && used_[i] != 0; }
  LinearisedSight<kUnknowns> linearised(std::size_t i) const {
    return {sights_[i], rotation_, pose_.translation};
  }

  void sum() noexcept {
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (!is_used(i)) continue;
      const LinearisedSight<kUnknowns> seen = linearised(i);
      CameraSums<kUnknowns>& camera = cameras_[camera_of(i)];
      camera.information += seen.jacobian.transpose() * seen.jacobian;
      camera.gradient += seen.jacobian.transpose() * seen.residual;
      camera.cost += seen.residual.squaredNorm();
      ++camera.sights;
      if (!calibrated_wrongly_) continue;
      camera.calibration += terms_.variance(seen, sources_[i]);
      terms_.add(seen, sources_[i], rotation_);
    }
    for (const CameraSums<kUnknowns>& camera : cameras_) {
      information_ += camera.information;
      cost_ += camera.cost;
      calibration_ += camera.calibration;
      count_ += camera.sights;
    }
  }

  /// Errors of calibration are common to many dots: in the worst case all that is expected of them is one
  /// normal variable, which is this many times as large once in so many false alarms.
  double allowance2() const { return calibrated_wrongly_ ? allowance_ * allowance_ : 0; }

  std::size_t camera_of(std::size_t i) const {
    return std::min<std::size_t>(sources_[i].camera, limits::kCameras - 1);
  }

  /// Widens the protection levels to a solution moved by `move` and known to `sigmas` of `covariance`.
  void protect(const Vector& move, const Matrix& covariance, double sigmas) noexcept {
    const Vector to = move.cwiseAbs() + sigmas * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    auto level = out_.rig.protection_level.template head<kUnknowns>();
    level = level.cwiseMax(to);
    const Vector body_variance = (to_body_ * covariance * to_body_.transpose()).diagonal();
    const Vector body_to = (to_body_ * move).cwiseAbs() + sigmas * body_variance.cwiseMax(0.0).cwiseSqrt();
    auto body_level = out_.body.protection_level.template head<kUnknowns>();
    body_level = body_level.cwiseMax(body_to);
  }

  static void note_move(const Vector& move, double& rad, double& m) noexcept {
    rad = std::max(rad, move.template head<3>().norm());
    if constexpr (kUnknowns == kPoseUnknowns) m = std::max(m, move.template tail<3>().norm());
  }

  // Without dot i: H − JᵀJ, and from Woodbury's identity the solution moves by P Jᵀ (I − J P Jᵀ)⁻¹ r, its
  // covariance grows by P Jᵀ (I − J P Jᵀ)⁻¹ J P.
  void leave_out_dots() noexcept {
    const double sigmas = sigmas_for(kDotShare * options_.risk, options_.dot_fault, count_);
    const double threshold2 = -2 * std::log(options_.false_alarm / count_);  // χ² of two
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (!is_used(i)) continue;
      const LinearisedSight<kUnknowns> seen = linearised(i);
      const Eigen::Matrix<double, kUnknowns, 2> gain = covariance_ * seen.jacobian.transpose();
      const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - seen.jacobian * gain;
      const Eigen::LLT<Eigen::Matrix2d> factor(left);
      constexpr double kLeastRedundancy = 1e-9;
      if (factor.info() != Eigen::Success || !(left.determinant() > kLeastRedundancy)) {
        withhold();  // the others do not fix the unknowns
        continue;
      }
      const Eigen::Vector2d whitened = factor.matrixL().solve(seen.residual);
      const Eigen::Matrix<double, kUnknowns, 2> loss = factor.matrixL().solve(gain.transpose()).transpose();
      const Vector move = loss * whitened;
      note_move(move, out_.dot_separation_rad, out_.dot_separation_m);
      const double calibration = calibrated_wrongly_ ? terms_.variance(seen, sources_[i]) : 0;
      const double contradiction = std::max(0.0, whitened.norm() - allowance_ * std::sqrt(calibration));
      if (contradiction > out_.suspect_dot_sigma) {
        out_.suspect_dot_sigma = contradiction;
        out_.suspect_dot = sources_[i];
      }
      if (contradiction * contradiction > threshold2) out_.state = IntegrityState::kAlert;
      if (sigmas <= 0) continue;
      const Matrix without = covariance_ + loss * loss.transpose();
      protect(move, without + bend_ + without * spread_ * without, sigmas);
    }
  }

  void leave_out_cameras() noexcept {
    const auto taking_part = static_cast<double>(std::count_if(
        cameras_.begin(), cameras_.end(), [](const CameraSums<kUnknowns>& c) { return c.sights > 0; }));
    const double sigmas = sigmas_for(kCameraShare * options_.risk, options_.camera_fault, taking_part);
    out_.cameras_checked = true;
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      const CameraSums<kUnknowns>& camera = cameras_[c];
      if (camera.sights == 0) continue;
      Matrix without;
      const Matrix left = information_ - camera.information;
      if (camera.sights == count_ || !covariance_of<kUnknowns>(left, without)) {
        out_.cameras_checked = false;
        continue;
      }
      const Vector move = without * camera.gradient;
      note_move(move, out_.camera_separation_rad, out_.camera_separation_m);
      // What χ² falls by: its own residuals, and what the others gain when they need not meet it.
      const double fall = camera.cost + camera.gradient.dot(move) - allowance2() * camera.calibration;
      const double probability = chi_square_tail(fall, 2 * camera.sights);
      if (probability < out_.suspect_camera_probability) {
        out_.suspect_camera_probability = probability;
        out_.suspect_camera = static_cast<std::uint8_t>(c);
      }
      if (probability < options_.false_alarm / taking_part) out_.state = IntegrityState::kAlert;
      if (sigmas > 0) protect(move, without + bend_ + without * terms_.spread_without(c) * without, sigmas);
    }
  }

  std::span<const Sight> sights_;
  std::span<const SightSource> sources_;
  std::span<const std::uint8_t> used_;
  const Pose& pose_;
  Matrix bend_;  ///< of the cost: as much without a dot or a camera
  const IntegrityOptions& options_;
  Integrity& out_;
  Eigen::Matrix3d rotation_;
  CalibrationTerms<kUnknowns> terms_;
  Matrix to_body_;
  bool calibrated_wrongly_;
  double allowance_;
  double calibration_ = 0;
  std::array<CameraSums<kUnknowns>, limits::kCameras> cameras_{};
  Matrix information_ = Matrix::Zero(), covariance_ = Matrix::Zero(), spread_ = Matrix::Zero(),
         total_ = Matrix::Zero();
  double cost_ = 0;
  int count_ = 0;
};

template <class Solution>
bool has_answer(const Solution& solution) {
  return solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap ||
         solution.status == SolveStatus::kUnobservable;
}

}  // namespace

Integrity attitude_integrity(std::span<const Sight> sights, std::span<const SightSource> sources,
                             std::span<const std::uint8_t> used, const AttitudeSolution& solution,
                             const CameraAxes& axes, const IntegrityOptions& options) noexcept {
  Integrity integrity;
  if (!has_answer(solution) || sources.size() != sights.size()) return integrity;
  const Pose pose{solution.rig_from_j2000, Eigen::Vector3d::Zero()};
  integrity.rig.covariance.topLeftCorner<3, 3>() = solution.covariance;
  Check<kAttitudeUnknowns> check(sights, sources, used, pose, Eigen::Matrix3d::Zero(), axes, options,
                                 integrity);
  check.run();
  return integrity;
}

Integrity pose_integrity(std::span<const Sight> sights, std::span<const SightSource> sources,
                         std::span<const std::uint8_t> used, const PoseSolution& solution,
                         const CameraAxes& axes, const IntegrityOptions& options) noexcept {
  Integrity integrity;
  if (!has_answer(solution) || sources.size() != sights.size()) return integrity;
  integrity.rig.covariance = solution.covariance;
  Check<kPoseUnknowns> check(sights, sources, used, solution.rig_from_body, solution.bend, axes, options,
                             integrity);
  check.run();
  if (solution.ambiguous && solution.has_alternative) check.allow(solution.alternative);
  if (solution.ambiguous && !solution.has_alternative) check.withhold();
  return integrity;
}

}  // namespace omma
