#include "sim/point_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omma::sim {
namespace {

// Sub-pixel positions of the table. Linear interpolation between them is wrong by (1/512)²/8 of the second
// derivative: below 2e-6 of the flux for any sigma allowed.
constexpr int kNodes = 512;
constexpr int kMaximumSide = 64;

}  // namespace

PointSpread::PointSpread(double sigma, double side)
    : sigma_(sigma), radius_(static_cast<int>(std::ceil(5.0 * sigma + 0.5))), side_(2 * radius_ + 1) {
  share_.resize(static_cast<std::size_t>((kNodes + 1) * side_));
  slope_.resize(share_.size());
  for (int node = 0; node <= kNodes; ++node) {
    const double offset = static_cast<double>(node) / kNodes - 0.5;
    for (int i = 0; i < side_; ++i) {
      // What sees light reaches from a to b, measured from the source in sigmas.
      const double a = (i - radius_ - 0.5 * side - offset) / sigma;
      const double b = (i - radius_ + 0.5 * side - offset) / sigma;
      const auto at = static_cast<std::size_t>(node * side_ + i);
      share_[at] =
          static_cast<float>(0.5 * (std::erf(b / std::numbers::sqrt2) - std::erf(a / std::numbers::sqrt2)));
      slope_[at] = static_cast<float>((std::exp(-0.5 * a * a) - std::exp(-0.5 * b * b)) /
                                      (sigma * std::sqrt(2.0 * std::numbers::pi)));
    }
  }
}

PointSpread::Profile PointSpread::profile(float position) const {
  const float nearest = std::floor(position + 0.5F);
  const float node = (position - nearest + 0.5F) * kNodes;
  const int below = std::clamp(static_cast<int>(node), 0, kNodes - 1);
  Profile p;
  p.first = static_cast<int>(nearest) - radius_;
  p.share_below = share_.data() + static_cast<std::ptrdiff_t>(below) * side_;
  p.share_above = p.share_below + side_;
  p.slope_below = slope_.data() + static_cast<std::ptrdiff_t>(below) * side_;
  p.slope_above = p.slope_below + side_;
  p.fraction = node - static_cast<float>(below);
  return p;
}

void PointSpread::add(const PointSource& source, int width, int height, float* image) const {
  const Profile pu = profile(source.u);
  const Profile pv = profile(source.v);
  std::array<float, kMaximumSide> along_u;
  for (int i = 0; i < side_; ++i) {
    along_u[i] = source.flux * (pu.share_below[i] + pu.fraction * (pu.share_above[i] - pu.share_below[i]));
  }
  const int i0 = std::max(0, -pu.first);
  const int i1 = std::min(side_, width - pu.first);
  const int j0 = std::max(0, -pv.first);
  const int j1 = std::min(side_, height - pv.first);
  for (int j = j0; j < j1; ++j) {
    const float along_v = pv.share_below[j] + pv.fraction * (pv.share_above[j] - pv.share_below[j]);
    float* row = image + static_cast<std::ptrdiff_t>(pv.first + j) * width + pu.first;
    for (int i = i0; i < i1; ++i) row[i] += along_u[i] * along_v;
  }
}

void PointSpread::add(const PointSource& source, Patch& patch) const {
  const Profile pu = profile(source.u);
  const Profile pv = profile(source.v);
  std::array<float, kMaximumSide> share_u;
  std::array<float, kMaximumSide> slope_u;
  for (int i = 0; i < side_; ++i) {
    share_u[i] = source.flux * (pu.share_below[i] + pu.fraction * (pu.share_above[i] - pu.share_below[i]));
    slope_u[i] = source.flux * (pu.slope_below[i] + pu.fraction * (pu.slope_above[i] - pu.slope_below[i]));
  }
  const int left = pu.first - patch.u0;
  const int top = pv.first - patch.v0;
  const int i0 = std::max(0, -left);
  const int i1 = std::min(side_, patch.width - left);
  const int j0 = std::max(0, -top);
  const int j1 = std::min(side_, patch.height - top);
  for (int j = j0; j < j1; ++j) {
    const float share_v = pv.share_below[j] + pv.fraction * (pv.share_above[j] - pv.share_below[j]);
    const float slope_v = pv.slope_below[j] + pv.fraction * (pv.slope_above[j] - pv.slope_below[j]);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(top + j) * patch.width + left;
    for (int i = i0; i < i1; ++i) {
      patch.value[row + i] += share_u[i] * share_v;
      patch.by_u[row + i] += slope_u[i] * share_v;
      patch.by_v[row + i] += share_u[i] * slope_v;
    }
  }
}

}  // namespace omma::sim
