// Rotations as three angles for people to read; nothing computes with them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace omma {

/// R = Rz(yaw) Ry(pitch) Rx(roll) [rad].
struct YawPitchRoll {
  double yaw;
  double pitch;
  double roll;
};

inline YawPitchRoll yaw_pitch_roll(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d r = q.toRotationMatrix();
  return {std::atan2(r(1, 0), r(0, 0)), std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
          std::atan2(r(2, 1), r(2, 2))};
}

/// Unit vector of a right ascension and a declination [rad].
inline Eigen::Vector3d direction_at(double right_ascension, double declination) {
  const double c = std::cos(declination);
  return {c * std::cos(right_ascension), c * std::sin(right_ascension), std::sin(declination)};
}

/// Where the z axis of a camera or rig points, and how its image stands [rad].
struct Pointing {
  double right_ascension;  ///< 0 to 2π
  double declination;
  double roll;  ///< position angle of the image's up direction (−y), from north over east, 0 to 2π
};

inline Pointing pointing(const Eigen::Quaterniond& camera_from_j2000) {
  const Eigen::Matrix3d j2000_from_camera = camera_from_j2000.conjugate().toRotationMatrix();
  const Eigen::Vector3d axis = j2000_from_camera.col(2);
  const Eigen::Vector3d up = -j2000_from_camera.col(1);
  const auto wrapped = [](double angle) { return angle < 0 ? angle + 2 * M_PI : angle; };
  const double ra = wrapped(std::atan2(axis.y(), axis.x()));
  const double dec = std::asin(std::clamp(axis.z(), -1.0, 1.0));
  const Eigen::Vector3d north(-std::sin(dec) * std::cos(ra), -std::sin(dec) * std::sin(ra), std::cos(dec));
  const Eigen::Vector3d east(-std::sin(ra), std::cos(ra), 0);
  return {ra, dec, wrapped(std::atan2(up.dot(east), up.dot(north)))};
}

}  // namespace omma
