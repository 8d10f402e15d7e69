#include "components/tracker/sparse_sky.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace omma {
namespace {

// Of the difference between a dot's magnitude, up to the camera's constant, and its star's V: noise, colour,
// vignetting.
constexpr double kMagnitudeVariance = 0.4 * 0.4;
// Brightness may mislead altogether (saturation, clouds): this part of the probability does not look at it.
constexpr double kBlindPart = 0.3;
constexpr double kBlindWeight = 0.1;
// A camera may see fewer stars than the catalogue has: weight of a field with far more stars than dots.
constexpr double kShallowWeight = 0.005;
constexpr double kSameSigmas = 3.5;   // of the angle between two dots of one thing, in two cameras
constexpr double kStarsMissed = 1.5;  // of a field whose stars are nearly all seen

double squared(double x) noexcept {
  return x * x;
}

}  // namespace

bool SparseSky::narrow(std::uint8_t camera) const noexcept {
  return camera < coverage_.fields.size() && coverage_.fields[camera].sees_anything();
}

bool SparseSky::look_at(std::span<const SearchDot> dots, bool counts_stars) noexcept {
  dots_ = dots.size() <= kMostDots ? dots : std::span<const SearchDot>();
  dots_of_.fill(0);
  repeated_.fill(false);
  countable_ = counts_stars && is_sparse();
  for (std::size_t k = 0; k < dots_.size(); ++k) {
    const SearchDot& dot = dots_[k];
    countable_ = countable_ && narrow(dot.camera);
    if (dot.camera < dots_of_.size()) ++dots_of_[dot.camera];
    for (const SearchDot& before : dots_.first(k)) {
      const double gate2 = squared(kSameSigmas) * (dot.variance + before.variance);
      if (before.camera != dot.camera && (before.ray - dot.ray).squaredNorm() < gate2) repeated_[k] = true;
    }
  }
  return is_sparse();
}

// Visits the stars, by their index, that the camera sees.
template <class Visit>
void SparseSky::each_in_field(std::uint8_t camera, const Eigen::Matrix3d& j2000_from_rig,
                              Visit&& visit) const noexcept {
  const FieldMap& field = coverage_.fields[camera];
  const auto stars = catalogue_.stars();
  const Eigen::Vector3d axis = j2000_from_rig * field.axis();
  const double cosine = std::cos(field.radius());
  catalogue_.near(axis, field.radius(), [&](std::size_t s) {
    const Eigen::Vector3d& star = stars[s].direction;
    if (star.dot(axis) > cosine && field.sees(j2000_from_rig.transpose() * star)) visit(s);
  });
}

double SparseSky::weight(const EvidenceMatch& first, const EvidenceMatch& second,
                         const Eigen::Matrix3d& j2000_from_rig) const noexcept {
  const auto stars = catalogue_.stars();
  const SearchDot& a = dots_[first.search_dot];
  const SearchDot& b = dots_[second.search_dot];
  double weight = 1;
  if (a.camera == b.camera) {
    const double difference = double{a.magnitude} - b.magnitude -
                              (double{stars[first.star].magnitude} - stars[second.star].magnitude);
    weight = kBlindWeight + (1 - kBlindWeight) * std::exp(-squared(difference) / (4 * kMagnitudeVariance));
  }
  if (!countable_) return weight;
  int more = 0;  // stars than dots
  for (std::size_t c = 0; c < dots_of_.size(); ++c) {
    if (dots_of_[c] == 0) continue;
    int seen = 0;
    each_in_field(static_cast<std::uint8_t>(c), j2000_from_rig, [&](std::size_t) { ++seen; });
    more += std::max(seen - dots_of_[c], 0);
  }
  return weight * (kShallowWeight + (1 - kShallowWeight) * std::exp(-more / kStarsMissed));
}

double SparseSky::rivals(const EvidenceMatch& candidate, std::span<const EvidenceMatch> taken,
                         const Eigen::Matrix3d& j2000_from_rig) const noexcept {
  const SearchDot& dot = dots_[candidate.search_dot];
  const auto stars = catalogue_.stars();
  double constant = 0;  // of the camera: V of a star less its dot's magnitude
  double known = 0;
  for (const EvidenceMatch& match : taken) {
    if (dots_[match.search_dot].camera != dot.camera) continue;
    constant += double{stars[match.star].magnitude} - dots_[match.search_dot].magnitude;
    known += 1;
  }
  const double expected = dot.magnitude + constant / std::max(known, 1.0);
  const double variance = kMagnitudeVariance * (1 + 1 / std::max(known, 1.0));
  const auto likelihood = [&](std::size_t s) {
    return known > 0 ? std::exp(-squared(stars[s].magnitude - expected) / (2 * variance)) : 0.0;
  };
  double count = 0;
  double sum = 0;
  bool among_them = false;
  const auto add = [&](std::size_t s) {
    if (s >= dot.faintest) return;
    if (std::any_of(taken.begin(), taken.end(), [&](const EvidenceMatch& m) { return m.star == s; })) return;
    count += 1;
    sum += likelihood(s);
    among_them = among_them || s == candidate.star;
  };
  double field = 4 * std::numbers::pi;
  if (narrow(dot.camera)) {
    each_in_field(dot.camera, j2000_from_rig, add);
    field = coverage_.solid_angle[dot.camera];
  } else {
    for (std::size_t s = 0; s < std::min<std::size_t>(dot.faintest, stars.size()); ++s) add(s);
  }
  if (!among_them) return std::numeric_limits<double>::infinity();
  const double probability =
      sum > 0 ? kBlindPart / count + (1 - kBlindPart) * likelihood(candidate.star) / sum : 1 / count;
  return 1 / (probability * field);
}

}  // namespace omma
