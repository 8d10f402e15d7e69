#include "components/tracker/star_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;
constexpr std::size_t kPool = 4;
constexpr double kStarsPerField = 50;  // more help only where half of the dots and more are false

/// Fraction of the sphere within the angle `radius`.
double cap_fraction(double radius) {
  return 0.5 * (1 - std::cos(radius));
}

/// Number of stars whose pairs up to `angle` fit into the table, with a margin for uneven skies.
double stars_that_fit(double angle) {
  return 0.9 * std::sqrt(2 * double(StarPairs::kCapacity) / std::max(cap_fraction(angle), 1e-9));
}

}  // namespace

bool StarPairs::choose_stars(const StarCatalogue& catalogue, std::size_t wanted, double radius,
                             std::size_t most_within) noexcept {
  // Stars much fainter than those wanted help no more, even in a poor field.
  const auto stars = catalogue.stars().first(std::min(catalogue.stars().size(), kPool * wanted));
  const double cosine = std::cos(radius);
  std::array<bool, StarCatalogue::kCapacity> taken{};
  chosen_.clear();
  for (std::size_t i = 0; i < stars.size(); ++i) {
    std::size_t within = 0;
    catalogue.near(stars[i].direction, radius, [&](std::size_t k) {
      if (taken[k] && stars[k].direction.dot(stars[i].direction) > cosine) ++within;
    });
    if (within >= most_within) continue;
    if (chosen_.size() == wanted) return false;
    taken[i] = true;
    chosen_.push_back(static_cast<std::uint16_t>(i));
  }
  return true;
}

void StarPairs::build(const StarCatalogue& catalogue, const SkyCoverage& coverage) noexcept {
  double whole = 0;
  double largest_camera = 0;
  for (const double s : coverage.solid_angle) {
    whole += s / kSphere;
    largest_camera = std::max(largest_camera, s / kSphere);
  }
  // All angles of the rig where the stars it needs have room; else those within one camera.
  largest_angle_ = coverage.rig_angle;
  double seen = std::clamp(whole, 1e-4, 1.0);
  if (kStarsPerField / seen > stars_that_fit(largest_angle_)) {
    largest_angle_ = coverage.camera_angle;
    seen = std::clamp(largest_camera, 1e-4, 1.0);
  }
  const double wanted = std::min(kStarsPerField / seen, stars_that_fit(largest_angle_));
  const double radius = std::acos(1 - 2 * std::min(seen, 0.4));  // a cap as large as the field
  // The most stars in any field with which the stars of the whole sky are no more than wanted.
  std::size_t fits = 1;
  for (std::size_t above = 2 * static_cast<std::size_t>(kStarsPerField); above - fits > 1;) {
    const std::size_t middle = (fits + above) / 2;
    (choose_stars(catalogue, static_cast<std::size_t>(wanted), radius, middle) ? fits : above) = middle;
  }
  choose_stars(catalogue, static_cast<std::size_t>(wanted), radius, fits);

  const auto stars = catalogue.stars();
  const double cosine = std::cos(largest_angle_);
  pairs_.clear();
  star_count_ = 0;
  for (std::size_t k = 0; k < chosen_.size() && !pairs_.full(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      const Eigen::Vector3d& a = stars[chosen_[i]].direction;
      const Eigen::Vector3d& b = stars[chosen_[k]].direction;
      if (a.dot(b) < cosine) continue;
      const double angle = 2 * std::atan2((a - b).norm(), (a + b).norm());
      pairs_.push_back({static_cast<float>(angle), chosen_[i], chosen_[k]});
    }
    star_count_ = k + 1;
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const StarPair& a, const StarPair& b) {
    if (a.angle != b.angle) return a.angle < b.angle;
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
}

std::span<const StarPair> StarPairs::between(double low, double high) const noexcept {
  const StarPair* const from = std::lower_bound(
      pairs_.begin(), pairs_.end(), low, [](const StarPair& p, double angle) { return p.angle < angle; });
  const StarPair* const to = std::upper_bound(
      from, pairs_.end(), high, [](double angle, const StarPair& p) { return angle < p.angle; });
  return {from, to};
}

}  // namespace omma
