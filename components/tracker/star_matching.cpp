#include "components/tracker/star_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kGateSigmas = 3.5;
constexpr int kRounds = 8;
constexpr std::size_t kFitDots = 256;  // the rounds are made with the first so many; all come last
// A star is taken when finding the dot there is this much likelier than by chance.
constexpr double kLikelier = 3.0;
// Of the dots that proved the hypothesis, this share must survive the final fit.
constexpr double kSurvivors = 0.7;

}  // namespace

void StarMatching::match(std::span<const SearchDot> dots, const WahbaSolution& attitude) noexcept {
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
  pairs_.clear();
  for (const Candidate& c : candidates_) {
    if (dot_taken_[c.search_dot] || star_taken_[c.star]) continue;
    pairs_.push_back(c);
    dot_taken_[c.search_dot] = true;
    star_taken_[c.star] = true;
  }
  for (const Candidate& c : pairs_) {
    dot_taken_[c.search_dot] = false;
    star_taken_[c.star] = false;
  }
}

WahbaSolution StarMatching::solve(std::span<const SearchDot> dots) const noexcept {
  const auto stars = catalogue_.stars();
  Wahba wahba;
  for (const Candidate& c : pairs_) {
    wahba.add(dots[c.search_dot].ray, stars[c.star].direction, 1 / dots[c.search_dot].variance);
  }
  return wahba.solve();
}

bool StarMatching::still_there(std::span<const EvidenceMatch> seeds) const noexcept {
  std::size_t kept = 0;
  for (const EvidenceMatch& seed : seeds) {
    kept += std::any_of(
                pairs_.begin(), pairs_.end(),
                [&](const Candidate& c) { return c.search_dot == seed.search_dot && c.star == seed.star; })
                ? 1
                : 0;
  }
  return kept >= 3 && double(kept) >= kSurvivors * double(seeds.size());
}

StarMatching::Result StarMatching::refine(std::span<const SearchDot> dots,
                                          std::span<const EvidenceMatch> seeds,
                                          StaticVector<StarMatch, limits::kStarPairs>& matches) noexcept {
  Result result;
  pairs_.clear();
  for (const EvidenceMatch& seed : seeds) pairs_.push_back({0, seed.search_dot, seed.star});
  result.attitude = solve(dots);

  const auto first_dots = dots.first(std::min(dots.size(), kFitDots));
  for (int round = 0; round < kRounds && result.attitude.observable; ++round) {
    match(first_dots, result.attitude);
    const WahbaSolution next = solve(dots);
    const double moved = next.body_from_reference.angularDistance(result.attitude.body_from_reference);
    result.attitude = next;
    if (moved < 0.01 * std::sqrt(next.covariance.trace())) break;
  }
  if (!result.attitude.observable || !still_there(seeds)) return result;

  if (dots.size() > first_dots.size()) {
    match(dots, result.attitude);
    result.attitude = solve(dots);
    if (!result.attitude.observable) return result;
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Candidate& a, const Candidate& b) { return a.search_dot < b.search_dot; });
  const auto stars = catalogue_.stars();
  double squares = 0;
  matches.clear();
  for (const Candidate& c : pairs_) {
    const SkyStar& star = stars[c.star];
    squares += (result.attitude.body_from_reference * star.direction - dots[c.search_dot].ray).squaredNorm();
    matches.push_back({dots[c.search_dot].index, c.star, star.hr, c.sigmas});
  }
  result.rms = std::sqrt(squares / double(pairs_.size()));
  result.consistent = true;
  return result;
}

}  // namespace omma
