#include "tests/bench/turning_rig.hpp"

#include <cmath>

namespace omma {
namespace {

constexpr int kFineSteps = 20;  // of the truth, in one interval of the gyro

}  // namespace

TurningRig::TurningRig(const TurningRigOptions& options, std::uint64_t seed)
    : options_(options), random_(seed * 0x9e3779b97f4a7c15ULL + 3) {
  Eigen::Vector4d q;
  q << gauss(), normal_(random_);
  q.normalize();
  attitude_.coeffs() = q;
  rate_ = options_.first_rate_sigma * gauss();
  bias_ = options_.first_bias_sigma * gauss();
}

Eigen::Vector3d TurningRig::gauss() {
  const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
  return {x, y, z};
}

const std::vector<GyroStep>& TurningRig::advance() {
  const int steps = options_.gyro ? options_.gyro_steps : 1;
  const double interval = options_.interval_s / steps;
  const double fine = interval / kFineSteps;
  measured_.clear();
  for (int step = 0; step < steps; ++step) {
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();  // by the true rate and the bias
    for (int i = 0; i < kFineSteps; ++i) {
      const Eigen::Vector3d before = rate_;
      rate_ += options_.acceleration_density * std::sqrt(fine) * gauss();
      const Eigen::Vector3d mean = 0.5 * (before + rate_);
      attitude_ = (rotation_exp(-fine * mean) * attitude_).normalized();
      turned += fine * (mean + bias_);
      if (options_.gyro) bias_ += options_.gyro_bias_walk * std::sqrt(fine) * gauss();
    }
    turned += options_.gyro_noise * std::sqrt(interval) * gauss();
    measured_.push_back({interval, turned / interval});
  }
  return measured_;
}

Eigen::Quaterniond TurningRig::measured_attitude() {
  // R_true = exp(δθ) R_measured
  const Eigen::Vector3d error = options_.attitude_sigma.cwiseProduct(gauss());
  return (rotation_exp(-error) * attitude_).normalized();
}

Eigen::Matrix3d TurningRig::attitude_covariance() const {
  return options_.attitude_sigma.cwiseAbs2().asDiagonal();
}

AttitudeFilterParameters TurningRig::filter_parameters() const {
  AttitudeFilterParameters parameters;
  parameters.gyro = options_.gyro;
  parameters.acceleration_density = options_.acceleration_density;
  parameters.gyro_noise = options_.gyro_noise;
  parameters.gyro_bias_walk = options_.gyro_bias_walk;
  parameters.first_rate_sigma = options_.first_rate_sigma;
  parameters.first_bias_sigma = options_.first_bias_sigma;
  return parameters;
}

Vector6d filter_error(const AttitudeFilter& filter, const TurningRig& rig, bool gyro) {
  Vector6d error;
  error << rotation_log(rig.attitude() * filter.rig_from_j2000().conjugate()),
      gyro ? Eigen::Vector3d(filter.gyro_bias() - rig.bias()) : Eigen::Vector3d(rig.rate() - filter.rate());
  return error;
}

}  // namespace omma
