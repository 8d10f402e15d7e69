#include "components/tracker/search_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

// A dot that is the n-th brightest of its camera may be any of the stars of which kSlack · (n + kStart) are
// seen in such a field on average: a magnitude of slack, and room for skies poor in bright stars.
constexpr double kSlack = 3;
constexpr double kStart = 4;

std::uint16_t star_limit(double place, double fraction, std::size_t stars) noexcept {
  return static_cast<std::uint16_t>(std::min(kSlack * (place + kStart) / fraction, double(stars)));
}

float magnitude(float flux) noexcept {
  constexpr float kDarkest = 1e-3F;  // [grey levels]
  // In double precision, where machines are known to agree (c_library_test).
  return static_cast<float>(-2.5 * std::log10(double{std::max(flux, kDarkest)}));
}

double fraction_seen(const SkyCoverage& coverage, std::uint8_t camera) noexcept {
  if (camera >= coverage.solid_angle.size()) return 1;
  return std::clamp(coverage.solid_angle[camera] / (4 * std::numbers::pi), 1e-4, 1.0);
}

}  // namespace

std::span<const SearchDot> SearchOrder::arrange(std::span<const RigDot> dots, const SkyCoverage& coverage,
                                                std::size_t stars, DotOrder order, double widening) noexcept {
  by_camera_.clear();
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if ((dots[i].flags & kDotAtEdge) != 0) continue;
    if (!by_camera_.push_back(static_cast<std::uint16_t>(i))) break;
  }
  std::sort(by_camera_.begin(), by_camera_.end(), [&](std::uint16_t a, std::uint16_t b) {
    if (dots[a].camera != dots[b].camera) return dots[a].camera < dots[b].camera;
    return dots[a].flux != dots[b].flux ? dots[a].flux > dots[b].flux : a < b;
  });

  keys_.clear();
  for (std::size_t from = 0; from < by_camera_.size();) {
    const std::uint8_t camera = dots[by_camera_[from]].camera;
    std::size_t to = from;
    while (to < by_camera_.size() && dots[by_camera_[to]].camera == camera) ++to;
    const double fraction = fraction_seen(coverage, camera);
    const double field = 2 * std::sqrt(fraction);  // radius of a cap of that area, about
    for (std::size_t n = from; n < to; ++n) {
      const RigDot& dot = dots[by_camera_[n]];
      const double place = double(n - from);
      if (order == DotOrder::kBrightness) {
        keys_.push_back({static_cast<float>((place + 0.5) / fraction), by_camera_[n],
                         star_limit(place, fraction, stars)});
        continue;
      }
      // Brighter dots nearby, in a neighbourhood of a fiftieth of the field.
      const double cosine = std::cos(0.14 * field);
      int brighter = 0;
      for (std::size_t m = from; m < n; ++m)
        brighter += dots[by_camera_[m]].ray.dot(dot.ray) > cosine ? 1 : 0;
      const double spread_place = 50.0 * brighter + 50.0 * place / double(to - from);
      keys_.push_back(
          {static_cast<float>(spread_place / fraction), by_camera_[n], star_limit(place, fraction, stars)});
    }
    from = to;
  }
  std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) {
    return a.place != b.place ? a.place < b.place : a.dot < b.dot;
  });

  arranged_.clear();
  for (const Key& key : keys_) {
    const RigDot& dot = dots[key.dot];
    arranged_.push_back({dot.ray, widening * widening * dot.sigma * dot.sigma, magnitude(dot.flux),
                         key.faintest, key.dot, dot.camera});
  }
  return arranged_;
}

}  // namespace omma
