// Stars: the compiled-in Bright Star Catalogue (Hoffleit & Warren 1991, CDS V/50) and apparent directions.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace omma {

/// One catalogue entry, epoch and equinox J2000.0.
struct CatalogueStar {
  std::uint16_t hr;        ///< number in the Bright Star Catalogue
  float magnitude;         ///< V
  double right_ascension;  ///< [rad]
  double declination;      ///< [rad]
  float pm_ra_cosdec;      ///< proper motion in right ascension times cos δ [rad / Julian year]
  float pm_dec;            ///< proper motion in declination [rad / Julian year]
};

/// The whole table, 9096 stars, brightest first; unpacked into static storage by the first call (start-up).
std::span<const CatalogueStar> bright_star_catalogue() noexcept;

/// The CRC-32 of the compiled-in table is the one its generator wrote.
bool bright_star_catalogue_intact() noexcept;

/// A star as it is to be seen: what identification, tracking and the solver work with.
struct SkyStar {
  Eigen::Vector3d direction;  ///< unit vector, J2000 axes, apparent place at the epoch asked for
  float magnitude = 0;        ///< V (of the blend where stars were merged)
  std::uint16_t hr = 0;       ///< of the brightest component
};

}  // namespace omma
