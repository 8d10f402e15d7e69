// Scenario: everything that a simulated recording is made from: rig, sensors, sky, moving bodies, Moon, time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/orbit.hpp"
#include "components/catalogue/star.hpp"
#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "config/limits.hpp"
#include "sim/gimbal.hpp"
#include "sim/ground.hpp"
#include "sim/motion.hpp"
#include "sim/sensor.hpp"
#include "sim/sky_scene.hpp"

namespace omma::sim {

/// A flat rectangle of a body, its outside towards +z of its own axes.
struct Face {
  Pose body_from_face;
  double width = 0;   ///< along x [m]
  double height = 0;  ///< along y [m]
};

/// Surfaces that the Sun lights (Lambert's law): shares of its light that they send back.
struct Printed {
  double plate = 0.05;
  double disc = 0.9;
  double ambient = 60;  ///< of a white surface in the shade [V mag / arcsec²]
};

/// Lamps instead of discs. Light falls as cosᵐ of the angle from their axis (generalised Lambertian source).
struct Led {
  double magnitude = 0;  ///< V, seen from 1 m on the axis
  double order = 1;      ///< m: 1 is an even disc
};

/// A body with targets: a docking card (one plate about the origin of the body frame, x right, y up, z
/// towards the viewer), or several faces of a spacecraft. Discs are parallel to their face, centred on the
/// targets.
struct Card {
  TargetBody body;
  std::filesystem::path target_file;
  Motion motion;  ///< frame_from_body
  bool inertial =
      false;  ///< the frame of `motion` has J2000's axes about the rig's origin; else it is the rig's
  std::optional<Orbit>
      orbit;                ///< its own, and the rig has one too: takes the place of the motion's positions
  std::vector<Face> faces;  ///< at least one
  std::vector<std::uint8_t> face_of;  ///< each target's, an index of `faces`
  double plate_magnitude = 0;         ///< surface brightness, the same from all sides [V mag / arcsec²]
  double disc_magnitude = 0;          ///< [V mag / arcsec²]
  std::optional<Printed> printed;     ///< instead of these, lit by the Sun
  std::optional<Led> led;             ///< targets of type 1 are lamps
  double disc_diameter = 0;           ///< [m]
};

/// The face each target is on: the one it lies nearest to among those that face as its normal does.
std::vector<std::uint8_t> faces_of(const TargetBody& body, const std::vector<Face>& faces);

/// What the rig's motion is told against.
enum class RigFrame : std::uint8_t {
  kJ2000,
  kGround,  ///< x east, y north, z up at the ground's site
  kOrbit,   ///< orbit_axes
};

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
  RigFrame rig_frame = RigFrame::kJ2000;
  Motion rig_motion;  ///< frame_from_rig, rotation only
  /// Carries the rig: turns it from there, home_from_rig.
  std::shared_ptr<const GimbalRun> gimbal;
  /// The rig stands turned from its motion by this: a gimbal's lash, another in each trial (rig axes).
  Eigen::Quaterniond rig_turn = Eigen::Quaterniond::Identity();
  std::vector<Card> cards;
  std::optional<Disc> moon;
  std::optional<Disc> sun;       ///< the Moon is lit by it where there are both, else full
  bool solar_system = false;     ///< Sun, Moon and planets where they are at each frame's time, not the above
  std::optional<Ground> ground;  ///< none in orbit
  std::optional<Orbit> orbit;    ///< none in a laboratory, or where only the stars matter
  EarthLook earth;               ///< seen in orbit only

  /// Frames after which the brackets of all sensors begin anew; 1 without any.
  std::size_t bracket_length() const;
  /// The same scenario with the exposures of a frame.
  Scenario exposed(std::uint64_t frame) const;
  double time_of(std::uint64_t frame) const { return static_cast<double>(frame) / frame_rate; }  ///< [s]
};

/// Where everything is at one instant.
struct SceneInstant {
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rig_rate = Eigen::Vector3d::Zero();   ///< of the rig, rig frame [rad/s]
  std::vector<Pose> rig_from_body;                      ///< of the cards, in their order
  std::vector<Eigen::Vector3d> body_rate;               ///< their turn against J2000, body axes [rad/s]
  Eigen::Vector3d up_rig = Eigen::Vector3d::Zero();     ///< zenith, on the ground
  Eigen::Vector3d north_rig = Eigen::Vector3d::Zero();  ///< where the ground's site is told
};

/// @param time  [s] since the first frame
SceneInstant scene_at(const Scenario& scenario, double time);

/// Apparent places of the stars to V = `faintest` at the scenario's epoch, none merged: the Bright Star
/// Catalogue and what it leaves out (faint_stars.hpp).
std::vector<SkyStar> sky_of(const Scenario& scenario);

}  // namespace omma::sim
