#include "ground/design/prediction.hpp"

#include <cmath>

#include "components/estimation/calibration_terms.hpp"
#include "components/estimation/least_squares.hpp"

namespace omma::ground {
namespace {

template <int kUnknowns>
std::optional<PredictedCovariance> predict(const PaperRig& paper, const SeenSights& seen, const Pose& pose,
                                           const CalibrationError& error) {
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  const CameraAxes axes = camera_axes(paper.rig);
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  CalibrationTerms<kUnknowns> terms(error, axes);
  Matrix information = Matrix::Zero();
  for (std::size_t i = 0; i < seen.sights.size(); ++i) {
    const LinearisedSight<kUnknowns> sight(seen.sights[i], rotation, pose.translation);
    information += sight.jacobian.transpose() * sight.jacobian;
    terms.add(sight, seen.sources[i], rotation);
  }
  Matrix covariance;
  if (!covariance_of<kUnknowns>(information, covariance)) return std::nullopt;
  PredictedCovariance predicted;
  predicted.dots = seen.sights.size();
  predicted.noise.topLeftCorner<kUnknowns, kUnknowns>() = covariance;
  predicted.total.topLeftCorner<kUnknowns, kUnknowns>() =
      covariance + covariance * terms.spread() * covariance;
  return predicted;
}

bool solved(SolveStatus status) {
  return status == SolveStatus::kSolved || status == SolveStatus::kIterationCap;
}

/// Squares of errors and of what was predicted, over the trials.
class Tally {
 public:
  template <int kUnknowns>
  void add(const Vector6d& error, const Matrix6d& covariance) {
    ++count_;
    rotation_ += error.head<3>().squaredNorm();
    predicted_rotation_ += covariance.topLeftCorner<3, 3>().trace();
    position_ += error.tail<3>().squaredNorm();
    predicted_position_ += covariance.bottomRightCorner<3, 3>().trace();
    const Eigen::Matrix<double, kUnknowns, kUnknowns> block =
        covariance.topLeftCorner<kUnknowns, kUnknowns>();
    nees_ += error.head<kUnknowns>().dot(block.ldlt().solve(error.head<kUnknowns>()));
  }
  void put(MonteCarloCheck& check) const {
    check.solved = count_;
    if (count_ == 0) return;
    check.rotation_ratio = std::sqrt(rotation_ / predicted_rotation_);
    if (predicted_position_ > 0) check.position_ratio = std::sqrt(position_ / predicted_position_);
    check.nees = nees_ / count_;
  }

 private:
  int count_ = 0;
  double rotation_ = 0, predicted_rotation_ = 0, position_ = 0, predicted_position_ = 0, nees_ = 0;
};

}  // namespace

std::optional<PredictedCovariance> predict_attitude(const PaperRig& paper, std::span<const SkyStar> stars,
                                                    const Eigen::Quaterniond& rig_from_j2000,
                                                    double dot_sigma, const CalibrationError& error,
                                                    std::size_t most) {
  const SeenSights seen = seen_stars(paper, stars, rig_from_j2000, {.sigma_px = dot_sigma, .most = most});
  if (seen.sights.size() < 2) return std::nullopt;
  return predict<kAttitudeUnknowns>(paper, seen, {rig_from_j2000, Eigen::Vector3d::Zero()}, error);
}

std::optional<PredictedCovariance> predict_pose(const PaperRig& paper, const TargetBody& body,
                                                const Pose& rig_from_body, double dot_sigma,
                                                const CalibrationError& error) {
  const SeenSights seen = seen_targets(paper, body, rig_from_body, {.sigma_px = dot_sigma});
  if (seen.sights.size() < 3) return std::nullopt;
  return predict<kPoseUnknowns>(paper, seen, rig_from_body, error);
}

MonteCarloCheck check_attitude(const PaperRig& paper, std::span<const SkyStar> stars,
                               const std::vector<Eigen::Quaterniond>& attitudes, double dot_sigma,
                               const CalibrationError& error, int trials, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  MonteCarloCheck check;
  Tally tally;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::Quaterniond& truth = attitudes[static_cast<std::size_t>(trial) % attitudes.size()];
    const auto predicted = predict_attitude(paper, stars, truth, dot_sigma, error, limits::kStarPairs);
    if (!predicted) continue;
    ++check.trials;
    const MistakenCalibration mistakes = draw_mistakes(error, random);
    const SeenSights seen =
        seen_stars(paper, stars, truth, {dot_sigma, &mistakes, &random, limits::kStarPairs});
    SolveOptions options;
    options.cull = CullRule::kNone;  // pairs are right here; a cull would hide wrong calibrations
    const AttitudeSolution solution = solve_attitude(seen.sights, truth, options, {});
    if (!solved(solution.status)) continue;
    Vector6d apart = Vector6d::Zero();
    apart.head<3>() = rotation_log(truth * solution.rig_from_j2000.conjugate());
    tally.add<kAttitudeUnknowns>(apart, predicted->total);
  }
  tally.put(check);
  return check;
}

MonteCarloCheck check_pose(const PaperRig& paper, const TargetBody& body, const Pose& rig_from_body,
                           double dot_sigma, const CalibrationError& error, int trials, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  MonteCarloCheck check;
  Tally tally;
  const auto predicted = predict_pose(paper, body, rig_from_body, dot_sigma, error);
  if (!predicted) return check;
  for (int trial = 0; trial < trials; ++trial) {
    ++check.trials;
    const MistakenCalibration mistakes = draw_mistakes(error, random);
    const SeenSights seen = seen_targets(paper, body, rig_from_body, {dot_sigma, &mistakes, &random});
    SolveOptions options;
    options.cull = CullRule::kNone;
    const PoseSolution solution = solve_pose(seen.sights, rig_from_body, options, {});
    if (!solved(solution.status)) continue;
    check.ambiguous += solution.ambiguous ? 1 : 0;
    Vector6d apart;
    apart << rotation_log(rig_from_body.rotation * solution.rig_from_body.rotation.conjugate()),
        rig_from_body.translation - solution.rig_from_body.translation;
    tally.add<kPoseUnknowns>(apart, predicted->total);
  }
  tally.put(check);
  return check;
}

}  // namespace omma::ground
