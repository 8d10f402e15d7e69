// The annotated photograph: the image stretched for the eye, a circle on every dot (found, paired, culled),
// star or target names, a grid of right ascension and declination through the lens, and a legend.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "components/geometry/lens.hpp"
#include "ground/draw/canvas.hpp"
#include "hal/image.hpp"

namespace omma::ground {

enum class MarkKind {
  kFound,   ///< a dot nobody claims (white)
  kPaired,  ///< paired and used (green)
  kCulled,  ///< paired, then dropped for its residual (red)
  kSolar,   ///< Sun, Moon or a planet (amber)
};

struct Mark {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< centre [px]
  MarkKind kind = MarkKind::kFound;
  std::string label;     ///< UTF-8; empty for none
  double radius_px = 0;  ///< of the circle; 0: the usual size
};

/// The sky as the camera sees it, for the grid.
struct SkyView {
  Lens lens;
  Eigen::Quaterniond camera_from_j2000 = Eigen::Quaterniond::Identity();
};

struct Annotation {
  std::string title;               ///< first line of the legend
  std::vector<std::string> lines;  ///< further lines of the legend
  std::vector<Mark> marks;         ///< labels are placed in this order, those without room are left out
  std::optional<SkyView> sky;      ///< draw the grid
};

/// Small images are enlarged by a whole factor so that names can be read; the legend is a strip below the
/// image.
/// @throws std::runtime_error when the image is empty
Canvas annotate(const ImageView& image, const Annotation& annotation);

}  // namespace omma::ground
