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
constexpr double kRefinementCost = 500;       // of one refinement, in hypotheses
constexpr double kEarly = 30;                 // hypotheses that share the bound almost evenly, the first ones

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
      evidence_(catalogue),
      matching_(catalogue) {
  rebuild();
}

double StarIdentification::ratio_to_accept(std::uint32_t hypothesis) const noexcept {
  // Each hypothesis h has its part w(h) of the bound. 0.6 of it fall slowly, as ln k / ((h + k) ln²(h + k)),
  // whose sum over all h ≥ 1 is below its integral from 0, which is 1: the brightest dots' hypotheses need
  // the fewest stars. A quarter, as 1/(h(h + 1)), is for the very first, all that an aided search may need;
  // the rest in equal parts for late ones. Together they are at most one, the mirrored search with its half
  // of the hypotheses included.
  const double h = hypothesis;
  const double logarithm = std::log(h + kEarly);
  const double part = 0.25 / (h * (h + 1)) + 0.6 * std::log(kEarly) / ((h + kEarly) * logarithm * logarithm) +
                      0.1 / parameters_.hypothesis_limit;
  return 1 / (parameters_.false_match_probability * part);
}

void StarIdentification::identify_near(const Eigen::Quaterniond& rig_from_j2000, double largest_angle,
                                       std::span<const RigDot> dots, Identification& result) noexcept {
  const double cosine = std::cos(std::min(largest_angle, std::numbers::pi));
  identify_aided({rig_from_j2000.conjugate().toRotationMatrix(), 1 + 2 * cosine}, dots, result);
}

void StarIdentification::identify_pointing(const Eigen::Vector3d& axis, const Eigen::Vector3d& direction,
                                           double largest_angle, std::span<const RigDot> dots,
                                           Identification& result) noexcept {
  identify_aided({direction * axis.transpose(), std::cos(std::min(largest_angle, std::numbers::pi))}, dots,
                 result);
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

  constexpr Pass kPasses[] = {{DotOrder::kBrightness, 1.0, 0.35},
                              {DotOrder::kSpread, 1.0, 0.25},
                              {DotOrder::kBrightness, 3.0, 0.15},
                              {DotOrder::kSpread, 3.0, 0.10},
                              {DotOrder::kBrightness, 8.0, 0.15}};
  tried_ = 0;
  double until = 0;
  for (const Pass& pass : kPasses) {
    until += pass.share * limit;
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
  for (std::size_t k = 1; k < count; ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      if (try_pair(order, i, k, until, result)) return true;
      if (tried_ >= until) return false;
    }
  }
  return false;
}

bool StarIdentification::try_pair(std::span<const SearchDot> order, std::size_t i, std::size_t k,
                                  double until, Identification& result) noexcept {
  const auto stars = catalogue_.stars();
  const SearchDot& a = order[i];
  const SearchDot& b = order[k];
  const double angle = angle_between(a.ray, b.ray);
  const double tolerance = kAngleSigmas * std::sqrt(a.variance + b.variance);
  if (angle > pairs_.largest_angle() + tolerance || angle < kShortestPair * coverage_.camera_angle)
    return false;
  if ((a.ray + b.ray).squaredNorm() < 1e-4) return false;  // opposite: they fix no plane
  const Eigen::Matrix3d rig_axes = axes_of(a.ray, b.ray);
  bool prepared = false;

  const auto candidates = pairs_.between(angle - tolerance, angle + tolerance);
  tried_ += double(candidates.size()) / kEntriesPerHypothesis;
  for (const StarPair& pair : candidates) {
    for (const bool swapped : {false, true}) {
      const std::uint16_t first = swapped ? pair.second : pair.first;
      const std::uint16_t second = swapped ? pair.first : pair.second;
      if (first >= a.faintest || second >= b.faintest) continue;
      if (tried_ >= until) return false;
      const Eigen::Matrix3d j2000_from_rig =
          axes_of(stars[first].direction, stars[second].direction) * rig_axes.transpose();
      if (prior_ && j2000_from_rig.cwiseProduct(prior_->weight).sum() < prior_->least) {
        tried_ += kOutsidePrior;
        continue;
      }
      if (!prepared) evidence_.rest_on(order, i, k);
      prepared = true;
      tried_ += 1;
      ++result.hypotheses;
      const double accept = ratio_to_accept(result.hypotheses);
      const double ratio = evidence_.weigh(j2000_from_rig, first, second, accept);
      if (ratio >= accept && take(order, ratio, result)) return true;
    }
  }
  return false;
}

bool StarIdentification::take(std::span<const SearchDot> order, double ratio,
                              Identification& result) noexcept {
  const StarMatching::Result fit = matching_.refine(order, evidence_.matches(), result.matches);
  tried_ += kRefinementCost;
  if (!fit.consistent) return false;
  result.status = IdentificationStatus::kIdentified;
  result.rig_from_j2000 = fit.attitude.body_from_reference;
  result.covariance = fit.attitude.covariance;
  result.rms = fit.rms;
  result.log10_false_match =
      std::log10(parameters_.false_match_probability * ratio_to_accept(result.hypotheses) / ratio);
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
  const bool found = search(flipped, {DotOrder::kBrightness, 1.0, 0}, 0.5 * (tried_ + limit), result) ||
                     search(flipped, {DotOrder::kSpread, 1.0, 0}, limit, result);
  result.matches.clear();
  return found;
}

}  // namespace omma
