// The motion of a body since its first accepted pose: what it is, and that its covariance is that of its
// errors, with calibration errors that are the same in both poses.
#include "components/pose/body_motion.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "components/pose/relative_pose.hpp"
#include "tests/bench/integrity_problem.hpp"

namespace omma {
namespace {

constexpr double kSigma = 5e-4;  // of a bearing [rad]

RigProblemOptions card() {
  RigProblemOptions options;
  options.targets = 20;
  options.every_camera_sees_all = true;
  return options;
}

/// The card of `problem` seen again by the same cameras elsewhere.
IntegrityProblem seen_at(const RigProblem& problem, const Pose& truth, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  IntegrityProblem seen;
  seen.axes.fill(Eigen::Vector3d::UnitZ());
  for (std::size_t c = 0; c < problem.axes.size(); ++c) seen.axes[c] = problem.axes[c];
  seen.sigma = kSigma;
  seen.truth = truth;
  for (std::size_t i = 0; i < problem.sights.size(); ++i) {
    const Eigen::Vector3d& origin = problem.sights[i].origin;
    const Eigen::Vector3d& point = problem.targets[problem.entry[i]];
    const Eigen::Vector3d ray = (truth * point - origin).normalized();
    const Eigen::Vector2d noise(kSigma * gauss(random), kSigma * gauss(random));
    seen.sights.push_back(
        isotropic_sight(origin, (ray + tangent_basis(ray) * noise).normalized(), kSigma, point));
    seen.sources.push_back({problem.camera[i], problem.entry[i]});
  }
  return seen;
}

Pairings paired(const IntegrityProblem& seen, std::uint64_t frame) {
  Pairings pairings;
  pairings.frame = frame;
  pairings.bodies.resize(1);
  BodyPairings& body = pairings.bodies[0];
  body.state = TrackState::kTracking;
  body.rig_from_body = seen.truth;
  for (std::size_t i = 0; i < seen.sights.size(); ++i) {
    Pairing pair;
    pair.sight = seen.sights[i];
    pair.camera = seen.sources[i].camera;
    pair.entry = seen.sources[i].entry;
    body.pairs.push_back(pair);
  }
  return pairings;
}

/// The component, shown one set of pairings after the other.
class Watch {
 public:
  explicit Watch(const CameraAxes& axes, const CalibrationError& calibration = {}) {
    RelativePoseParameters parameters;
    parameters.integrity.calibration = calibration;
    parameters.axes = axes;
    pose_ = std::make_unique<RelativePose>(parameters);
    pose_->pairings.bind(*pairings_);
  }
  const PoseEstimate& see(const Pairings& pairings) {
    **pairings_ = pairings;
    pose_->step(Tick{});
    return pose_->estimates->bodies[0];
  }

