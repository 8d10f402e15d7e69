#include "components/tracker/star_identification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr std::size_t kPatternDots = 40;  // pairs are made of the first so many dots of an order
constexpr std::size_t kFewestDots = 4;
constexpr double kAngleSigmas = 3.5;          // tolerance of the angle between two dots
constexpr double kShortestPair = 0.1;         // of the camera's field: shorter pairs fix the attitude badly
constexpr double kEntriesPerHypothesis = 32;  // table entries passed over cost as much as one hypothesis
constexpr double kOutsidePrior = 0.1;         // cost of a hypothesis that the prior excludes, in hypotheses
constexpr double kWeighing = 0.5;             // cost of the weight of a hypothesis of a sparse sky
constexpr double kOutsideAtAGlance = 0.02;    // where already a star is too far from where its dot may be
constexpr double kCrowdedPairs = 4;      // pairs of stars are so many times denser in a prior than on average
constexpr double kRefinementCost = 500;  // of one refinement, in hypotheses

// The part of the bound that the p-th of `pairs` pairs of dots has, p from 0. Half is in equal parts; half
// falls slowly, as ln k / ((p + k) ln²(p + k)), whose sum over all p ≥ 1 is below its integral from 0, which
// is 1.
double part_of_pair(std::size_t p, double pairs) noexcept {
  constexpr double kEarly = 4;
  const double place = double(p) + 1 + kEarly;
  const double logarithm = std::log(place);
  return 0.5 / pairs + 0.5 * std::log(kEarly) / (place * logarithm * logarithm);
}

/// Axes fixed by two directions, as columns: along their sum, their difference, and at right angles.
Eigen::Matrix3d axes_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept {
  Eigen::Matrix3d axes;
  axes.col(0) = (a + b).normalized();
  axes.col(1) = (a - b).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

}  // namespace

const char* reason(IdentificationStatus status) noexcept {
  switch (status) {
    case IdentificationStatus::kIdentified:
      return "identified";
    case IdentificationStatus::kTooFewDots:
      return "too few dots";
    case IdentificationStatus::kNotVerified:
      return "no hypothesis verified";
    case IdentificationStatus::kSearchCut:
      return "no hypothesis verified within the limit on the search";
    case IdentificationStatus::kMirrored:
      return "mirrored image";
  }
  return "";
}

StarIdentification::StarIdentification(const StarCatalogue& catalogue, const SkyCoverage& coverage,
                                       const IdentificationParameters& parameters) noexcept
    : catalogue_(catalogue),
      coverage_(coverage),
      parameters_(parameters),
      sparse_(catalogue_, coverage_),
      evidence_(catalogue),
      matching_(catalogue) {
  rebuild();
}

void StarIdentification::identify_near(const Eigen::Quaterniond& rig_from_j2000, double largest_angle,
                                       std::span<const RigDot> dots, Identification& result) noexcept {
  const double angle = std::min(largest_angle, std::numbers::pi);
  identify_aided({rig_from_j2000.conjugate().toRotationMatrix(), 1 + 2 * std::cos(angle),
                  (angle - std::sin(angle)) / std::numbers::pi, std::cos(angle)},
                 dots, result);
}

void StarIdentification::identify_pointing(const Eigen::Vector3d& axis, const Eigen::Vector3d& direction,
                                           double largest_angle, std::span<const RigDot> dots,
                                           Identification& result) noexcept {
  const double cosine = std::cos(std::min(largest_angle, std::numbers::pi));
  identify_aided({direction * axis.transpose(), cosine, 0.5 * (1 - cosine), {}}, dots, result);
}

void StarIdentification::identify_aided(const Prior& prior, std::span<const RigDot> dots,
                                        Identification& result) noexcept {
  prior_ = prior;
  search_all(dots, std::min(parameters_.aided_limit, parameters_.hypothesis_limit), result);
  prior_.reset();
}

void StarIdentification::identify(std::span<const RigDot> dots, Identification& result) noexcept {
  if (search_all(dots, parameters_.hypothesis_limit, result) || dots.size() < kFewestDots) return;
  if (parameters_.names_mirrored && mirrored(dots, result)) result.status = IdentificationStatus::kMirrored;
}

