// Scenario: everything that a simulated recording is made from: rig, sensors, sky, moving bodies, Moon, time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/star.hpp"
#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "config/limits.hpp"
#include "sim/ground.hpp"
#include "sim/motion.hpp"
#include "sim/sensor.hpp"

namespace omma::sim {

/// A docking card: a rectangular plate about the origin of the body frame (x right, y up, z towards the
/// viewer) with discs parallel to it, centred on the targets. Surfaces shine evenly in all directions.
struct Card {
  TargetBody body;
  std::filesystem::path target_file;
  Motion motion;  ///< frame_from_body
  bool inertial =
      false;          ///< the frame of `motion` has J2000's axes about the rig's origin; else it is the rig's
  double width = 0;   ///< of the plate, along x [m]
  double height = 0;  ///< along y [m]
  double plate_magnitude = 0;  ///< surface brightness [V mag / arcsec²]
  double disc_magnitude = 0;   ///< [V mag / arcsec²]
  double disc_diameter = 0;    ///< [m]
};

/// A round luminous body at infinity: the Moon, or the Sun.
struct Disc {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector, J2000 axes
  double diameter = 0;                                   ///< [rad]
  double magnitude = 0;                                  ///< V, of the whole disc
};

/// V of the Moon at a phase angle (0: full). Allen, Astrophysical Quantities, 1976, section 66.
double moon_magnitude(double phase_angle);
/// Angle at the Moon between Sun and Earth, the Sun being very far [rad].
double phase_angle(const Eigen::Vector3d& to_moon, const Eigen::Vector3d& to_sun);

struct Scenario {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path rig_file;
  Rig rig;
  std::array<Sensor, limits::kCameras> sensors;  ///< of the rig's cameras, in their order
  double julian_date_utc = 0;                    ///< of the first frame's exposure midpoint
  std::string epoch_utc;                         ///< the same as it was written
  double frame_rate = 10;                        ///< [Hz]
  int frames = 0;
  std::uint64_t seed = 1;
  double faintest = 6.5;         ///< V of the faintest star drawn
  double truth_minimum_snr = 3;  ///< spots below this are drawn but not told
  Motion rig_motion;             ///< j2000_from_rig, rotation only
  /// The rig stands turned from its motion by this: a gimbal's lash, another in each trial (rig axes).
  Eigen::Quaterniond rig_turn = Eigen::Quaterniond::Identity();
  std::vector<Card> cards;
  std::optional<Disc> moon;
  std::optional<Disc> sun;       ///< the Moon is lit by it where there are both, else full
  std::optional<Ground> ground;  ///< none in orbit

  double time_of(std::uint64_t frame) const { return static_cast<double>(frame) / frame_rate; }  ///< [s]
};

/// Where everything is at one instant.
struct SceneInstant {
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rig_rate = Eigen::Vector3d::Zero();  ///< of the rig, rig frame [rad/s]
  std::vector<Pose> rig_from_body;                     ///< of the cards, in their order
};

/// @param time  [s] since the first frame
SceneInstant scene_at(const Scenario& scenario, double time);

/// Apparent places of the stars to V = `faintest` at the scenario's epoch, none merged.
std::vector<SkyStar> sky_of(const Scenario& scenario);

}  // namespace omma::sim
