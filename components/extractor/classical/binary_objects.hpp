// Objects of a binary image: connected pixels with what the classical pipelines judge them by. One object at
// a time: memory is that of the image, whatever it shows.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "components/extractor/classical/grey_image.hpp"

namespace omma {

/// Standard deviations along the long axis of second moments and across [px].
Eigen::Vector2d axes_of(const Eigen::Matrix2d& moments) noexcept;

struct BinaryObject {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< bounding box, inclusive [px]
  int holes = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();   ///< mean of its pixels [px]
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();  ///< their second moments, a pixel's own included [px²]
  std::span<const std::uint32_t> pixels;              ///< places in the image's values

  double area() const { return static_cast<double>(pixels.size()); }
  /// Area over that of the bounding box.
  double compactness() const { return area() / ((right - left + 1.0) * (bottom - top + 1.0)); }
  /// Area over that of the ellipse of the same moments: 1 for an ellipse, less for anything else.
  double ellipticity() const noexcept;
  /// Long axis over short one.
  double elongation() const noexcept {
    const Eigen::Vector2d axes = axes_of(moments);
    return axes.x() / axes.y();
  }
  bool at_edge(const GreyImage& image) const {
    return left == 0 || top == 0 || right == image.width - 1 || bottom == image.height - 1;
  }
};

class ObjectFinder {
 public:
  /// For images of this size; nothing is allocated later.
  ObjectFinder(int width, int height);

  /// Visits the 8-connected objects of the pixels that are not 0, in reading order.
  template <class Visit>
  void for_each(const GreyImage& binary, Visit&& visit) noexcept;
  /// Sets the pixels of the objects to 0 that are not to be kept.
  template <class Keep>
  void keep(GreyImage& binary, Keep&& kept) noexcept;

 private:
  void follow(const GreyImage& binary, std::uint32_t first) noexcept;
  void measure(const GreyImage& binary) noexcept;

  std::vector<std::uint32_t> pixels_;  // of the object at hand
  std::vector<std::uint8_t> seen_;     // in the pass of that number
  std::uint8_t pass_ = 0;
  BinaryObject object_;
};

template <class Visit>
void ObjectFinder::for_each(const GreyImage& binary, Visit&& visit) noexcept {
  if (++pass_ == 0) {
    std::fill(seen_.begin(), seen_.end(), std::uint8_t{0});
    pass_ = 1;
  }
  for (std::size_t i = 0; i < binary.value.size(); ++i) {
    if (binary.value[i] == 0 || seen_[i] == pass_) continue;
    follow(binary, static_cast<std::uint32_t>(i));
    measure(binary);
    visit(static_cast<const BinaryObject&>(object_));
  }
}

template <class Keep>
void ObjectFinder::keep(GreyImage& binary, Keep&& kept) noexcept {
  for_each(binary, [&](const BinaryObject& object) {
    if (kept(object)) return;
    for (const std::uint32_t i : object.pixels) binary.value[i] = 0;
  });
}

}  // namespace omma