bool StarIdentification::search_all(std::span<const RigDot> dots, double limit,
                                    Identification& result) noexcept {
  result.status = IdentificationStatus::kTooFewDots;
  result.matches.clear();
  result.hypotheses = 0;
  result.log10_false_match = 0;
  if (dots.size() < kFewestDots) return false;

  // With those of the mirrored search the parts of the bound are one.
  constexpr Pass kPasses[] = {{DotOrder::kBrightness, 1.0, 0.35, 0.5},
                              {DotOrder::kSpread, 1.0, 0.25, 0.15},
                              {DotOrder::kBrightness, 3.0, 0.15, 0.1},
                              {DotOrder::kSpread, 3.0, 0.10, 0.05},
                              {DotOrder::kBrightness, 8.0, 0.15, 0.1}};
  tried_ = 0;
  double until = 0;
  for (const Pass& pass : kPasses) {
    until += pass.work * limit;
    result.widening = pass.widening;
    if (search(dots, pass, until, result)) return true;
  }
  result.status = tried_ >= limit ? IdentificationStatus::kSearchCut : IdentificationStatus::kNotVerified;
  return false;
}

bool StarIdentification::search(std::span<const RigDot> dots, const Pass& pass, double until,
                                Identification& result) noexcept {
  const auto order = order_.arrange(dots, coverage_, catalogue_.stars().size(), pass.order, pass.widening);
  const std::size_t count = std::min(order.size(), kPatternDots);
  const double pairs = std::max(0.5 * double(count) * (double(count) - 1), 1.0);
  // The spread order has the same few pairs once more.
  if (sparse_.look_at(order, pass.widening == 1) && pass.order == DotOrder::kSpread) return false;
  std::size_t number = 0;
  for (std::size_t k = 1; k < count; ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      const double part = pass.part * part_of_pair(number++, pairs);
      if (try_pair(order, {i, k, part}, until, result)) return true;
      if (tried_ >= until) return false;
    }
  }
  return false;
}

/// Visits each two stars that the dots may be, and the attitude; where the prior says nothing against it.
/// Ends where `visit` returns true, with true.
template <class Visit>
bool StarIdentification::each_hypothesis(std::span<const SearchDot> order, const DotPair& dots,
                                         std::span<const StarPair> candidates, Visit&& visit) noexcept {
  const auto stars = catalogue_.stars();
  const SearchDot& a = order[dots.first];
  const SearchDot& b = order[dots.second];
  const Eigen::Matrix3d axes_from_rig = axes_of(a.ray, b.ray).transpose();
  const bool glance = prior_ && prior_->least_cosine;
  const Eigen::Vector3d expected_a =
      glance ? Eigen::Vector3d(prior_->weight * a.ray) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d expected_b =
      glance ? Eigen::Vector3d(prior_->weight * b.ray) : Eigen::Vector3d::Zero();
  for (const StarPair& pair : candidates) {
    for (const bool swapped : {false, true}) {
      const std::uint16_t first = swapped ? pair.second : pair.first;
      const std::uint16_t second = swapped ? pair.first : pair.second;
      if (first >= a.faintest || second >= b.faintest) continue;
      if (glance && (expected_a.dot(stars[first].direction) < *prior_->least_cosine ||
                     expected_b.dot(stars[second].direction) < *prior_->least_cosine)) {
        tried_ += kOutsideAtAGlance;
        continue;
      }
      const Eigen::Matrix3d j2000_from_rig =
          axes_of(stars[first].direction, stars[second].direction) * axes_from_rig;
      if (prior_ && j2000_from_rig.cwiseProduct(prior_->weight).sum() < prior_->least) {
        tried_ += kOutsidePrior;
        continue;
      }
      if (visit(first, second, j2000_from_rig)) return true;
    }
  }
  return false;
}

