// Apparent place: the direction in which a catalogue star is seen, in J2000 axes: proper motion, aberration
// and, from the ground, refraction. Left out because they are below 1": parallax (0.76" at most), bending of
// light (0.004" at 90° from the Sun), radial motion.
#pragma once

#include <Eigen/Geometry>

#include "components/catalogue/observer.hpp"
#include "components/catalogue/star.hpp"

namespace omma {

/// Unit vector of a star at the catalogue's epoch, J2000 axes.
Eigen::Vector3d j2000_direction(const CatalogueStar& star) noexcept;

/// International Standard Atmosphere below 11 km. @param height [m] @return [K]; [hPa]
double standard_temperature(double height) noexcept;
double standard_pressure(double height) noexcept;

/// Refraction of a star at the true altitude `altitude` [rad], ≥ −1°: how much higher it is seen [rad].
/// Sæmundsson (Sky and Telescope 72, 70, 1986; Meeus ch. 16), consistent with Bennett's to 0.1': good to
/// 4" above 15° for the given air, whose density it scales with.
double refraction(double altitude, double pressure_hpa, double temperature_k) noexcept;

/// Everything that depends on the observer alone, worked out once; then cheap per star.
class ApparentPlace {
 public:
  explicit ApparentPlace(const Observer& observer) noexcept;

  /// @param direction  unit vector, J2000 axes
  /// @return false for a star below the horizon of the ground site (more than 1° before refraction)
  bool direction(const CatalogueStar& star, Eigen::Vector3d& direction) const noexcept;

  /// The same for what is not a star: the unit vector along which it stands (light time allowed for) becomes
  /// that along which it is seen: aberration and, from the ground, refraction.
  /// @return false below the horizon of the ground site, as above
  bool observe(Eigen::Vector3d& direction) const noexcept;

  /// The same for a direction that is seen so from the centre of the Earth: what the observer's own velocity
  /// and, from the ground, refraction add to it.
  bool observe_from_centre(Eigen::Vector3d& direction) const noexcept;

  /// Of the ground site from the centre of the Earth, J2000 axes [m]; zero without one.
  const Eigen::Vector3d& position() const { return position_; }
  /// Local vertical in J2000 axes; meaningful with a ground site only.
  const Eigen::Vector3d& zenith() const { return zenith_; }

 private:
  bool refracted(Eigen::Vector3d& direction) const noexcept;

  double years_ = 0;  // since J2000.0
  Eigen::Vector3d velocity_over_c_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d own_over_c_ = Eigen::Vector3d::Zero();  // its part about the centre of the Earth
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  bool refracts_ = false;
  Eigen::Vector3d zenith_ = Eigen::Vector3d::UnitZ();
  double pressure_ = 0;     // [hPa]
  double temperature_ = 0;  // [K]
};

}  // namespace omma
