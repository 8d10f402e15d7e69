#include "sim/faint_stars.hpp"

#include <iterator>
#include <numbers>
#include <vector>

namespace omma::sim {
namespace {

/// One row in the units of the table.
struct Row {
  std::int16_t magnitude;
  std::int32_t right_ascension, declination;
  std::int16_t pm_ra_cosdec, pm_dec, colour;
};
constexpr Row kRows[] = {
#define FAINT_STAR(magnitude, ra, dec, pm_ra, pm_dec, colour) {magnitude, ra, dec, pm_ra, pm_dec, colour},
#include "sim/faint_stars_table.inc"
#undef FAINT_STAR
};

std::vector<CatalogueStar> unpacked() {
  constexpr double kTurn = 2 * std::numbers::pi;
  constexpr double kMilliarcsecond = kTurn / 1296e6;
  std::vector<CatalogueStar> stars;
  stars.reserve(std::size(kRows));
  for (const Row& row : kRows)
    stars.push_back({static_cast<std::uint16_t>(kFirstFaintStar + stars.size()),
                     static_cast<float>(row.magnitude) / 100.0F, row.right_ascension * kTurn / 8640000,
                     row.declination * kTurn / 12960000,
                     static_cast<float>(row.pm_ra_cosdec * kMilliarcsecond),
                     static_cast<float>(row.pm_dec * kMilliarcsecond)});
  return stars;
}

}  // namespace

std::span<const CatalogueStar> faint_stars() {
  static const std::vector<CatalogueStar> stars = unpacked();
  return stars;
}

double faint_star_colour(std::uint16_t number) {
  return 0.01 * kRows[number - kFirstFaintStar].colour;
}

}  // namespace omma::sim
