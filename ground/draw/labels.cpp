#include "ground/draw/labels.hpp"

#include <algorithm>
#include <array>

namespace omma::ground {

bool Labels::is_free(const Box& box) const {
  if (box.left < 2 || box.top < 2 || box.right > canvas_.width() - 3 || box.bottom > canvas_.height() - 3) {
    return false;
  }
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return other.overlaps(box); });
}

bool Labels::place(const Eigen::Vector2d& mark, double mark_radius, std::string_view utf8, double size,
                   const Colour& colour) {
  const Box at_origin = canvas_.text_box(Eigen::Vector2d::Zero(), utf8, size);
  const double width = at_origin.right - at_origin.left;
  const double height = at_origin.bottom - at_origin.top;
  const double gap = mark_radius + 0.3 * size;
  const double slant = 0.7 * mark_radius + 0.15 * size;
  // Left edge and top edge of the text relative to the mark: right, left, above, below, then the corners.
  const std::array<Eigen::Vector2d, 8> places{{{gap, -height / 2},
                                               {-gap - width, -height / 2},
                                               {-width / 2, -gap - height},
                                               {-width / 2, gap},
                                               {slant, -slant - height},
                                               {slant, slant},
                                               {-slant - width, -slant - height},
                                               {-slant - width, slant}}};
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Vector2d corner = mark + place;
    const Box box{corner.x(), corner.y(), corner.x() + width, corner.y() + height};
    if (!is_free(box.grown(1.5))) continue;
    canvas_.text(corner - Eigen::Vector2d(at_origin.left, at_origin.top), utf8, size, colour);
    taken_.push_back(box.grown(1.5));
    return true;
  }
  return false;
}

}  // namespace omma::ground
