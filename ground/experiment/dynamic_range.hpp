// The dynamic-range experiment (Miller §13.5): the dimmest star in sequences of a logarithmic camera's images
// against its blacklevel, with and without a lamp as bright as the Sun on the lens, by the dissertation's
// extraction and by ours; and the blacklevel at which a card can be seen while the lamp crosses the field.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/star.hpp"
#include "components/extractor/classical/grey_image.hpp"
#include "sim/scenario.hpp"

namespace omma::ground {

/// A star that should be in the images, inside the part of the sky that is judged.
struct WantedStar {
  std::uint16_t hr = 0;
  float magnitude = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// How faint one way of looking goes.
struct Limit {
  std::string name;
  double dimmest = 0;  ///< V of the faintest star found
  double half = 0;     ///< V that parts found from missed stars with the fewest exceptions
  int found = 0;       ///< stars
  double chance = 0;   ///< share of empty places (a star's, moved by a few pixels) that hold a dot as well
};

/// What a sequence of images of the same sky showed.
struct SequenceResult {
  std::string name;
  double gain = 0;
  double blacklevel = 0;
  bool lamp = false;
  double background = 0;  ///< mean grey level of the part judged
  double saturated = 0;   ///< share of the image at white
  int stars = 0;          ///< wanted
  std::vector<Limit> limits;
  GreyImage average;  ///< of the images less the black frame
  GreyImage darken;   ///< the darkest of each pixel
};

/// One sequence as images: recorded or rendered.
struct Sequence {
  std::vector<GreyImage> images;
  GreyImage black_frame;  ///< mean of images with the lens covered; empty: none
  double white_level = 0;
};

/// @param centre, radius  part of the sky that is judged (J2000, unit; [rad])
/// @return stars to V 7 whose place in the image is told by lens and attitude, no brighter one within 4 px
std::vector<WantedStar> wanted_stars(std::span<const SkyStar> stars, const Lens& lens,
                                     const Eigen::Matrix3d& camera_from_j2000, double field,
                                     const Eigen::Vector3d& centre, double radius);

SequenceResult judge(const Sequence& sequence, const std::vector<WantedStar>& wanted);

/// The largest blacklevel at which the card of a scenario is not white, with the lamp at an angle off axis.
struct TransitPoint {
  double lamp_angle = 0;           ///< [rad]
  double blacklevel = 0;           ///< largest
  double plate_over_dark = 0;      ///< light on the plate over the dark current
  double disc_contrast_sigma = 0;  ///< of a disc's centre against the plate, in deviations of one pixel
};

/// @param scenario  with a logarithmic camera 0 and a card; the card keeps its angle from the lamp
std::vector<TransitPoint> lamp_transit(const sim::Scenario& scenario, const std::vector<double>& angles);

struct DynamicRangeResult {
  std::vector<SequenceResult> sequences;
  std::vector<TransitPoint> transit;
  bool recorded = false;
};

std::string dynamic_range_text(const DynamicRangeResult& result);
std::string dynamic_range_json(const DynamicRangeResult& result);
std::string dynamic_range_page(const DynamicRangeResult& result);
/// The composites as PNG, for the page and beside it: "<sequence>_average.png" and "_darken.png".
std::vector<std::uint8_t> composite_png(const GreyImage& composite);

}  // namespace omma::ground
