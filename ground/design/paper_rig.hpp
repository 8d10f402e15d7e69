// A rig on paper: its cameras, and how much of each image the lens lights. A lens model reaches to the
// corners of the image; a fisheye's image circle may not.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "components/geometry/rig.hpp"

namespace omma::ground {

struct PaperRig {
  Rig rig;
  std::vector<double> half_field;  ///< of each camera's image circle [rad]; π: as far as the model goes

  /// @param direction  from the camera, camera frame, any length
  bool sees(std::size_t camera, const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const {
    const double off_axis = std::atan2(direction.head<2>().norm(), direction.z());
    return off_axis <= half_field[camera] && rig.cameras[camera].lens.project(direction, pixel);
  }
  /// Largest angle off axis that the camera sees [rad].
  double reach(std::size_t camera) const {
    return std::min(half_field[camera], rig.cameras[camera].lens.max_angle());
  }
};

inline PaperRig whole_images(const Rig& rig) {
  return {rig, std::vector<double>(rig.cameras.size(), std::numbers::pi)};
}

/// @param fields_deg  full field of view of the image circles [degrees]: none, one, or one a camera
/// @throws InputError for another number of fields
PaperRig with_fields(const Rig& rig, const std::vector<double>& fields_deg);

}  // namespace omma::ground
