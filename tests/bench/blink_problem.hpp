// Blinking lights before a moving camera with known truth: lights at grid points, all alike but for their
// codes, among steady ones; frames are lost, lights missed, false dots found.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "components/tracker/blink_codes.hpp"

namespace omma {

struct BlinkProblemOptions {
  int steady = 20;            ///< lights that do not blink (stars, lamps)
  double lost_frames = 0.05;  ///< part of the frames
  double missed = 0.02;       ///< of lit lights, each frame
  double clutter = 2;         ///< false dots a frame, anywhere, mean
  double noise_px = 0.1;
  double speed_px = 2;  ///< of the body in the image, a frame
  double spacing_px = 24;
};

/// One frame: dots with what they truly are.
struct BlinkFrame {
  std::uint64_t number = 0;
  std::vector<Eigen::Vector2d> dots;
  std::vector<int> light;  ///< of each dot: index of its code; −1: none
};

class BlinkScene {
 public:
  BlinkScene(const BlinkCodes& codes, const BlinkProblemOptions& options, std::uint64_t seed);
  /// The next frame that is not lost.
  BlinkFrame next();

 private:
  const BlinkCodes& codes_;
  BlinkProblemOptions options_;
  std::mt19937_64 random_;
  std::vector<Eigen::Vector2d> steady_;
  Eigen::Vector2d place_, velocity_;
  double angle_ = 0, turn_ = 0;
  int phase_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace omma
