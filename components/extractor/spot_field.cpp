#include "components/extractor/spot_field.hpp"

#include <algorithm>
#include <cmath>

#include "components/extractor/index.hpp"

namespace omma {
namespace {

constexpr float kNeighbourError = 0.1F;  // a neighbour's light is known to this share of it
constexpr float kNoLight = 0.1F;         // [standard deviations of a pixel]

float reach(const FieldSpot& spot) {
  return std::min(16.0F, 4 * spot.sigma + 1);
}

}  // namespace

SpotField::SpotField(int width, int height, std::size_t spots)
    : columns_((width + kCell - 1) / kCell), rows_((height + kCell - 1) / kCell) {
  first_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  spots_.reserve(spots);
  homes_.reserve(spots);
  clear();
}

void SpotField::clear() noexcept {
  std::fill(first_.begin(), first_.end(), -1);
  spots_.clear();
  homes_.clear();
  largest_reach_ = 0;
  largest_move_ = 0;
}

std::size_t SpotField::add(const FieldSpot& spot) noexcept {
  const int column = std::clamp(static_cast<int>(spot.u) / kCell, 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(spot.v) / kCell, 0, rows_ - 1);
  int& head = first_[index_of(row, column, columns_)];
  spots_.push_back(spot);
  homes_.push_back({spot.u, spot.v, head});
  head = static_cast<int>(spots_.size()) - 1;
  if (spot.flux > 0) largest_reach_ = std::max(largest_reach_, reach(spot));
  return spots_.size() - 1;
}

// Visits every spot added within `distance` of (u, v) on both axes, and some beyond.
template <class Visit>
void SpotField::for_added(float u, float v, float distance, Visit&& visit) const noexcept {
  const auto cell = [](float x) { return static_cast<int>(std::max(0.0F, x)) / kCell; };
  for (int r = cell(v - distance); r <= std::min(rows_ - 1, cell(v + distance)); ++r) {
    for (int c = cell(u - distance); c <= std::min(columns_ - 1, cell(u + distance)); ++c) {
      for (int i = first_[index_of(r, c, columns_)]; i >= 0; i = homes_[index_of(i)].next) visit(index_of(i));
    }
  }
}

// The same for those that have light, wherever they were added.
template <class Visit>
void SpotField::for_near(float u, float v, float distance, Visit&& visit) const noexcept {
  for_added(u, v, distance + largest_move_, [&](std::size_t i) {
    if (spots_[i].flux > 0) visit(i, spots_[i]);
  });
}

bool SpotField::is_lone(std::size_t self, float distance) const noexcept {
  const Home& at = homes_[self];
  bool lone = true;
  for_added(at.u, at.v, distance, [&](std::size_t i) {
    const Home& other = homes_[i];
    lone =
        lone && (i == self || std::fabs(other.u - at.u) > distance || std::fabs(other.v - at.v) > distance);
  });
  return lone;
}

void SpotField::set(std::size_t i, const FieldSpot& spot) noexcept {
  spots_[i] = spot;
  if (!(spot.flux > 0)) return;
  largest_reach_ = std::max(largest_reach_, reach(spot));
  const Home& home = homes_[i];
  largest_move_ = std::max({largest_move_, std::fabs(spot.u - home.u), std::fabs(spot.v - home.v)});
}

bool SpotField::is_alone(std::size_t self, int radius) const noexcept {
  const FieldSpot& at = spots_[self];
  const float half = static_cast<float>(radius) + 1;
  bool alone = true;
  for_near(at.u, at.v, half + largest_reach_, [&](std::size_t i, const FieldSpot& spot) {
    const float far = half + reach(spot);
    alone = alone && (i == self || std::fabs(spot.u - at.u) > far || std::fabs(spot.v - at.v) > far);
  });
  return alone;
}

bool SpotField::take_away(std::size_t self, float noise, SpotWindow& window) const noexcept {
  const float half = 0.5F * static_cast<float>(window.width);
  const float middle_u = static_cast<float>(window.left) + half - 0.5F;
  const float middle_v = static_cast<float>(window.top) + half - 0.5F;
  const float least = kNoLight * noise;
  const float per_variance = kNeighbourError * kNeighbourError / (noise * noise);
  bool any = false;
  for_near(middle_u, middle_v, half + largest_reach_, [&](std::size_t i, const FieldSpot& spot) {
    const float far = half + reach(spot);
    if (i == self || std::fabs(spot.u - middle_u) > far || std::fabs(spot.v - middle_v) > far) return;
    SpotProfile along_u, along_v;
    along_u.fill(spot.u - static_cast<float>(window.left), spot.sigma, window.width);
    along_v.fill(spot.v - static_cast<float>(window.top), spot.sigma, window.height);
    for (int y = 0; y < window.height; ++y) {
      const float row = spot.flux * along_v.share[static_cast<std::size_t>(y)];
      if (row < least) continue;
      for (int x = 0; x < window.width; ++x) {
        const float there = row * along_u.share[static_cast<std::size_t>(x)];
        if (there < least) continue;
        any = true;
        const auto k = index_of(y, x, kSpotSide);
        window.light[k] -= there;
        window.weight[k] /= 1 + per_variance * there * there;
      }
    }
  });
  return any;
}

bool SpotField::has_twin(std::size_t self, float u, float v) const noexcept {
  bool found = false;
  const float largest_twin = std::max(1.0F, largest_reach_);  // a spot's reach is more than its twin distance
  for_near(u, v, largest_twin, [&](std::size_t i, const FieldSpot& spot) {
    const float du = spot.u - u;
    const float dv = spot.v - v;
    const float twin = std::max(1.0F, 1.2F * spot.sigma);
    found = found || (i != self && du * du + dv * dv < twin * twin);
  });
  return found;
}

}  // namespace omma
