#include "components/tracker/sky_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace omma {
namespace {

constexpr int kGrid = 48;  // samples along each side of an image

double largest_angle(const std::vector<Eigen::Vector3d>& rays) {
  double smallest_cosine = 1;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (std::size_t k = i + 1; k < rays.size(); ++k) {
      smallest_cosine = std::min(smallest_cosine, rays[i].dot(rays[k]));
    }
  }
  return std::acos(std::max(smallest_cosine, -1.0));
}

}  // namespace

SkyCoverage sky_coverage(const Rig& rig, std::span<const PixelMask> masks) {
  SkyCoverage coverage;
  std::vector<Eigen::Vector3d> rig_rays;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const RigCamera& camera = rig.cameras[c];
    const bool masked = c < masks.size() && masks[c].any();
    const double width = double(camera.lens.width()) / kGrid;
    const double height = double(camera.lens.height()) / kGrid;
    std::vector<Eigen::Vector3d> rays;
    double solid_angle = 0;
    for (int row = 0; row < kGrid; ++row) {
      for (int column = 0; column < kGrid; ++column) {
        Eigen::Vector3d ray;
        Eigen::Matrix<double, 3, 2> by_pixel;
        const Eigen::Vector2d pixel((column + 0.5) * width - 0.5, (row + 0.5) * height - 0.5);
        if (!camera.lens.bearing(pixel, ray, by_pixel)) continue;
        const auto u = static_cast<int>(std::lround(pixel.x()));
        const auto v = static_cast<int>(std::lround(pixel.y()));
        if (masked && masks[c].any_in(u, v, u, v)) continue;
        solid_angle += by_pixel.col(0).cross(by_pixel.col(1)).norm() * width * height;
        const bool sparse = row % 4 == 0 || column % 4 == 0;  // plenty for the largest angle
        if (sparse) rays.push_back(camera.rig_from_camera.rotation * ray);
      }
    }
    coverage.fields.push_back(FieldMap(camera, masked ? &masks[c] : nullptr));
    coverage.solid_angle.push_back(std::min(solid_angle, 4 * std::numbers::pi));
    coverage.camera_angle = std::max(coverage.camera_angle, largest_angle(rays));
    for (std::size_t i = 0; i < rays.size(); i += 3) rig_rays.push_back(rays[i]);
  }
  coverage.rig_angle = std::max(coverage.camera_angle, largest_angle(rig_rays));
  return coverage;
}

}  // namespace omma
