// StarCatalogue: the sky as the cameras see it at one epoch: apparent places, stars that blend in a pixel
// merged to photocentres, and an index that finds the stars near a direction. Built at start-up; building
// allocates nothing, so it may also be rebuilt between frame sets when the epoch has moved on (about a
// millisecond).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "components/catalogue/observer.hpp"
#include "components/catalogue/sky_grid.hpp"
#include "components/catalogue/star.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct StarCatalogueParameters {
  float magnitude_limit = 6.5F;  ///< faintest V kept, of the blend where stars are merged
  /// Stars closer than this are one dot in the image [rad]; about two pixels. Zero: nothing is merged.
  double resolution = 0;
};

class StarCatalogue {
 public:
  static constexpr std::size_t kCapacity = 9216;  ///< more than the Bright Star Catalogue holds

  StarCatalogue() = default;
  StarCatalogue(const Observer& observer, const StarCatalogueParameters& parameters) noexcept {
    build(observer, parameters);
  }

  void build(const Observer& observer, const StarCatalogueParameters& parameters) noexcept;

  /// Apparent places, brightest first. With a ground site: those above the horizon.
  std::span<const SkyStar> stars() const noexcept { return stars_; }

  /// Calls `visit(index in stars())` for every star within `radius` [rad] of the unit vector `direction`;
  /// some visited lie outside it, none inside is left out.
  template <class Visit>
  void near(const Eigen::Vector3d& direction, double radius, Visit&& visit) const noexcept {
    grid_.near(direction, radius, visit);
  }

 private:
  StaticVector<SkyStar, kCapacity> stars_;
  SkyGrid<kCapacity> grid_;
};

}  // namespace omma
