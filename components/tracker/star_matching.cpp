#include "components/tracker/star_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kGateSigmas = 3.5;
constexpr int kRounds = 8;
// A star is taken when finding the dot there is this much likelier than by chance.
constexpr double kLikelier = 3.0;
// Of the dots that proved the hypothesis, this share must survive the final fit.
constexpr double kSurvivors = 0.7;

}  // namespace

void StarMatching::match(std::span<const SearchDot> dots, const WahbaSolution& attitude,
                         StaticVector<StarMatch, limits::kStarPairs>& matches) noexcept {
  const auto stars = catalogue_.stars();
  const Eigen::Matrix3d j2000_from_rig = attitude.body_from_reference.conjugate().toRotationMatrix();
  const Eigen::Matrix3d& p = attitude.covariance;
  candidates_.clear();
  for (std::size_t k = 0; k < dots.size(); ++k) {
    const SearchDot& dot = dots[k];
    const double variance = dot.variance + 0.5 * (p.trace() - dot.ray.dot(p * dot.ray));
    const double gate = kGateSigmas * std::sqrt(variance);
    const double chance = dot.faintest / (4 * std::numbers::pi);  // stars per steradian
    const double peak = 1 / (2 * std::numbers::pi * variance * std::max(chance, 1e-3));
    const Eigen::Vector3d direction = j2000_from_rig * dot.ray;
    catalogue_.near(direction, gate, [&](std::size_t s) {
      if (s >= dot.faintest) return;
      const double normalised2 = (stars[s].direction - direction).squaredNorm() / variance;
      if (normalised2 > kGateSigmas * kGateSigmas || peak * std::exp(-0.5 * normalised2) < kLikelier) return;
      candidates_.push_back({static_cast<float>(std::sqrt(normalised2)), static_cast<std::uint16_t>(k),
                             static_cast<std::uint16_t>(s)});
    });
  }
  // One dot a star, one star a dot: the closest first.
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.sigmas != b.sigmas) return a.sigmas < b.sigmas;
    return a.search_dot != b.search_dot ? a.search_dot < b.search_dot : a.star < b.star;
  });
  matches.clear();
  for (const Candidate& c : candidates_) {
    if (dot_taken_[c.search_dot] || star_taken_[c.star]) continue;
    if (!matches.push_back({c.search_dot, c.star, stars[c.star].hr, c.sigmas})) break;
    dot_taken_[c.search_dot] = true;
    star_taken_[c.star] = true;
  }
  for (const StarMatch& m : matches) {
    dot_taken_[m.dot] = false;
    star_taken_[m.star] = false;
  }
}

StarMatching::Result StarMatching::refine(std::span<const SearchDot> dots,
                                          std::span<const EvidenceMatch> seeds,
                                          StaticVector<StarMatch, limits::kStarPairs>& matches) noexcept {
  const auto stars = catalogue_.stars();
  Result result;
  matches.clear();
  Wahba first;
  for (const EvidenceMatch& seed : seeds) {
    first.add(dots[seed.search_dot].ray, stars[seed.star].direction, 1 / dots[seed.search_dot].variance);
  }
  result.attitude = first.solve();
  if (!result.attitude.observable) return result;

  for (int round = 0; round < kRounds; ++round) {
    match(dots, result.attitude, matches);
    Wahba all;
    for (const StarMatch& m : matches)
      all.add(dots[m.dot].ray, stars[m.star].direction, 1 / dots[m.dot].variance);
    const WahbaSolution next = all.solve();
    if (!next.observable) return result;
    const double moved = next.body_from_reference.angularDistance(result.attitude.body_from_reference);
    const double sigma = std::sqrt(next.covariance.trace());
    result.attitude = next;
    if (moved < 0.01 * sigma) break;
  }

  std::size_t kept = 0;
  for (const EvidenceMatch& seed : seeds) {
    kept += std::any_of(matches.begin(), matches.end(),
                        [&](const StarMatch& m) { return m.dot == seed.search_dot && m.star == seed.star; })
                ? 1
                : 0;
  }
  double squares = 0;
  for (StarMatch& m : matches) {
    squares +=
        (result.attitude.body_from_reference * stars[m.star].direction - dots[m.dot].ray).squaredNorm();
    m.dot = dots[m.dot].index;  // from here on: the caller's
  }
  result.rms = matches.empty() ? 0 : std::sqrt(squares / double(matches.size()));
  result.consistent = kept >= 3 && double(kept) >= kSurvivors * double(seeds.size());
  return result;
}

}  // namespace omma
