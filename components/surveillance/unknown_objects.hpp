// Unknown objects: what moves through the frames and is neither a star, nor a planet, nor a target. Bearings
// and angular rates in J2000 axes, from all cameras together: the product for space surveillance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "config/sky_limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

/// What the path of an object since it was first seen says of it.
enum class ObjectMotion : std::uint8_t {
  kUndecided,     ///< its path is too short to tell
  kMoving,        ///< neither with the stars nor with the rig: satellites, debris, planets without an epoch
  kWithTheStars,  ///< stands among the stars: a nova, a star of no catalogue, something very far away
  kWithTheRig,    ///< stands in the image while the sky turns: a hot pixel, a reflection, a part of the
                  ///< spacecraft
};

/// Where an object was seen in this frame set, all cameras together.
struct ObjectBearing {
  bool seen = false;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector, J2000
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the direction, without the attitude's [rad²]
  float flux = 0;                                        ///< of the brightest dot [grey levels]
  float snr = 0;                                         ///< of the brightest dot
  std::array<std::int16_t, limits::kCameras> dot{};      ///< index in each camera's DotList; −1: none
};

struct UnknownObject {
  std::uint32_t number = 0;  ///< its identity: counts confirmed objects since start, from 1
  ObjectMotion motion = ObjectMotion::kUndecided;
  TimeNs first_seen_ns = 0;
  TimeNs last_seen_ns = 0;
  std::uint32_t sightings = 0;                                    ///< frame sets in which it was seen
  std::uint32_t missed = 0;                                       ///< frame sets in a row in which it was not
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();           ///< filtered, unit vector, J2000
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();           ///< of the direction [rad²]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();             ///< of the direction, across it [rad/s]
  Eigen::Matrix3d velocity_covariance = Eigen::Matrix3d::Zero();  ///< [rad²/s²]
  double score = 0;  ///< log of the odds that it is there over that chance made it
  ObjectBearing bearing;
};

struct UnknownObjects {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;  ///< exposure midpoint
  bool valid =
      false;  ///< false: no attitude, nothing was looked for; the objects are where they are expected
  std::uint32_t leftover_dots = 0;  ///< dots that nobody claims and no catalogue star explains
  std::uint32_t candidates = 0;     ///< tracks not confirmed
  std::uint32_t not_followed = 0;   ///< dots of this frame set for which there was no track left
  StaticVector<UnknownObject, limits::kUnknownObjects> objects;  ///< confirmed, by number
};

}  // namespace omma
