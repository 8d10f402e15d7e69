#include "ground/stars/star_counts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ground/design/even_sphere.hpp"

namespace omma::ground {
namespace {

// Largest number k of which a Poisson variable is below k with probability ≤ 5 %.
double poisson_quantile(double mean, double part) {
  double term = std::exp(-mean);
  double sum = term;
  int k = 0;
  while (sum < part && k < 100'000) {
    ++k;
    term *= mean / k;
    sum += term;
  }
  return k;
}

std::vector<Eigen::Vector3d> brighter_than(std::span<const SkyStar> stars, double magnitude) {
  std::vector<Eigen::Vector3d> directions;
  for (const SkyStar& star : stars) {
    if (star.magnitude < magnitude) directions.push_back(star.direction);
  }
  return directions;
}

StarCount summary(std::vector<int>& counts, std::size_t stars, double field, double magnitude) {
  std::sort(counts.begin(), counts.end());
  const auto at = [&](double part) {
    return counts[static_cast<std::size_t>(part * static_cast<double>(counts.size() - 1))];
  };
  StarCount count;
  count.field = field;
  count.magnitude = magnitude;
  count.uniform = static_cast<double>(stars) * (1 - std::cos(0.5 * field)) / 2;
  count.poisson_low = poisson_quantile(count.uniform, 0.05);
  double sum = 0;
  double squares = 0;
  for (const int one : counts) {
    sum += one;
    squares += double(one) * one;
  }
  const auto n = static_cast<double>(counts.size());
  count.mean = sum / n;
  count.deviation = std::sqrt(std::max(0.0, squares / n - count.mean * count.mean));
  count.low = at(0.05);
  count.median = at(0.5);
  count.high = at(0.95);
  count.least = counts.front();
  count.most = counts.back();
  return count;
}

}  // namespace

std::vector<StarCount> star_counts(std::span<const SkyStar> stars, std::span<const double> fields,
                                   std::span<const double> magnitudes, int directions) {
  const std::vector<Eigen::Vector3d> axes = even_directions(directions);
  std::vector<StarCount> all;
  for (const double field : fields) {
    const double least_cosine = std::cos(0.5 * field);
    for (const double magnitude : magnitudes) {
      const std::vector<Eigen::Vector3d> bright = brighter_than(stars, magnitude);
      std::vector<int> counts;
      counts.reserve(axes.size());
      for (const Eigen::Vector3d& axis : axes) {
        counts.push_back(
            static_cast<int>(std::count_if(bright.begin(), bright.end(), [&](const Eigen::Vector3d& d) {
              return d.dot(axis) > least_cosine;
            })));
      }
      all.push_back(summary(counts, bright.size(), field, magnitude));
    }
  }
  return all;
}

FieldForStars field_for_stars(std::span<const SkyStar> stars, double magnitude, int count, int directions) {
  const std::vector<Eigen::Vector3d> bright = brighter_than(stars, magnitude);
  const auto needed = static_cast<std::size_t>(count);
  FieldForStars field{2 * std::numbers::pi, 2 * std::numbers::pi};
  if (bright.size() < needed || count < 1) return field;
  double least_cosine = 1;
  std::vector<double> cosines(bright.size());
  for (const Eigen::Vector3d& axis : even_directions(directions)) {
    for (std::size_t i = 0; i < bright.size(); ++i) cosines[i] = bright[i].dot(axis);
    const auto nth = cosines.begin() + (count - 1);
    std::nth_element(cosines.begin(), nth, cosines.end(), std::greater<>());
    least_cosine = std::min(least_cosine, *nth);
  }
  field.always = 2 * std::acos(std::clamp(least_cosine, -1.0, 1.0));
  field.mean = 2 * std::acos(1 - 2.0 * count / static_cast<double>(bright.size()));
  return field;
}

}  // namespace omma::ground