 private:
  std::unique_ptr<Out<Pairings>> pairings_ = std::make_unique<Out<Pairings>>();
  std::unique_ptr<RelativePose> pose_;
};

Pose moved(const Pose& from) {
  return {rotation_exp({0.1, -0.2, 0.3}) * from.rotation,
          from.translation + Eigen::Vector3d(0.05, 0.1, -0.2)};
}

struct Nees {
  int trials = 0;
  double motion = 0;     ///< mean, of the motion with its covariance
  double unrelated = 0;  ///< mean, as if the two poses had nothing in common
};

Nees motion_nees(const CalibrationError& calibration, int trials) {
  Nees nees;
  for (int trial = 0; trial < trials; ++trial) {
    std::mt19937_64 random(static_cast<std::uint64_t>(trial) + 1000);
    const RigProblem problem = make_rig_problem(card(), static_cast<std::uint64_t>(trial));
    const Pose later = moved(problem.truth);
    IntegrityProblem first = seen_at(problem, problem.truth, random);
    IntegrityProblem second = seen_at(problem, later, random);
    std::mt19937_64 mistakes(static_cast<std::uint64_t>(trial) + 5000), same = mistakes;
    spoil_calibration(first, calibration, mistakes);
    spoil_calibration(second, calibration, same);
    Watch watch(first.axes, calibration);
    const PoseEstimate before = watch.see(paired(first, 7));
    const PoseEstimate now = watch.see(paired(second, 8));
    const BodyMotion& motion = now.motion;
    if (!motion.valid || motion.first_frame != 7) continue;  // the first was ambiguous
    ++nees.trials;
    const Pose truth{later.rotation * problem.truth.rotation.conjugate(),
                     later.translation - problem.truth.translation};
    const Vector6d error = pose_error(motion.since_first, truth);
    nees.motion += error.dot(motion.covariance.ldlt().solve(error));
    Matrix6d turn = Matrix6d::Identity();
    turn.topLeftCorner<3, 3>() = motion.since_first.rotation.toRotationMatrix();
    const Matrix6d sum =
        now.integrity.rig.covariance + turn * before.integrity.rig.covariance * turn.transpose();
    nees.unrelated += error.dot(sum.ldlt().solve(error));
  }
  EXPECT_GT(nees.trials, 0.9 * trials);
  nees.motion /= nees.trials;
  nees.unrelated /= nees.trials;
  return nees;
}

TEST(BodyMotion, CovarianceIsThatOfItsErrors) {
  EXPECT_NEAR(motion_nees({}, 200).motion, 6, 0.8);
}

TEST(BodyMotion, CalibrationErrorsOfBothPosesAreTheSame) {
  CalibrationError calibration;
  calibration.camera_rotation = 5e-4;
  calibration.camera_position = 5e-4;
  calibration.lens_scale = 5e-4;
  calibration.survey = 3e-4;
  calibration.survey_scale = 3e-3;
  const Nees nees = motion_nees(calibration, 200);
  EXPECT_NEAR(nees.motion, 6, 0.9);
  EXPECT_LT(nees.unrelated, 4.5);  // too careful by what cancels
}

TEST(BodyMotion, FirstPoseIsItsOwnReference) {
  std::mt19937_64 random(3);
  const RigProblem problem = make_rig_problem(card(), 3);
  const IntegrityProblem seen = seen_at(problem, problem.truth, random);
  Watch watch(seen.axes);
  const BodyMotion motion = watch.see(paired(seen, 11)).motion;
  EXPECT_TRUE(motion.valid);
  EXPECT_EQ(motion.first_frame, 11U);
  EXPECT_LT(rotation_log(motion.since_first.rotation).norm(), 1e-12);
  EXPECT_EQ(motion.since_first.translation, Eigen::Vector3d::Zero());
  EXPECT_EQ(motion.covariance, Matrix6d::Zero());
}

TEST(BodyMotion, GoesOnFromTheSameFirstPoseAfterTheBodyWasOutOfSight) {
  std::mt19937_64 random(4);
  const RigProblem problem = make_rig_problem(card(), 4);
  Watch watch(seen_at(problem, problem.truth, random).axes);
  watch.see(paired(seen_at(problem, problem.truth, random), 1));
  Pairings nothing = paired(seen_at(problem, problem.truth, random), 2);
  nothing.bodies[0].state = TrackState::kLost;
  nothing.bodies[0].pairs.clear();
  EXPECT_FALSE(watch.see(nothing).motion.valid);
  const BodyMotion motion = watch.see(paired(seen_at(problem, moved(problem.truth), random), 3)).motion;
  EXPECT_TRUE(motion.valid);
  EXPECT_EQ(motion.first_frame, 1U);
  EXPECT_NEAR(motion.since_first.translation.z(), -0.2, 0.01);
}

TEST(BodyMotion, DoesNotStartFromAnAmbiguousPose) {
  RigProblemOptions far = card();
  far.range = 30;
  far.max_tilt_deg = 1;
  std::mt19937_64 random(5);
  const RigProblem problem = make_rig_problem(far, 5);
  const IntegrityProblem seen = seen_at(problem, problem.truth, random);
  Watch watch(seen.axes);
  const PoseEstimate& estimate = watch.see(paired(seen, 1));
  EXPECT_TRUE(estimate.solution.ambiguous || !estimate.rotation_valid);
  EXPECT_FALSE(estimate.motion.valid);
}

}  // namespace
}  // namespace omma
