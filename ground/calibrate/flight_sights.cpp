#include "ground/calibrate/flight_sights.hpp"

#include <map>
#include <memory>

#include "components/catalogue/star.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "ground/solve/photograph_solver.hpp"

namespace omma::ground {
namespace {

constexpr std::size_t kLeastStars = 4;
constexpr float kFaintest = 6.5F;  // V of the flight's own catalogue

void add_dots(const std::vector<std::vector<omma_Dot>>& cameras, const std::map<int, const SkyStar*>& stars,
              FlightSet& set) {
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    for (const omma_Dot& dot : cameras[c]) {
      if (dot.role != omma_DOT_STAR || dot.culled) continue;
      const auto star = stars.find(dot.entry);
      if (star == stars.end()) continue;
      StarSight sight;
      sight.camera = static_cast<int>(c);
      sight.hr = dot.entry;
      sight.star = star->second->direction;
      sight.pixel = {dot.u_px, dot.v_px};
      sight.covariance << dot.covariance_uu_px2, dot.covariance_uv_px2, dot.covariance_uv_px2,
          dot.covariance_vv_px2;
      sight.snr = dot.snr;
      set.sights.push_back(sight);
      set.magnitudes.push_back(static_cast<double>(star->second->magnitude));
    }
  }
}

}  // namespace

std::vector<FlightSet> flight_sets(const FlightLog& log, const Rig& rig, const Observer& epoch,
                                   double start) {
  const auto catalogue =
      std::make_unique<StarCatalogue>(epoch, StarCatalogueParameters{kFaintest, 2 * finest_pixel_angle(rig)});
  std::map<int, const SkyStar*> stars;
  for (const SkyStar& star : catalogue->stars()) stars[star.hr] = &star;
  std::vector<FlightSet> sets;
  for (const omma_Attitude& attitude : log.attitudes) {
    const auto dots = log.dots.find(attitude.frame);
    if (!attitude.valid || dots == log.dots.end()) continue;
    FlightSet set;
    const omma_Quaternion& q = attitude.rig_from_j2000;
    set.time = start + 1e-9 * static_cast<double>(attitude.time_ns);
    set.rig_from_j2000 = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
    add_dots(dots->second, stars, set);
    if (set.sights.size() >= kLeastStars) sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace omma::ground
