// Orbit about the Earth: two bodies, and where wanted the secular drift that the Earth's flattening (J2)
// makes. Position and velocity at any time in closed form. Source: Vallado, Fundamentals of Astrodynamics and
// Applications, 4th ed. 2013, sections 2.2 (Kepler's equation) and 9.6 (secular rates).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace omma {

inline constexpr double kEarthRadius = 6378137.0;        ///< equatorial, WGS 84 [m]
inline constexpr double kEarthPolarRadius = 6356752.3;   ///< [m]
inline constexpr double kEarthGravity = 3.986004418e14;  ///< GM [m³/s²]
inline constexpr double kEarthJ2 = 1.08262668e-3;

/// Axes: J2000, whose equator is taken for the Earth's.
struct OrbitElements {
  double semi_major_axis = 7e6;    ///< [m]
  double eccentricity = 0;         ///< 0 to below 1
  double inclination = 0;          ///< [rad]
  double ascending_node = 0;       ///< right ascension [rad]
  double argument_of_perigee = 0;  ///< [rad]
  double true_anomaly = 0;         ///< at time 0 [rad]
  bool j2 = true;                  ///< node, perigee and mean anomaly drift
};

struct OrbitState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< from the centre of the Earth, J2000 axes [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// Elements of the orbit through a state, at whose time they are (Vallado, algorithm 9). Where it has no
/// perigee or no node these are put where the body, or the x axis, is.
/// @pre the body is bound to the Earth and moves across its vertical
OrbitElements elements_through(const OrbitState& state, bool j2);

class Orbit {
 public:
  explicit Orbit(const OrbitElements& elements);
  const OrbitElements& elements() const { return elements_; }
  OrbitState at(double time) const;                ///< [s] after that of the elements
  double period() const;                           ///< from perigee to perigee [s]
  double node_rate() const { return node_rate_; }  ///< of the ascending node [rad/s]

 private:
  OrbitElements elements_;
  double mean_anomaly_;  // at time 0
  double anomaly_rate_, node_rate_ = 0, perigee_rate_ = 0;
};

/// Axes that turn along the orbit: z to the centre of the Earth, y against the orbit's normal, x about along
/// the velocity. @return j2000_from_orbit
Eigen::Quaterniond orbit_axes(const OrbitState& state);
/// Turn of those axes against J2000, in those axes [rad/s]; the node's drift is left out.
Eigen::Vector3d orbit_axes_rate(const OrbitState& state);

}  // namespace omma
