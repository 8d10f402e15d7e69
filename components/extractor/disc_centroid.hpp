// Grey-level centroid of a wide disc with its covariance from the noise of the pixels; right where a spot
// model is not. Source: first moment; formulas in docs/algorithms/extractor.md#disc.
#pragma once

#include <Eigen/Core>

#include "components/extractor/candidate.hpp"
#include "hal/image.hpp"

namespace omma {

struct DiscCentroid {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();          ///< [px]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [px²]
  float flux = 0;                                            ///< [grey levels]
  float snr = 0;                           ///< flux over its standard deviation; 0 where there is no light
  float sigma_major = 0, sigma_minor = 0;  ///< second moments [px]
};

/// @param invert  the disc is darker than the background
DiscCentroid disc_centroid(const ImageView& image, bool invert, const Candidate& candidate) noexcept;

}  // namespace omma
