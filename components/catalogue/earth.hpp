// Earth: its velocity (annual aberration), its axis (precession, nutation) and its turning (sidereal time),
// each to the arcsecond or better that star directions from a camera need. Years 1900 to 2100.
#pragma once

#include <Eigen/Core>

namespace omma {

/// Terrestrial Time minus UTC [days]. Since 2017 it is 69.184 s; in 1900–2100 it stays within two minutes of
/// that, in which nothing here changes by 0.001".
inline constexpr double kTerrestrialMinusUtc = 69.184 / 86400.0;

/// Julian centuries since J2000.0.
double julian_centuries(double julian_date) noexcept;

/// Heliocentric velocity of the Earth over the speed of light, J2000 equatorial axes. From the Sun's
/// low-precision longitude (Meeus, Astronomical Algorithms, ch. 25, 0.01°) and the velocity of a Kepler
/// ellipse (ch. 23): good to 0.02" of aberration, most of it the Sun's own motion about the barycentre (13
/// m/s).
/// @param t  Julian centuries of TT since J2000.0
Eigen::Vector3d earth_velocity_over_c(double t) noexcept;

/// Rotation that takes J2000 coordinates to the mean equator and equinox of date (IAU 1976, Lieske; Meeus
/// ch. 21). @param t Julian centuries of TT
Eigen::Matrix3d mean_of_date_from_j2000(double t) noexcept;

/// The same to the true equator and equinox of date: with the four largest terms of nutation (Meeus ch. 22,
/// 0.5").
Eigen::Matrix3d true_of_date_from_j2000(double t) noexcept;

/// Greenwich apparent sidereal time [rad], in [0, 2π) (Meeus ch. 12). UT1 is taken as UTC: within 0.9 s, 14".
double greenwich_sidereal_time(double julian_date_utc) noexcept;

}  // namespace omma
