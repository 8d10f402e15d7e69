// The three extraction pipelines of Miller's dissertation, stage by stage, for comparison and for odd
// imagery. Source: J. Miller, algorithms 4 (MLAS), 5 (small target) and 7 (stars). What the text leaves open
// (windows, factors, sizes) is a parameter here; docs/algorithms/classical_extraction.md says what was
// chosen.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string_view>
#include <vector>

#include "ground/dots/grey_image.hpp"

namespace omma::ground {

struct ClassicalDot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< centre of mass of its pixels [px]
  int area = 0;                                     ///< [px]
};

struct ClassicalParameters {
  int window = 31;          ///< of the local threshold, odd [px]
  double deviations = 2.5;  ///< of the local threshold
  int least_area = 4;       ///< smaller objects are removed [px]
  int largest_area = 400;   ///< larger objects are no stars [px]
  double least_compactness = 0.5;
  double least_ellipticity = 0.8;
  double largest_elongation = 2.5;  ///< of what still counts as a circle or an ellipse
  double low_frequencies = 0.05;    ///< part that the small-target pipeline removes
  double smooth = 1.0;              ///< Gaussian [px]
  int background_window = 7;        ///< of the stars pipeline's median, odd [px]
};

/// Called with each stage's name and image, in order.
using StageObserver = std::function<void(std::string_view name, const GreyImage& image)>;

/// Algorithm 4.
std::vector<ClassicalDot> mlas_dots(const GreyImage& image, const ClassicalParameters& parameters,
                                    const StageObserver& observer);
/// Algorithm 5.
std::vector<ClassicalDot> small_target_dots(const GreyImage& image, const ClassicalParameters& parameters,
                                            const StageObserver& observer);
/// Algorithm 7. @param black_frame  mean of images with the lens covered, or empty (0 × 0)
std::vector<ClassicalDot> star_dots(const GreyImage& image, const GreyImage& black_frame,
                                    const ClassicalParameters& parameters, const StageObserver& observer);

}  // namespace omma::ground
