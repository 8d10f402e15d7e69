#include "sim/exposure.hpp"

namespace omma::sim {

double exposure_instant(const Sensor& sensor, double midpoint, int sample) {
  return midpoint + sensor.exposure * ((sample + 0.5) / sensor.blur_samples - 0.5);
}

ExposureShift exposure_shift(const Scenario& scenario, std::size_t camera, double midpoint) {
  const Sensor& sensor = scenario.sensors[camera];
  const SceneInstant middle = scene_at(scenario, midpoint);
  ExposureShift shift;
  shift.bodies.assign(scenario.cards.size(), Vector6d::Zero());
  const double share = 1.0 / sensor.blur_samples;
  for (int k = 0; k < sensor.blur_samples; ++k) {
    const SceneInstant drawn = scene_at(scenario, exposure_instant(sensor, midpoint, k));
    shift.turn += share * rotation_log(drawn.rig_from_j2000 * middle.rig_from_j2000.conjugate());
    for (std::size_t c = 0; c < shift.bodies.size(); ++c) {
      const Pose& at = drawn.rig_from_body[c];
      const Pose& from = middle.rig_from_body[c];
      shift.bodies[c].head<3>() += share * rotation_log(at.rotation * from.rotation.conjugate());
      shift.bodies[c].tail<3>() += share * (at.translation - from.translation);
    }
  }
  return shift;
}

}  // namespace omma::sim
