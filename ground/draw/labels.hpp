// Where to put labels so that none covers another: each tries eight places around its mark, first come first
// served; one that finds no room is left out.
#pragma once

#include <string_view>
#include <vector>

#include "ground/draw/canvas.hpp"

namespace omma::ground {

class Labels {
 public:
  explicit Labels(Canvas& canvas) : canvas_(canvas) {}

  /// Keeps labels off a box (a mark, a legend).
  void reserve(const Box& box) { taken_.push_back(box); }
  /// Draws the text beside the mark if there is room inside the picture; false when it was left out.
  bool place(const Eigen::Vector2d& mark, double mark_radius, std::string_view utf8, double size,
             const Colour& colour);

 private:
  bool is_free(const Box& box) const;

  Canvas& canvas_;
  std::vector<Box> taken_;
};

}  // namespace omma::ground
