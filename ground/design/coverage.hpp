// What a rig with its real lenses and sensors sees of the sphere at one distance: how many cameras see each
// direction, the blind spots, and the distance beyond which nothing is blind.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ground/design/needed_field.hpp"
#include "ground/design/paper_rig.hpp"

namespace omma::ground {

/// Number of cameras of the rig that see the point `distance` away from the rig's origin.
int cameras_seeing(const PaperRig& paper, const Eigen::Vector3d& direction, double distance);

/// A connected part of the sphere that no camera sees.
struct BlindSpot {
  Eigen::Vector3d middle = Eigen::Vector3d::UnitZ();  ///< unit, rig frame
  double share = 0;                                   ///< of the sphere
};

struct Coverage {
  double distance = kInfinitelyFar;
  std::array<double, limits::kCameras + 1> share{};  ///< of the sphere seen by exactly so many cameras
  std::vector<BlindSpot> blind;                      ///< largest first
  double seen() const { return 1 - share[0]; }
};

/// On directions 0.7° apart; smaller blind spots may be missed.
Coverage coverage_of(const PaperRig& paper, double distance);

/// Least distance from which on every direction (0.7° apart) is seen [m], to 1 %; none where the rig is blind
/// somewhere at infinity.
std::optional<double> whole_sky_beyond(const PaperRig& paper);

/// Counts on a map of longitude (+180° left to −180° right) by latitude (north up), rig frame, row by row.
struct CoverageMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cameras;
};
CoverageMap coverage_map(const PaperRig& paper, double distance, int width);

/// Direction of a point of such a map.
Eigen::Vector3d map_direction(double u, double v, int width, int height);
/// Its inverse.
Eigen::Vector2d map_place(const Eigen::Vector3d& direction, int width, int height);

}  // namespace omma::ground
