// One-to-one assignment of predicted points to dots: Mahalanobis gate, ambiguity refused.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "components/extractor/dot.hpp"
#include "components/tracker/dot_grid.hpp"

namespace omma {

/// Where a star or a target should be seen in one image.
struct PredictedPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance =
      Eigen::Matrix2d::Zero();  ///< of the prediction [px²], the dot's own not included
  std::uint16_t entry = 0;      ///< caller's number of the star or target
  float weight = 1;  ///< expected brightness, any linear unit; the much brighter of two rivals wins
};

/// A prediction and the dot it got.
struct Assignment {
  std::uint16_t prediction = 0;
  std::uint16_t dot = 0;
  float distance2 = 0;  ///< squared Mahalanobis distance
};

struct AssignmentGate {
  double chi2 = 13.8;      ///< gate on the squared Mahalanobis distance; 13.8 loses one true pair in 1000
  double floor_px = 0.1;   ///< added in quadrature per axis: what neither covariance knows (lens) [px]
  double ambiguity = 9.0;  ///< a rival within this much of the squared distance makes a pairing ambiguous
  float dominance = 4.0F;  ///< unless one of the rivals is this many times brighter
};

/// Expected number of predictions that would get a dot if the dots lay at random over the image: the sum of
/// the gates' areas, π χ² √det S, times the density of the dots.
/// @param width, height  of the image [px]
double chance_pairs(std::span<const PredictedPoint> predictions, const DotList& dots,
                    const AssignmentGate& gate, int width, int height) noexcept;

/// True where chance hardly ever makes so many pairs: six standard deviations of a Poisson number of this
/// mean, and `least` on top.
bool beyond_chance(std::size_t pairs, double chance, int least) noexcept;

/// Work space and result of one image's assignment; static storage, no allocation.
class Assigner {
 public:
  static constexpr std::size_t kPredictions = 2048;

  /// Pairs predictions with dots. A pair is kept when each is the other's best within the gate and neither
  /// has a rival that fits almost as well (unless one rival is dominant in brightness).
  /// @param dots        one image
  /// @param grid        built on the same dots
  /// @param taken       per dot: non-zero where it may not be used (empty: all may)
  /// @return the pairs, in the order of the predictions; valid until the next call
  std::span<const Assignment> assign(std::span<const PredictedPoint> predictions, const DotList& dots,
                                     const DotGrid& grid, const AssignmentGate& gate,
                                     std::span<const std::uint8_t> taken) noexcept;

 private:
  struct Best {
    float distance2 = 1e30F;
    float weight = 0;
    std::uint16_t index = 0;
    void reset() { *this = Best{}; }
  };
  void offer(Best& best, Best& second, float distance2, float weight, std::uint16_t index) noexcept;

  StaticVector<Best, kPredictions> dot_of_prediction_;
  StaticVector<Best, kPredictions> second_dot_of_prediction_;
  StaticVector<Best, limits::kDotsPerCamera> prediction_of_dot_;
  StaticVector<Best, limits::kDotsPerCamera> second_prediction_of_dot_;
  StaticVector<Assignment, limits::kDotsPerCamera> assignments_;
};

}  // namespace omma
