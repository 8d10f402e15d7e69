// Lines of right ascension and declination as any projection shows them: a lens, a panorama.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "ground/draw/canvas.hpp"
#include "ground/draw/labels.hpp"

namespace omma::ground {

/// Pixel where a J2000 unit direction is seen; false where it is not.
using SkyProjection = std::function<bool(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel)>;

/// One unbroken piece of a grid line [px].
struct GridLine {
  std::vector<Eigen::Vector2d> points;
  std::string label;  ///< "6ʰ", "6ʰ20ᵐ", "+30°"
};

/// Spacing of the grid that suits a field of view.
struct GridStep {
  double right_ascension_deg = 30;
  double declination_deg = 30;
};
GridStep grid_step(double field_of_view_deg);

/// @param largest_jump  distance of neighbouring samples [px] at which a line is cut (the seam of a panorama)
std::vector<GridLine> sky_grid(const SkyProjection& projection, const GridStep& step, double largest_jump);

/// Draws the lines, then labels each line where its longest visible piece ends.
void draw_sky_grid(Canvas& canvas, Labels& labels, const std::vector<GridLine>& lines, double text_size);

}  // namespace omma::ground
