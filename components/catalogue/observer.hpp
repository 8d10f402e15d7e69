// Observer: when and from where the sky is looked at, and the readers for both as an operator types them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace omma {

/// A place on the ground. Its atmosphere refracts; a standard one unless pressure or temperature are known.
struct GroundSite {
  double latitude = 0;                ///< geodetic, north positive [rad]
  double longitude = 0;               ///< east positive [rad]
  double height = 0;                  ///< above the ellipsoid [m]
  std::optional<double> pressure;     ///< at the site [hPa]
  std::optional<double> temperature;  ///< at the site [K]
};

struct Observer {
  /// UTC as a Julian date. Without it: J2000.0 catalogue positions as they stand.
  std::optional<double> julian_date_utc;
  /// Velocity relative to the centre of the Earth, J2000 axes [m/s]; zero where unknown.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /// Refraction and diurnal aberration apply when given (needs the epoch as well).
  std::optional<GroundSite> site;
};

/// Julian date of a Gregorian calendar date (Meeus, Astronomical Algorithms, ch. 7). @param day with fraction
double julian_date(int year, int month, double day) noexcept;

/// Reads "2020-12-11T20:09:33Z": the T may be a blank, seconds may have a fraction or be missing, so may the
/// time of day and the Z. @return Julian date, UTC @throws InputError (file and line of the text are not
/// known: the field says "epoch")
double parse_utc(std::string_view text);
/// The same text. @return nanoseconds since 1970-01-01 UTC, leap seconds not counted; to the microsecond
std::int64_t parse_utc_ns(std::string_view text);

/// Reads "LAT,LON,HEIGHT" or "LAT,LON": degrees, north and east positive, metres. @throws InputError
GroundSite parse_ground_site(std::string_view text);

}  // namespace omma
