// CameraView: what one camera of the rig looks through, worked out once: rays of the pixels' corners, the
// light that reaches each pixel, and what the sensor shows without anything in the sky.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "components/geometry/rig.hpp"
#include "sim/point_spread.hpp"
#include "sim/sensor.hpp"

namespace omma::sim {

class CameraView {
 public:
  /// @param seed, index  choose the hot pixels: the same for every frame of the camera
  CameraView(const RigCamera& camera, const Sensor& sensor, std::uint64_t seed, int index);

  const RigCamera& camera() const { return camera_; }
  const Sensor& sensor() const { return sensor_; }
  const PointSpread& point_spread() const { return point_spread_; }
  int width() const { return camera_.lens.width(); }
  int height() const { return camera_.lens.height(); }

  /// Share of the light kept at a direction (camera frame, unit), 0 outside the field.
  double transmission(const Eigen::Vector3d& direction) const;
  /// Pixel and transmission of a direction (camera frame, unit); false where the camera does not see it.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel, double& transmission) const;

  // One value a pixel, row by row.
  /// Share of an even surface's light that its pixels keep, the part of them that sees nothing taken off.
  const std::vector<float>& transmissions() const { return transmission_; }
  const std::vector<float>& solid_angles() const { return solid_angle_; }  ///< [sr]
  const std::vector<float>& dark() const {
    return dark_;
  }  ///< electrons of one exposure, hot pixels included
  const std::vector<float>& base() const { return base_; }  ///< the same with the light of the empty sky
  /// Of the pixels themselves [grey levels]; empty where they are alike.
  const std::vector<float>& offsets() const { return offset_; }
  /// (width + 1) × (height + 1) unit rays (camera frame) of the pixels' corners; zero where the lens has
  /// none.
  const std::vector<Eigen::Vector3f>& corner_rays() const { return corner_rays_; }

  /// Electrons of one exposure from a star of magnitude `v` on the optical axis; per steradian, from a
  /// surface of `v` magnitudes per square arcsecond.
  double star_electrons(double v) const;
  double surface_electrons(double v) const;

 private:
  void trace_corners();
  void light_pixels();
  void heat_pixels(std::uint64_t seed, int index);

  RigCamera camera_;
  Sensor sensor_;
  PointSpread point_spread_;
  double cos_edge_;  // of the half field
  std::vector<Eigen::Vector3f> corner_rays_;
  std::vector<float> transmission_, solid_angle_, dark_, base_, offset_;
};

}  // namespace omma::sim
