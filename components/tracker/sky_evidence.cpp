#include "components/tracker/sky_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

// A true attitude puts a share q of the dots on stars. q is not known: the likelihood ratio is the mean over
// three.
constexpr std::array<double, 3> kShares = {0.15, 0.45, 0.80};
constexpr std::size_t kMiddle = 1;
// Stars are up to this many times denser than on average where dots are seen (Milky Way).
constexpr double kCrowding = 2.0;
constexpr double kGateSigmas = 3.5;
constexpr double kGaussianPart = 0.75;  // of a star's density; the rest is flat over the gate
// Given up below this: five bright dots without a star, or about thirteen after the first one with.
constexpr double kGiveUp = 0.05;

}  // namespace

void SkyEvidence::rest_on(std::span<const SearchDot> dots, const SparseSky& sparse, std::size_t first,
                          std::size_t second) noexcept {
  dots_ = dots;
  sparse_ = sparse.is_sparse() ? &sparse : nullptr;
  first_ = first;
  second_ = second;
  prepared_ = 0;
  // An attitude from two directions at the angle φ is uncertain by σ²/(2 sin²(φ/2)) about their bisector, by
  // σ²/2 about the normal of their plane and by σ²/(2 cos²(φ/2)) about the third axis.
  const Eigen::Vector3d& a = dots[first].ray;
  const Eigen::Vector3d& b = dots[second].ray;
  const double sum2 = (a + b).squaredNorm();         // 4 cos²(φ/2)
  const double difference2 = (a - b).squaredNorm();  // 4 sin²(φ/2)
  const double variance = 0.5 * (dots[first].variance + dots[second].variance);
  axes_.row(0) = (a + b).transpose() / std::sqrt(sum2);
  axes_.row(1) = (a - b).transpose() / std::sqrt(difference2);
  axes_.row(2) = axes_.row(0).cross(axes_.row(1));
  variances_ << 2 * variance / difference2, 2 * variance / sum2, 0.5 * variance;
}

SkyEvidence::Witness SkyEvidence::witness(const SearchDot& dot) const noexcept {
  const Eigen::Vector3d along = axes_ * dot.ray;
  const double variance =
      dot.variance + 0.5 * variances_.dot(Eigen::Vector3d::Ones() - along.cwiseProduct(along));
  const double gate = kGateSigmas * std::sqrt(variance);
  const double chance =
      std::max<double>(dot.faintest, 1) * kCrowding / (4 * std::numbers::pi);  // stars per steradian
  return {gate, 0.5 / variance, kGaussianPart / (2 * std::numbers::pi * variance * chance),
          (1 - kGaussianPart) / (std::numbers::pi * gate * gate * chance)};
}

double SkyEvidence::density(const EvidenceMatch& match, double distance2,
                            const Eigen::Matrix3d& j2000_from_rig) const noexcept {
  const Witness& w = witnesses_[match.search_dot];
  const double density = w.peak * std::exp(-distance2 * w.half_inverse) + w.floor;
  if (sparse_ == nullptr) return density;
  const double rivals = sparse_->rivals(match, matches_, j2000_from_rig);
  return density * std::max<double>(dots_[match.search_dot].faintest, 1) / (4 * std::numbers::pi * rivals);
}

double SkyEvidence::weigh(const Eigen::Matrix3d& j2000_from_rig, std::uint16_t first_star,
                          std::uint16_t second_star, double accept) noexcept {
  const auto stars = catalogue_.stars();
  ++stamp_;
  claimed_by_[first_star] = stamp_;
  claimed_by_[second_star] = stamp_;
  matches_.clear();
  matches_.push_back({static_cast<std::uint16_t>(first_), first_star});
  matches_.push_back({static_cast<std::uint16_t>(second_), second_star});

  std::array<double, 3> ratio = {1, 1, 1};
  double best = 1;
  const std::size_t count = std::min(dots_.size(), kDots);
  for (std::size_t n = 0; n < count; ++n) {
    // Those after the first of the pair, then those before it: where the brightest dots are lamps and text, a
    // pair of stars is judged by the stars that follow.
    const std::size_t k = first_ + n < count ? first_ + n : first_ + n - count;
    if (n >= prepared_) {
      witnesses_[k] = witness(dots_[k]);
      prepared_ = n + 1;
    }
    if (k == first_ || k == second_ || (sparse_ != nullptr && sparse_->repeated(k))) continue;
    const Witness& w = witnesses_[k];
    const Eigen::Vector3d direction = j2000_from_rig * dots_[k].ray;
    double nearest = w.gate * w.gate;
    int star = -1;
    catalogue_.near(direction, w.gate, [&](std::size_t s) {
      if (s >= dots_[k].faintest) return;
      const double distance2 = (stars[s].direction - direction).squaredNorm();
      if (distance2 >= nearest || claimed_by_[s] == stamp_) return;
      nearest = distance2;
      star = static_cast<int>(s);
    });
    double found = 0;
    if (star >= 0) {
      const EvidenceMatch match{static_cast<std::uint16_t>(k), static_cast<std::uint16_t>(star)};
      found = density(match, nearest, j2000_from_rig);
      claimed_by_[match.star] = stamp_;
      matches_.push_back(match);
    }
    double sum = 0;
    for (std::size_t q = 0; q < kShares.size(); ++q) {
      ratio[q] *= (1 - kShares[q]) + kShares[q] * found;
      sum += ratio[q];
    }
    best = sum / kShares.size();
    if (best >= accept) return best;
    if (ratio[kMiddle] < kGiveUp && sparse_ == nullptr) return best;
  }
  return best;
}

}  // namespace omma