bool StarIdentification::try_pair(std::span<const SearchDot> order, const DotPair& dots, double until,
                                  Identification& result) noexcept {
  const SearchDot& a = order[dots.first];
  const SearchDot& b = order[dots.second];
  const double angle = angle_between(a.ray, b.ray);
  const double tolerance = kAngleSigmas * std::sqrt(a.variance + b.variance);
  if (angle > pairs_.largest_angle() + tolerance || angle < kShortestPair * coverage_.camera_angle)
    return false;
  if ((a.ray + b.ray).squaredNorm() < 1e-4) return false;  // opposite: they fix no plane
  const auto candidates = pairs_.between(angle - tolerance, angle + tolerance);
  tried_ += double(candidates.size()) / kEntriesPerHypothesis;

  // All hypotheses of the two dots share their part of the bound, the likelier ones get more of it.
  const double total = weigh_hypotheses(order, dots, candidates);
  if (total == 0) return false;
  evidence_.rest_on(order, sparse_, dots.first, dots.second);
  std::size_t n = 0;
  bool taken = false;
  each_hypothesis(order, dots, candidates,
                  [&](std::uint16_t first, std::uint16_t second, const Eigen::Matrix3d& m) {
                    if (tried_ >= until) return true;
                    const double part = std::min(dots.part * weight_of(n++) / total, 1.0);
                    const double accept = 1 / (parameters_.false_match_probability * part);
                    tried_ += 1;
                    ++result.hypotheses;
                    const double ratio = evidence_.weigh(m, first, second, accept);
                    taken = ratio >= accept && take(order, ratio, part, result);
                    return taken;
                  });
  return taken;
}

// The sum of the weights of all hypotheses of the two dots; with a prior the mean of those that it lets pass,
// were the attitudes at random.
double StarIdentification::weigh_hypotheses(std::span<const SearchDot> order, const DotPair& dots,
                                            std::span<const StarPair> candidates) noexcept {
  weighed_ = 0;
  if (!sparse_.is_sparse() || prior_) {  // all weigh the same, and counting is quick
    const int a = order[dots.first].faintest;
    const int b = order[dots.second].faintest;
    int count = 0;
    for (const StarPair& pair : candidates) {
      count += (pair.first < a && pair.second < b) ? 1 : 0;
      count += (pair.second < a && pair.first < b) ? 1 : 0;
    }
    return prior_ ? count * std::min(kCrowdedPairs * prior_->fraction, 1.0) : count;
  }
  double total = 0;
  each_hypothesis(
      order, dots, candidates, [&](std::uint16_t first, std::uint16_t second, const Eigen::Matrix3d& m) {
        if (weighed_ < weights_.size()) {
          weights_[weighed_++] = sparse_.weight({static_cast<std::uint16_t>(dots.first), first},
                                                {static_cast<std::uint16_t>(dots.second), second}, m);
          tried_ += kWeighing;
          total += weights_[weighed_ - 1];
        } else {
          total += SparseSky::kLeastWeight;
        }
        return false;
      });
  return total;
}

double StarIdentification::weight_of(std::size_t hypothesis) const noexcept {
  if (hypothesis < weighed_) return weights_[hypothesis];
  return sparse_.is_sparse() && !prior_ ? SparseSky::kLeastWeight : 1;
}

bool StarIdentification::take(std::span<const SearchDot> order, double ratio, double part,
                              Identification& result) noexcept {
  const StarMatching::Result fit = matching_.refine(order, evidence_.matches(), result.matches);
  tried_ += kRefinementCost;
  if (!fit.consistent) return false;
  result.status = IdentificationStatus::kIdentified;
  result.rig_from_j2000 = fit.attitude.body_from_reference;
  result.covariance = fit.attitude.covariance;
  result.rms = fit.rms;
  result.log10_false_match = -std::log10(part * ratio);
  return true;
}

bool StarIdentification::mirrored(std::span<const RigDot> dots, Identification& result) noexcept {
  // One camera alone, the one with the most dots: a mirror image of a rig is no rig. Any plane will do.
  std::array<std::uint32_t, limits::kCameras> count{};
  for (const RigDot& dot : dots) {
    if (dot.camera < count.size()) ++count[dot.camera];
  }
  const auto most = static_cast<std::uint8_t>(std::max_element(count.begin(), count.end()) - count.begin());
  std::size_t size = 0;
  for (const RigDot& dot : dots) {
    if (dot.camera != most || size == mirror_.size()) continue;
    mirror_[size] = dot;
    mirror_[size++].ray.x() *= -1;
  }
  if (size < kFewestDots) return false;
  const std::span<const RigDot> flipped(mirror_.data(), size);
  const double limit = tried_ + 0.5 * parameters_.hypothesis_limit;
  const bool found = search(flipped, {DotOrder::kBrightness, 1.0, 0, 0.05}, 0.5 * (tried_ + limit), result) ||
                     search(flipped, {DotOrder::kSpread, 1.0, 0, 0.05}, limit, result);
  result.matches.clear();
  return found;
}

}  // namespace omma
