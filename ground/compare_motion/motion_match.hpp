// Two motions of the same thing brought together (Miller's algorithm 8): A(t) = L B(t + τ) R, with the static
// transforms L and R between their frames given or estimated and a time offset estimated, each shown apart
// from what remains; the Earth's turn may be taken out of either. Source of the estimation: A X = Y B of many
// pairs (Zhuang, Roth & Sudhakar 1994), by least squares.
#pragma once

#include <vector>

#include "ground/compare_motion/timed_poses.hpp"

namespace omma::ground {

enum class Align { kNothing, kLeft, kRight, kBoth };

struct MatchOptions {
  Pose left;   ///< L, where the estimate starts
  Pose right;  ///< R
  Align align = Align::kNothing;
  bool find_offset = false;
  double largest_offset = 2;       ///< searched either way [s]
  bool invert = false;             ///< B is taken as its inverse
  bool derotate_measured = false;  ///< attitudes against J2000: the Earth's turn taken out of A
  bool derotate_truth = false;     ///< … and of B
};

/// What is left at a moment: a small turn and a shift in the frame on A's left.
struct MatchPoint {
  double time = 0;
  Vector6d residual = Vector6d::Zero();  ///< A less L B R [rad, m]
};

struct MotionMatch {
  std::vector<MatchPoint> before;  ///< as given: L and R of the options, no offset
  std::vector<MatchPoint> after;   ///< with what was estimated
  Vector6d rms_before = Vector6d::Zero();
  Vector6d rms_after = Vector6d::Zero();
  double offset = 0;  ///< τ [s]
  double offset_sigma = 0;
  Pose left;
  Pose right;
  Vector6d left_sigma =
      Vector6d::Zero();  ///< of a small turn and shift in its left frame; zero where not estimated
  Vector6d right_sigma = Vector6d::Zero();
  bool converged = true;
  bool observable = true;  ///< false: the motion does not fix what was to be estimated
};

/// B between its samples, turned along the shorter arc. False outside its time.
bool pose_at(const std::vector<TimedPose>& samples, double time, Pose& pose);

/// @param a  measured @param b  the other, covering at least three of A's moments
MotionMatch match_motions(const TimedPoses& a, const TimedPoses& b, const MatchOptions& options);

}  // namespace omma::ground
