// From a hypothetical pose to a labelling: which targets the dots explain, first around the patch the pose
// came from, then everywhere, refined by the solver; and how probable so good a match is by chance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/estimation/least_squares.hpp"
#include "components/geometry/rig_dot.hpp"
#include "components/tracker/patch_evidence.hpp"
#include "components/tracker/target_identification.hpp"

namespace omma {

/// A pose with the pairs it explains.
struct TargetLabelling {
  PoseSolution pose;
  StaticVector<TargetPair, limits::kTargetPairs> pairs;
  double part = 0;         ///< of the targets turned to the cameras that it explains
  double log_chance = 0;   ///< ln of the expected number of such labellings among dots strewn at random
  double log_clutter = 0;  ///< ln of the mean number of dots strewn at random in a dot's error ellipse
};

/// ln of how much likelier the first makes the dots than the second: what it explains is noise, else clutter.
double log_odds(const TargetLabelling& of, const TargetLabelling& against) noexcept;

/// True where the two give the same target to most of the dots of the smaller.
bool same_labelling(const TargetLabelling& a, const TargetLabelling& b) noexcept;

class TargetVerification {
 public:
  /// @param least_part  of the targets on faces turned to the camera that a labelling must explain
  TargetVerification(const TargetBody& body, double gate, double least_part);

  void start(std::span<const RigDot> dots) noexcept { dots_ = dots; }
  /// @param near  dots around the patch, of the same camera
  void look_at(const DotFoursome& foursome, std::span<const std::uint16_t> near) noexcept {
    patch_.look_at(dots_, foursome, near);
  }

  /// What the dots around the patch say of the pose.
  const PatchEvidence::Found& explained_nearby(const Pose& rig_from_body) noexcept {
    return patch_.explained(rig_from_body);
  }

  /// Carries the pose to all dots of all cameras.
  /// @param hits  what the dots around the patch are at this pose, all of one camera
  /// @return false where the pairs do not make a pose, or explain too few targets
  bool complete(const Pose& rig_from_body, std::span<const TargetPair> hits,
                TargetLabelling& labelling) noexcept;

  /// Two dots so close together that either may be the other's target are left out.
  /// @return false where too few others are left, or they make no pose
  bool tell_close_dots_apart(TargetLabelling& labelling) noexcept;

  /// A flat card's labelling begun in the wrong one of its two minima loses pairs there: `other` is grown
  /// anew from the mirror image of its pose; where that gives nothing, `other` is the labelling itself.
  void try_other_minimum(const TargetLabelling& labelling, TargetLabelling& other) noexcept;

 private:
  bool grow(TargetLabelling& labelling) noexcept;
  /// What of the targets it explains, and whether that may be chance; over pairs_.
  void assess(TargetLabelling& labelling) const noexcept;
  /// Targets on faces turned to a camera at `origin`, by more than grazing and `doubt` [cosine].
  std::size_t turned_to(const Pose& rig_from_body, const Eigen::Vector3d& origin,
                        double doubt = 0) const noexcept;
  /// Targets that must be explained at a pose: a part of those whose faces are turned to the patch's camera.
  std::size_t least_explained(const Pose& rig_from_body) const noexcept;
  /// Over pairs_, which are then those the solver kept.
  void solve_and_cull(TargetLabelling& labelling) noexcept;
  /// @return whether there was a pair without which the others fit far better
  bool leave_out_misfit(TargetLabelling& labelling) noexcept;
  /// The part of the sphere where the body is, for one camera.
  struct Region {
    Eigen::Vector3d direction;
    double radius = 0;  ///< [rad]
  };

  Region region(const Pose& pose, const Eigen::Vector3d& origin) const noexcept;
  void match_everywhere(const PoseSolution& pose) noexcept;
  void match_camera(const PoseSolution& pose, std::span<const RigDot> dots, std::size_t first) noexcept;
  void solve(const Pose& initial, const SolveOptions& options, PoseSolution& solution) noexcept;
  /// What lies in the part of the sphere where the pose puts the body, all cameras together.
  struct Surroundings {
    double dots = 0;
    double area = 0;      ///< [sr]
    double chances = 0;   ///< targets looked for: those turned to a camera, once a camera
    double turned = 0;    ///< the most that are turned to one of them
    double expected = 0;  ///< the same without faces so nearly grazing that the pose cannot tell
    double variance = 0;  ///< mean of the paired dots' variances [rad²]
  };
  Surroundings surroundings(const PoseSolution& solution) const noexcept;
  double log_chance(const PoseSolution& solution, const Surroundings& here) const noexcept;
  /// ln of the ways to choose k of so many.
  double log_choose(double of, std::size_t k) const noexcept;

  PatchEvidence patch_;
  std::vector<Target> targets_;
  bool has_faces_ = false;
  double log_aspects_ = 0;  ///< ln of the sets of targets that can be turned to a camera together
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  double radius_ = 0;  ///< of the body about its centroid [m]
  double gate_, least_part_;
  SolveOptions growing_, final_;
  std::array<double, limits::kTargetPairs + 1> log_factorial_{};

  std::span<const RigDot> dots_;
  Eigen::Vector3d patch_origin_ = Eigen::Vector3d::Zero();  ///< camera of the patch, rig frame [m]
  StaticVector<TargetPair, limits::kTargetPairs> pairs_;
  StaticVector<Sight, limits::kTargetPairs> sights_;
  std::array<std::uint8_t, limits::kTargetPairs> used_{};
  std::array<double, limits::kTargetPairs> distances_{};  ///< of pairs_, squared, in σ
  StaticVector<std::uint16_t, limits::kDotsPerCamera> in_region_;
};

}  // namespace omma
