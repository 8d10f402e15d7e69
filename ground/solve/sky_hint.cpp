#include "ground/solve/sky_hint.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "components/geometry/angles.hpp"
#include "fsw/kernel/input_error.hpp"

namespace omma::ground {

SkyHint parse_sky_hint(const std::string& text) {
  std::array<double, 3> degrees{};
  const char* at = text.data();
  const char* const end = at + text.size();
  bool good = true;
  for (std::size_t i = 0; i < degrees.size() && good; ++i) {
    if (at != end && *at == '+') ++at;
    const auto [next, error] = std::from_chars(at, end, degrees[i]);
    good = error == std::errc{} && (i + 1 == degrees.size() ? next == end : next != end && *next == ',');
    at = good && next != end ? next + 1 : next;
  }
  const auto [ra, dec, radius] = degrees;
  good = good && ra >= 0 && ra <= 360 && std::abs(dec) <= 90 && radius > 0 && radius <= 180;
  if (!good)
    throw InputError("arguments", 0, "--near",
                     "RA,DEC,RADIUS in degrees (0 to 360, -90 to 90, more than 0 to 180)",
                     "\"" + text + "\"");
  constexpr double kDegree = M_PI / 180;
  return {direction_at(ra * kDegree, dec * kDegree), radius * kDegree};
}

}  // namespace omma::ground
