#include "components/tracker/sky_pairing.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// A dot so many times brighter than the image's other pairs let expect is not its star's: something passes
// before it. Red stars are up to four times brighter to silicon than their V says.
constexpr float kTooBright = 5;
constexpr std::size_t kEnoughPairs = 12;  // to know what is to be expected

float light_of(const SkyStar& star) {
  return std::pow(10.0F, -0.4F * star.magnitude);
}

}  // namespace

void SkyPairing::predict(const CameraPrediction& prediction, std::span<const SkyStar> stars,
                         float magnitude_limit) noexcept {
  points_.resize(kSolarBodies);
  points_.resize(solar_.predict_planets(prediction, magnitude_limit, {points_.data(), points_.size()}));
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const SkyStar& star = stars[i];
    if (star.magnitude > magnitude_limit) break;
    PredictedPoint point;
    if (!prediction.in_field(star.direction)) continue;
    Eigen::Vector3d direction;
    if (!seen(star, direction) || !prediction.point(direction, 0, point)) continue;
    point.entry = static_cast<std::uint16_t>(i);
    point.weight = light_of(star);
    if (!points_.push_back(point)) break;
  }
}

void SkyPairing::pair(SeenDots& dots, const Rig& rig, std::span<const SkyStar> stars,
                      const PredictedAttitude& prediction, float magnitude_limit, const AssignmentGate& gate,
                      std::span<const HiddenCone> hidden,
                      StaticVector<Pairing, limits::kStarPairs>& out) noexcept {
  chance_ = 0;
  solar_.clear();
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    found_[c].clear();
    if (dots.list(c).dots.empty()) continue;
    const CameraPrediction in_camera(rig.cameras[c], c, prediction, hidden);
    solar_.claim_discs(dots, rig.cameras[c], c, in_camera, gate);
    predict(in_camera, stars, magnitude_limit);
    chance_ +=
        chance_pairs(points_, dots.list(c), gate, rig.cameras[c].lens.width(), rig.cameras[c].lens.height());
    for (const Assignment& a : assigner_.assign(points_, dots.list(c), dots.grid(c), gate, dots.claimed(c))) {
      const std::uint16_t entry = points_[a.prediction].entry;
      if (entry >= SolarPairing::kFirstEntry) {
        solar_.claim_planet(dots, c, a.dot, entry);
      } else if (dots.ray(c, a.dot) != nullptr) {
        found_[c].push_back({entry, a.dot});
      }
    }
    drop_too_bright(stars, dots.list(c), found_[c]);
  }
  const std::size_t share = share_of_each(dots.cameras(), out.capacity() - out.size());
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    const std::size_t count = std::min(share, found_[c].size());
    for (std::size_t i = 0; i < count; ++i) {
      const Found& found = found_[c][i];
      Pairing pairing;
      Eigen::Vector3d direction;
      if (!seen(stars[found.star], direction)) continue;
      pairing.sight = SeenDots::sight(*dots.ray(c, found.dot), direction);
      pairing.camera = static_cast<std::uint8_t>(c);
      pairing.dot = found.dot;
      pairing.entry = stars[found.star].hr;
      if (!out.push_back(pairing)) return;
      dots.claimed(c)[found.dot] = 1;
    }
  }
}

// False below the horizon.
bool SkyPairing::seen(const SkyStar& star, Eigen::Vector3d& direction) const noexcept {
  direction = star.direction;
  return here_ == nullptr || here_->observe_from_centre(direction);
}

void SkyPairing::drop_too_bright(std::span<const SkyStar> stars, const DotList& list,
                                 FoundStars& found) noexcept {
  if (found.size() < kEnoughPairs) return;
  const auto ratio = [&](const Found& pair) { return list.dots[pair.dot].flux / light_of(stars[pair.star]); };
  per_star_light_.clear();
  for (const Found& pair : found) per_star_light_.push_back(ratio(pair));
  float* middle = per_star_light_.begin() + per_star_light_.size() / 2;
  std::nth_element(per_star_light_.begin(), middle, per_star_light_.end());
  const float most = kTooBright * *middle;
  std::size_t kept = 0;
  for (const Found& pair : found)
    if (ratio(pair) <= most) found[kept++] = pair;
  found.resize(kept);
}

// The largest number of pairs of any camera with which all fit into `room`.
std::size_t SkyPairing::share_of_each(std::size_t cameras, std::size_t room) const noexcept {
  std::size_t share = 0;
  for (std::size_t above = limits::kDotsPerCamera + 1; above - share > 1;) {
    const std::size_t middle = (share + above) / 2;
    std::size_t sum = 0;
    for (std::size_t c = 0; c < cameras; ++c) sum += std::min(middle, found_[c].size());
    (sum <= room ? share : above) = middle;
  }
  return share;
}

}  // namespace omma
