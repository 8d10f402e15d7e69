#include "ground/methods/map_ransac_pose.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "components/estimation/descent.hpp"

namespace omma {
namespace {

constexpr int kMostIterations = 30;

class Posterior {
 public:
  Posterior(const Pose& prior, const MapRansacOptions& options) : prior_(prior) {
    information_.diagonal() << Eigen::Vector3d::Constant(std::pow(options.prior_rotation_sigma, -2)),
        Eigen::Vector3d::Constant(std::pow(options.prior_position_sigma, -2));
  }

  /// Gauss–Newton, damped where the cost would rise.
  Pose most_probable(std::span<const Sight> sights, int& iterations) const {
    Pose pose = prior_;
    NormalEquations<kPoseUnknowns> here = sums_at(sights, pose);
    double damping = 0;
    for (int i = 0; i < kMostIterations; ++i) {
      ++iterations;
      Vector6d step;
      if (!damped_step<kPoseUnknowns>(here, damping, step)) break;
      if (step.dot(here.information * step) < kNegligibleStep) break;
      const Pose next = moved<kPoseUnknowns>(pose, step);
      const NormalEquations<kPoseUnknowns> there = sums_at(sights, next);
      if (there.cost <= here.cost) {
        pose = next;
        here = there;
        damping *= 0.1;
      } else {
        damping = damping > 0 ? 8 * damping : 1e-3;
      }
    }
    return pose;
  }

 private:
  NormalEquations<kPoseUnknowns> sums_at(std::span<const Sight> sights, const Pose& pose) const {
    NormalEquations<kPoseUnknowns> sums = normal_equations<kPoseUnknowns>(sights, {}, pose);
    Vector6d from_prior;  // turning by δθ adds δθ to the rotation vector, to first order
    from_prior << rotation_log(pose.rotation * prior_.rotation.conjugate()),
        pose.translation - prior_.translation;
    const Vector6d weighted = information_ * from_prior;
    sums.information += information_;
    sums.gradient += weighted;
    sums.cost += from_prior.dot(weighted);
    return sums;
  }

  Pose prior_;
  Matrix6d information_ = Matrix6d::Zero();
};

std::vector<Sight> supporters(std::span<const Sight> sights, const Pose& pose, double gate) {
  std::vector<Sight> found;
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  for (const Sight& sight : sights) {
    double squared_angle;
    const double r2 = squared_residual<kPoseUnknowns>(sight, rotation, pose.translation, squared_angle);
    if (r2 < gate * gate) found.push_back(sight);
  }
  return found;
}

}  // namespace

PoseAnswer map_ransac_pose(std::span<const Sight> sights, const Pose& prior,
                           const MapRansacOptions& options) {
  PoseAnswer answer;
  answer.rig_from_body = prior;
  const std::size_t n = sights.size();
  if (n < 3) return answer;
  const Posterior posterior(prior, options);
  std::minstd_rand random(static_cast<std::minstd_rand::result_type>(options.seed));
  std::vector<Sight> support;
  double rounds = options.most_rounds;
  for (int round = 0; round < rounds; ++round) {
    const std::size_t a = random() % n;
    const std::size_t b = (a + 1 + random() % (n - 1)) % n;
    std::size_t c = random() % n;
    while (c == a || c == b) c = random() % n;
    const Sight triple[3] = {sights[a], sights[b], sights[c]};
    const Pose pose = posterior.most_probable(triple, answer.iterations);
    std::vector<Sight> found = supporters(sights, pose, options.gate);
    if (found.size() <= support.size()) continue;
    support = std::move(found);
    answer.rig_from_body = pose;
    const double part = static_cast<double>(support.size()) / static_cast<double>(n);
    const double all_three = part * part * part;
    rounds = all_three < 1 ? std::min<double>(options.most_rounds,
                                              std::log(1 - options.confidence) / std::log(1 - all_three))
                           : 0;
  }
  answer.found = support.size() >= 3;
  if (answer.found && options.refine)
    answer.rig_from_body = posterior.most_probable(support, answer.iterations);
  return answer;
}

}  // namespace omma
