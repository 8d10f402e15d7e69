// A rig of one camera for tests of the simulator, and what it sees.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "components/catalogue/observer.hpp"
#include "sim/camera_renderer.hpp"

namespace omma::sim {

inline constexpr double kDegree = M_PI / 180;

/// 400 × 400 pixels, 150 a radian, 160 degrees; a linear sensor that never fills. Looks along J2000's x axis,
/// right is −y, down −z; 2026 begins; no star is bright enough.
inline Scenario one_camera() {
  Scenario scenario;
  scenario.name = "test";
  RigCamera camera;
  camera.name = Name("cam0");
  camera.lens = Lens::equidistant(400, 400, 150, {199.5, 199.5}, 1.5);
  scenario.rig.cameras.push_back(camera);
  Sensor& sensor = scenario.sensors[0];
  sensor.bits = 14;
  sensor.exposure = 0.1;
  sensor.zero_point = 1e4;
  sensor.full_well = 1e30;
  sensor.gain = 1e10;
  sensor.field = 160 * kDegree;
  scenario.faintest = -5;
  scenario.frames = 1;
  scenario.truth_minimum_snr = 0;
  scenario.julian_date_utc = parse_utc("2026-01-01T00:00:00Z");
  Eigen::Matrix3d j2000_from_rig;
  j2000_from_rig << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  scenario.rig_motion = Motion::constant({Eigen::Quaterniond(j2000_from_rig), Eigen::Vector3d::Zero()},
                                         Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  return scenario;
}

/// Turns the camera's axis to a direction of J2000, its top about to the north.
inline void look_along(Scenario& scenario, const Eigen::Vector3d& direction) {
  Eigen::Matrix3d axes;
  axes.col(2) = direction.normalized();
  axes.col(0) = axes.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  scenario.rig_motion = Motion::constant({Eigen::Quaterniond(axes), Eigen::Vector3d::Zero()},
                                         Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
}

struct Drawn {
  std::vector<float> electrons;  ///< 400 × 400
  std::vector<SpotTruth> truth;

  double sum() const { return std::accumulate(electrons.begin(), electrons.end(), 0.0); }
  float at(int u, int v) const { return electrons[static_cast<std::size_t>(v * 400 + u)]; }
};

inline Drawn draw(const Scenario& scenario, std::span<const SkyStar> stars = {}) {
  const CameraView view(scenario.rig.cameras[0], scenario.sensors[0], 1, 0);
  CameraRenderer renderer(scenario, stars, view, 0);
  renderer.draw(0);
  Drawn drawn;
  drawn.electrons.assign(renderer.mean_electrons().begin(), renderer.mean_electrons().end());
  renderer.truth(drawn.truth);
  return drawn;
}

}  // namespace omma::sim
