#include "components/extractor/classical/classical_extractor.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// The centre of a binary object is as uncertain as its border: P pixels around, each in or out with a
// variance of share / 4, at the radius of a disc of the area A, give share / (4 sqrt(pi A)); and as the noise
// that its border follows: times the second moments over the squared signal-to-noise ratio. Both as measured,
// docs/algorithms/classical_extraction.md#in-flight.
struct CentreError {
  double border, noise;
};
CentreError centre_error(ExtractorAlgorithm algorithm) {
  switch (algorithm) {
    case ExtractorAlgorithm::kMlas:
      return {0.15, 2};
    case ExtractorAlgorithm::kSmallTarget:
      return {0.055, 2.5};
    default:
      return {0.057, 10};
  }
}

ClassicalAlgorithm classical(ExtractorAlgorithm algorithm) {
  switch (algorithm) {
    case ExtractorAlgorithm::kMlas:
      return ClassicalAlgorithm::kMlas;
    case ExtractorAlgorithm::kSmallTarget:
      return ClassicalAlgorithm::kSmallTarget;
    default:
      return ClassicalAlgorithm::kStars;
  }
}

// Of a dot, with the background's level and noise about it.
void judge_light(const ClassicalDot& found, const ExtractorParameters& parameters, float level, float noise,
                 Dot& dot) {
  const float gain = parameters.gain > 0 ? parameters.gain
                                         : std::max(1.0F, level - parameters.black_level) / (noise * noise);
  const auto area = static_cast<float>(found.area);
  dot.flux = found.light - area * level;
  dot.peak = found.peak - level;
  dot.background = level;
  dot.snr = dot.flux / std::sqrt(area * noise * noise + std::max(0.0F, dot.flux) / gain);
}

}  // namespace

ClassicalExtractor::ClassicalExtractor(int width, int height, const ExtractorParameters& parameters)
    : width_(width),
      height_(height),
      algorithm_(parameters.algorithm),
      background_(width, height),
      pipelines_(width, height, parameters.classical),
      best_(2 * ClassicalPipelines::kMost) {
  found_.reserve(2 * ClassicalPipelines::kMost);
}

void ClassicalExtractor::extract(const ImageView& image, const ExtractorParameters& parameters,
                                 const PixelMask* blind, DotList& list) noexcept {
  list.dots.clear();
  list.dropped = 0;
  found_.clear();
  overflow_ = 0;
  if (image.empty() || image.width != width_ || image.height != height_ || width_ < 3 || height_ < 3) return;
  if (parameters.polarity != DotPolarity::kBright) search(image, true, parameters, blind);
  if (parameters.polarity != DotPolarity::kDark) search(image, false, parameters, blind);
  list.background = background_.median_level();
  list.noise = background_.median_noise();
  best_.hand_over(found_, overflow_, list);
}

void ClassicalExtractor::search(const ImageView& image, bool invert, const ExtractorParameters& parameters,
                                const PixelMask* blind) noexcept {
  background_.build(image, invert, blind);
  take_levels(image, invert, pipelines_.original());
  for (const ClassicalDot& found : pipelines_.run(classical(algorithm_))) {
    if (std::max(found.right - found.left, found.bottom - found.top) >= parameters.max_diameter) continue;
    if (blind != nullptr && blind->any_in(found.left - 1, found.top - 1, found.right + 1, found.bottom + 1))
      continue;
    const auto u = static_cast<float>(found.pixel.x());
    const auto v = static_cast<float>(found.pixel.y());
    Dot dot;
    dot.pixel = found.pixel;
    judge_light(found, parameters, background_.level(u, v), background_.noise(u, v), dot);
    if (!(dot.snr >= parameters.min_snr)) continue;
    const CentreError error = centre_error(algorithm_);
    const double snr = dot.snr;
    dot.covariance = error.border / std::sqrt(static_cast<double>(found.area)) * Eigen::Matrix2d::Identity() +
                     error.noise / (snr * snr) * found.moments;
    const Eigen::Vector2d axes = axes_of(found.moments);
    dot.sigma_major = static_cast<float>(axes.x());
    dot.sigma_minor = static_cast<float>(axes.y());
    dot.area = static_cast<std::uint16_t>(std::min(found.area, 65535));
    if (dot.sigma_major > parameters.elongation * dot.sigma_minor) dot.flags |= kDotElongated;
    if (found.peak >= static_cast<float>(image.white_level)) dot.flags |= kDotSaturated;
    found_.push_back(dot);
  }
  overflow_ += pipelines_.dropped();
}

}  // namespace omma
