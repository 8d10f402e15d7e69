// Objects of a binary image: connected pixels with what the classical pipelines judge them by.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "ground/dots/grey_image.hpp"

namespace omma::ground {

struct BinaryObject {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< bounding box, inclusive [px]
  int holes = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();   ///< mean of its pixels [px]
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();  ///< their second moments, a pixel's own included [px²]
  std::vector<std::pair<int, int>> pixels;            ///< (u, v)

  double area() const { return static_cast<double>(pixels.size()); }
  /// Area over that of the bounding box.
  double compactness() const { return area() / ((right - left + 1.0) * (bottom - top + 1.0)); }
  /// Area over that of the ellipse of the same moments: 1 for an ellipse, less for anything else.
  double ellipticity() const;
  /// Long axis over short one.
  double elongation() const;
  bool at_edge(const GreyImage& image) const {
    return left == 0 || top == 0 || right == image.width - 1 || bottom == image.height - 1;
  }
};

/// The 8-connected objects of the pixels that are not 0, in reading order.
std::vector<BinaryObject> objects(const GreyImage& binary);
/// Sets the pixels of the objects to 0 that are not to be kept, and forgets those objects.
void keep(GreyImage& binary, std::vector<BinaryObject>& found,
          const std::function<bool(const BinaryObject&)>& kept);

}  // namespace omma::ground
