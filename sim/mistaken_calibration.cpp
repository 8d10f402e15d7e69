#include "sim/mistaken_calibration.hpp"

#include <cmath>
#include <numbers>

#include "components/geometry/pose.hpp"

namespace omma {
namespace {

/// The angle off the axis that the believed lens reads where the true one sees `angle`.
double angle_read(double angle, const CameraMistake& mistake) {
  double read = angle;
  for (int i = 0; i < 20; ++i) {
    const double part = read / (0.5 * std::numbers::pi);
    read = angle / (1 + mistake.lens_scale + mistake.lens_bend * part * part);
  }
  return read;
}

}  // namespace

Eigen::Vector3d normal_vector(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const double x = gauss(random), y = gauss(random), z = gauss(random);
  return {x, y, z};
}

MistakenCalibration draw_mistakes(const CalibrationError& sigma, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  MistakenCalibration mistakes;
  for (CameraMistake& camera : mistakes.cameras) {
    camera.rotation = sigma.camera_rotation * normal_vector(random);
    camera.position = sigma.camera_position * normal_vector(random);
    camera.lens_scale = sigma.lens_scale * gauss(random);
    camera.lens_bend = sigma.lens_bend * gauss(random);
  }
  for (Eigen::Vector3d& target : mistakes.targets) target = sigma.survey * normal_vector(random);
  mistakes.body_scale = 1 + sigma.survey_scale * gauss(random);
  return mistakes;
}

Eigen::Vector3d believed_ray(const CameraMistake& mistake, const Eigen::Vector3d& axis,
                             const Eigen::Vector3d& ray) {
  const Eigen::Vector3d true_axis = rotation_exp(mistake.rotation) * axis;
  const Eigen::Vector3d about = true_axis.cross(ray);
  const double angle = std::atan2(about.norm(), true_axis.dot(ray));
  const Eigen::Vector3d read =
      rotation_exp((angle_read(angle, mistake) - angle) * about.stableNormalized()) * ray;
  return rotation_exp(-mistake.rotation) * read;
}

}  // namespace omma
