#include "components/extractor/fits_ahead.hpp"

#include <algorithm>

#include "components/extractor/spot_start.hpp"
#include "components/extractor/spot_window.hpp"

namespace omma {
namespace {

// Whether the window lies inside the image and has no masked pixel.
bool is_inside(const FitsAhead::Source& source, const SpotFit& fit, int radius) {
  if (!LoneSpots::fits(*source.image, fit.u, fit.v, radius)) return false;
  const int u = nearest_pixel(fit.u), v = nearest_pixel(fit.v);
  return std::ranges::none_of(std::array{source.masks.blind, source.masks.bad}, [&](const PixelMask* mask) {
    return mask != nullptr && mask->any_in(u - radius, v - radius, u + radius, v + radius);
  });
}

}  // namespace

void FitsAhead::fit(const Source& source, const SpotPrior& prior, float max_point_sigma,
                    const SpotField& field, const std::vector<Candidate>& candidates,
                    std::size_t first) noexcept {
  const auto usual = static_cast<double>(prior.sigma);
  const int radius = radius_for(usual);
  // The window, and the light of a neighbour somewhat wider than usual; a place moves by less than a pixel.
  distance_ = static_cast<float>(radius) + 1 + 4 * 1.25F * prior.sigma + 1 + 2;
  const std::size_t count = std::min(kMost, candidates.size() - first);
  for (FitAhead& fit : fits_) fit.state = FitAhead::kNone;
  if (prior.aperture < 1 || radius > LoneSpots::kMostRadius) return;
  spots_.start(radius);
  const auto add = [&](std::size_t i) {
    const Candidate& candidate = candidates[first + i];
    SpotPrior known = prior;
    known.background_error = 0.5F * candidate.noise.sigma;
    whose_[spots_.size()] = i;
    spots_.add(fits_[i].fit, candidate.noise, known);
    if (spots_.full()) step_eight(source, radius);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Candidate& candidate = candidates[first + i];
    if (candidate.saturated > 0 || candidate.peaks > 1) continue;
    if (!(width_of(candidate) < std::min(1.5 * usual, 1.3 * static_cast<double>(max_point_sigma)))) continue;
    if (!field.is_lone(first + i, distance_)) continue;
    start_spot(candidate, &prior, fits_[i].fit);
    if (is_inside(source, fits_[i].fit, radius)) add(i);
  }
  if (spots_.size() > 0) step_eight(source, radius);
  // Those whose first step was not the last take one more, the others of them go on by themselves.
  for (std::size_t i = 0; i < count; ++i)
    if (fits_[i].state == FitAhead::kBegun && is_inside(source, fits_[i].fit, radius)) add(i);
  if (spots_.size() > 0) step_eight(source, radius);
}

void FitsAhead::step_eight(const Source& source, int radius) noexcept {
  spots_.load(*source.image, source.invert);
  spots_.step();
  for (std::size_t i = 0; i < spots_.size(); ++i) {
    FitAhead& ahead = fits_[whose_[i]];
    ahead.state = FitAhead::kNone;
    if (!spots_.is_fit(i)) continue;
    SpotFit& fit = ahead.fit;
    spots_.get(i, fit);
    const bool there = is_central(fit.u, fit.v, spots_.left(i) + radius, spots_.top(i) + radius) &&
                       is_wide_enough(radius, fit.sigma);
    ahead.state = fit.usable && there ? FitAhead::kDone : FitAhead::kBegun;
    ahead.light =
        light_about(nearest_pixel(fit.u) - spots_.left(i), nearest_pixel(fit.v) - spots_.top(i),
                    2 * radius + 1, [&](int row, int column) { return spots_.light(i, row, column); });
  }
  spots_.start(radius);
}

}  // namespace omma
