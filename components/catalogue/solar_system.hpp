// Sun, Moon and planets: where they are seen, how bright and how large, by analytic theories (ERFA, the
// astronomers' library derived from the IAU's SOFA): the Earth by VSOP2000 (epv00), the planets by Simon et
// al. (1994, plan94), the Moon by Meeus' abridged ELP (moon98). Magnitudes: Meeus, Astronomical Algorithms,
// ch. 41 and 48.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "components/catalogue/observer.hpp"

namespace omma {

enum class SolarBody : std::uint8_t {
  kSun,
  kMoon,
  kMercury,
  kVenus,
  kMars,
  kJupiter,
  kSaturn,
  kUranus,
  kNeptune,
};
inline constexpr std::size_t kSolarBodies = 9;

/// "Venus"
std::string_view solar_body_name(SolarBody body) noexcept;
/// The same by number; "?" where there is none of it.
std::string_view solar_body_name(std::uint16_t number) noexcept;

struct SolarBodyPlace {
  SolarBody body = SolarBody::kSun;
  bool up = true;  ///< false: below the horizon of the ground site
  /// Unit vector, J2000 axes, apparent: light time, parallax, aberration, refraction. Rounded to 2⁻³⁶ (3
  /// µas), so that processors whose multiply-add differs in the last bit agree.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  double distance = 0;  ///< from the observer [m]
  double radius = 0;    ///< of the disc [rad]
  double sigma = 0;  ///< of the direction, each axis: the theory's rms error, and an unknown parallax [rad]
  float magnitude = 0;  ///< V
};

using SolarSystem = std::array<SolarBodyPlace, kSolarBodies>;

/// How far the observer may stand from where it is said to be, each axis: a low orbit nobody told about [m].
inline constexpr double kUnknownOrbit = 4.0e6;

/// All nine, in the order of SolarBody. Nothing is allocated.
/// @param observer        with the epoch; a site gives its parallax: 1° of the Moon's
/// @param position_sigma  of the observer's position, each axis [m]
/// @param position        of the observer from the centre of the Earth, J2000 axes [m]; unknown: the site's,
/// else
///                        the centre itself
/// @pre the epoch is known
SolarSystem solar_system(const Observer& observer, double position_sigma,
                         const std::optional<Eigen::Vector3d>& position = {}) noexcept;

}  // namespace omma
