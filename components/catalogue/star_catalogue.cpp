#include "components/catalogue/star_catalogue.hpp"

#include <algorithm>
#include <cmath>

#include "components/catalogue/apparent_place.hpp"

namespace omma {
namespace {

float brightness(float magnitude) {
  return std::pow(10.0F, -0.4F * magnitude);
}

}  // namespace

void StarCatalogue::build(const Observer& observer, const StarCatalogueParameters& parameters) noexcept {
  // Single stars first, all of them: a star too faint to be seen still pulls a photocentre.
  stars_.clear();
  const ApparentPlace place(observer);
  for (const CatalogueStar& star : bright_star_catalogue()) {
    SkyStar seen;
    if (!place.direction(star, seen.direction)) continue;
    seen.magnitude = star.magnitude;
    seen.hr = star.hr;
    if (!stars_.push_back(seen)) break;
  }
  const auto direction = [&](std::size_t i) -> const Eigen::Vector3d& { return stars_[i].direction; };

  if (parameters.resolution > 0) {
    grid_.build(stars_.size(), direction);
    const double near_enough = std::cos(parameters.resolution);
    for (std::size_t i = 0; i < stars_.size(); ++i) {
      SkyStar& brightest = stars_[i];
      if (brightest.hr == 0) continue;  // already part of a brighter one
      const Eigen::Vector3d centre = brightest.direction;
      float light = brightness(brightest.magnitude);
      Eigen::Vector3d photocentre = centre * double{light};
      bool merged = false;
      grid_.near(centre, parameters.resolution, [&](std::size_t k) {
        SkyStar& other = stars_[k];
        if (k <= i || other.hr == 0 || other.direction.dot(centre) < near_enough) return;
        photocentre += other.direction * double{brightness(other.magnitude)};
        light += brightness(other.magnitude);
        other.hr = 0;
        merged = true;
      });
      if (!merged) continue;
      brightest.direction = photocentre.normalized();
      brightest.magnitude = -2.5F * std::log10(light);
    }
  }

  const auto unwanted = [&](const SkyStar& s) {
    return s.hr == 0 || s.magnitude > parameters.magnitude_limit;
  };
  SkyStar* const kept = std::remove_if(stars_.begin(), stars_.end(), unwanted);
  stars_.resize(static_cast<std::size_t>(kept - stars_.begin()));
  // HR numbers break ties, so that the order is the same on every machine.
  std::sort(stars_.begin(), stars_.end(), [](const SkyStar& a, const SkyStar& b) {
    return a.magnitude != b.magnitude ? a.magnitude < b.magnitude : a.hr < b.hr;
  });
  grid_.build(stars_.size(), direction);
}

}  // namespace omma
