#include "components/extractor/dot_measurement.hpp"

#include <algorithm>
#include <cmath>

#include "components/extractor/disc_centroid.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/spot_start.hpp"

namespace omma {
namespace {

constexpr std::size_t kSample = 16;  // spots the width is learnt from
constexpr std::size_t kEnough = 6;
constexpr std::size_t kEnoughFaint = 9;  // of a few faint ones noise may be the most
constexpr float kUnlearntWidth = 0.7F;   // error of the width before it is learnt, as a share of it
// Their least signal-to-noise ratio, and what will do where too few have that.
constexpr double kWidthSnr = 8;
constexpr double kFaintWidthSnr = 5;
constexpr float kNarrowest = 0.55F;    // spot of an image, in widths of its point spread
constexpr double kModelError = 0.001;  // what no model of a real spot is better than [px]
// Towards the detection limit a spot's place errs more than its Fisher information says: the next term of
// the expansion in 1/SNR; factor from docs/algorithms/extractor.md#threshold.
constexpr double kSecondOrder = 8;
// Excess of the long axis's variance from which a trail is tried: this share of the spot's variance and of
// that of the half pixel on each side within which sharp spots are drawn out by the sensor.
constexpr double kStretched = 0.3;
constexpr double kSensorVariance = 0.25;  // [px²]
constexpr double kTrailGain = 15;         // by which a trail's χ² must be smaller
constexpr double kManyPixels = 5000;      // whose residuals tell the noise to 2 %
constexpr double kLeastNoiseShare = 0.9;  // [variance]
constexpr int kLeastPixels = 12;          // of a window
constexpr double kApart = 3;              // fit and centroid, in their errors
constexpr double kLeastDiscSigma = 1.5;   // of a blob that may be a disc [px]
// Of one image at most so many dots are measured: the best of them are handed over.
constexpr std::size_t kMost = 2 * limits::kDotsPerCamera;
constexpr int kSweeps = 2;  // over spots in each other's light, after the first

// Square root of the sum of squares; std::hypot is not the same on every machine.
double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// Where the pixels are not as any spot leaves them, neither is the shape.
bool is_elongated(const SpotFit& fit) {
  const double stretch = length(fit.stretch, fit.skew);
  const double error = fit.shape_error * std::sqrt(std::max(1.0, fit.chi2_per_pixel));
  return stretch > 3 * error && stretch > kStretched * (fit.sigma * fit.sigma + kSensorVariance);
}

// Standard deviation of a blob's pixels, were it an even disc [px].
double disc_sigma(const Candidate& candidate) {
  return 0.5 * std::sqrt(candidate.area / M_PI);
}

}  // namespace

DotMeasurement::DotMeasurement(int width, int height, std::size_t dots) : field_(width, height, dots) {
  dot_of_spot_.reserve(dots);
  lone_.reserve(dots);
  widths_.reserve(kSample);
  ranking_.reserve(dots);
  ranking_scratch_.reserve(dots);
  unordered_.reserve(dots);
}

// The pixels within `radius` of (u, v).
void DotMeasurement::load(double u, double v, int radius) noexcept {
  window_.left = nearest_pixel(u) - radius;
  window_.top = nearest_pixel(v) - radius;
  window_.width = 2 * radius + 1;
  window_.height = window_.width;
  load_window(*image_, invert_, background_, masks_, window_);
}

void DotMeasurement::start_at(const Candidate& candidate) noexcept {
  start_spot(candidate, width_known_ ? &prior_ : nullptr, fit_);
}

void DotMeasurement::start_at(const FieldSpot& spot) noexcept {
  fit_.u = spot.u;
  fit_.v = spot.v;
  fit_.sigma = spot.sigma;
  fit_.flux = spot.flux;
}

FieldSpot DotMeasurement::fitted() const noexcept {
  FieldSpot spot;
  spot.u = static_cast<float>(fit_.u);
  spot.v = static_cast<float>(fit_.v);
  spot.sigma = static_cast<float>(fit_.sigma);
  spot.flux = static_cast<float>(fit_.flux);
  return spot;
}

// Fits from where fit_ stands, in a window that follows place and width.
bool DotMeasurement::fit_point(const Candidate& candidate, std::size_t self) noexcept {
  const PixelNoise& noise = candidate.noise;
  background_ = noise.background;
  prior_.background_error = 0.5F * noise.sigma;
  int radius = radius_for(fit_.sigma);
  for (int attempt = 0; attempt < 3; ++attempt) {
    load(fit_.u, fit_.v, radius);
    crowded_ = field_.take_away(self, noise.sigma, window_);
    if (window_.counted < kLeastPixels) return false;
    fit_spot(window_, noise, prior_, fit_);
    if (!fit_.usable) return false;
    const bool central = is_central(fit_.u, fit_.v, window_.left + radius, window_.top + radius);
    if (central && is_wide_enough(radius, fit_.sigma)) break;
    radius = radius_for(fit_.sigma);
  }
  return is_near(candidate);
}

bool DotMeasurement::is_near(const Candidate& candidate) const noexcept {
  return length(fit_.u - candidate.u, fit_.v - candidate.v) < 2 + fit_.sigma;
}

// A single lit pixel: its four neighbours together have less light than the narrowest spot would leave them,
// beyond what noise explains.
bool DotMeasurement::is_hot_pixel(const Candidate& candidate, const MiddleLight& light) const noexcept {
  constexpr double kSure = 3;
  return light.known &&
         static_cast<double>(light.around) + kSure * 2 * static_cast<double>(candidate.noise.sigma) <
             4 * static_cast<double>(light.middle) * least_beside_;
}

MiddleLight DotMeasurement::middle_light() const noexcept {
  const int x = nearest_pixel(fit_.u) - window_.left;
  const int y = nearest_pixel(fit_.v) - window_.top;
  return light_about(x, y, window_.width,
                     [&](int row, int column) { return window_.light[index_of(row, column, kSpotSide)]; });
}

bool DotMeasurement::measure_point(const Candidate& candidate, std::size_t self, Dot& dot) noexcept {
  dot = Dot{};
  return fit_point(candidate, self) && judge_point(candidate, self, middle_light(), dot);
}

// What fit_ says: a point of light, or none.
bool DotMeasurement::judge_point(const Candidate& candidate, std::size_t self, const MiddleLight& light,
                                 Dot& dot) noexcept {
  const double stretch = length(fit_.stretch, fit_.skew);
  const double sigma2 = fit_.sigma * fit_.sigma;
  const bool elongated = is_elongated(fit_);
  dot.snr = static_cast<float>(fit_.flux * std::sqrt(fit_.flux_information));
  if (trails_ && elongated && !(dot.snr < parameters_->min_snr) && try_trail(candidate, self, dot))
    return true;
  if (fit_.sigma > parameters_->max_point_sigma || !(dot.snr >= parameters_->min_snr)) return false;
  dot.pixel = {fit_.u, fit_.v};
  dot.covariance = grown(fit_.covariance, fit_.chi2_per_pixel, dot.snr);
  if (fit_.chi2_per_pixel < significant_chi2()) {
    residuals_ += fit_.chi2_per_pixel * fit_.counted;
    pixels_ += fit_.counted;
  }
  dot.flux = static_cast<float>(fit_.flux);
  dot.sigma_major = static_cast<float>(std::sqrt(sigma2 + stretch));
  dot.sigma_minor = static_cast<float>(std::sqrt(std::max(0.04, sigma2 - stretch)));
  if (elongated && dot.sigma_major > parameters_->elongation * dot.sigma_minor) dot.flags |= kDotElongated;
  if (candidate.saturated == 0 && is_hot_pixel(candidate, light)) {
    dot.flags |= kDotHotPixel;
    if (!parameters_->keep_hot_pixels) return false;
  }
  return true;
}

// A trail, where it explains the pixels better than the round spot does. Leaves fit_ as its neighbours see
// it.
bool DotMeasurement::try_trail(const Candidate& candidate, std::size_t self, Dot& dot) noexcept {
  const PixelNoise& noise = candidate.noise;
  const double variance = static_cast<double>(noise.sigma) * noise.sigma;
  const SpotFit before = fit_;
  const double reach = 2 * std::sqrt(fit_.sigma * fit_.sigma + length(fit_.stretch, fit_.skew)) + 3;
  load(fit_.u, fit_.v, std::clamp(static_cast<int>(std::ceil(reach)), 4, SpotWindow::kRows / 2));
  field_.take_away(self, noise.sigma, window_);
  trail_ = TrailFit{};
  start_trail(window_, noise.sigma, trail_);
  fit_trail(window_, variance, noise.gain, prior_.background_error, trail_);
  fit_spot(window_, noise, prior_, fit_);
  const int freedom = std::max(1, window_.counted - 7);
  const double round_chi2 = fit_.chi2_per_pixel * std::max(1, window_.counted - 5);
  const double gain = kTrailGain * std::max(1.0, trail_.chi2 / freedom);
  const bool better = trail_.usable && (!fit_.usable || trail_.chi2 + gain < round_chi2) &&
                      trail_.sigma < static_cast<double>(parameters_->max_point_sigma) &&
                      length(trail_.u - before.u, trail_.v - before.v) < 2 + before.sigma;
  fit_ = before;
  const double snr = trail_.flux * std::sqrt(trail_.flux_information);
  if (!better || !(snr >= static_cast<double>(parameters_->min_snr))) return false;
  dot.snr = static_cast<float>(snr);
  dot.pixel = {trail_.u, trail_.v};
  dot.covariance = grown(trail_.covariance, trail_.chi2 / freedom, dot.snr);
  dot.flux = static_cast<float>(trail_.flux);
  const double own = std::max(0.04, trail_.sigma * trail_.sigma - 1.0 / 12);  // without the pixel's width
  dot.sigma_minor = static_cast<float>(std::sqrt(own));
  dot.sigma_major = static_cast<float>(std::sqrt(own + trail_.length * trail_.length / 12));
  if (dot.sigma_major > parameters_->elongation * dot.sigma_minor) dot.flags |= kDotElongated;
  fit_.u = trail_.u;
  fit_.v = trail_.v;
  fit_.sigma = static_cast<double>(dot.sigma_major);
  fit_.flux = trail_.flux;
  return true;
}

double DotMeasurement::significant_chi2() const noexcept {
  return 1 + 3 * std::sqrt(2.0 / std::max(1, fit_.counted));
}

// The light of faint and wide spots makes the noise map a little too large; what the fits left over says by
// how much.
double DotMeasurement::noise_share() const noexcept {
  if (pixels_ < kManyPixels) return 1;
  return std::clamp(residuals_ / pixels_, kLeastNoiseShare, 1.0);
}

// A real spot is no Gaussian: where the pixels say so, the covariance grows with their χ².
Eigen::Matrix2d DotMeasurement::grown(const Eigen::Matrix2d& covariance, double chi2_per_pixel,
                                      float snr) const noexcept {
  const double misfit = chi2_per_pixel > significant_chi2() ? chi2_per_pixel : 1;
  const double threshold = 1 + kSecondOrder / (static_cast<double>(snr) * static_cast<double>(snr));
  return misfit * threshold * covariance + kModelError * kModelError * Eigen::Matrix2d::Identity();
}

bool DotMeasurement::may_be_point(const Candidate& candidate) const noexcept {
  return width_of(candidate) < 1.3 * static_cast<double>(parameters_->max_point_sigma);
}

// A spot whose top is cut off has little left that tells its place: where its fit says less than its centroid
// does, or goes away from it, the centroid is taken.
bool DotMeasurement::is_better_as_disc(const Candidate& candidate, const Dot& dot) const noexcept {
  if (candidate.peaks > 1 || crowded_) return false;
  const DiscCentroid disc = disc_centroid(*image_, invert_, candidate);
  if (!(disc.snr >= parameters_->min_snr)) return false;
  const Eigen::Vector2d apart = dot.pixel - disc.centre;
  const double error = dot.covariance.trace() + disc.covariance.trace();
  return dot.covariance.trace() > disc.covariance.trace() || apart.squaredNorm() > kApart * kApart * error;
}

bool DotMeasurement::measure_disc(const Candidate& candidate, Dot& dot) const noexcept {
  dot = Dot{};
  if (candidate.peaks > 1 || (candidate.saturated == 0 && disc_sigma(candidate) < kLeastDiscSigma))
    return false;
  const DiscCentroid disc = disc_centroid(*image_, invert_, candidate);
  if (!(disc.snr >= parameters_->min_snr)) return false;
  dot.pixel = disc.centre;
  dot.covariance = disc.covariance;
  dot.flux = disc.flux;
  dot.snr = disc.snr;
  dot.sigma_major = disc.sigma_major;
  dot.sigma_minor = disc.sigma_minor;
  return true;
}

void DotMeasurement::finish(const Candidate& candidate, Dot& dot) const noexcept {
  dot.peak = candidate.peak;
  dot.background = candidate.noise.background;
  dot.area = static_cast<std::uint16_t>(std::min(candidate.area, 65535));
  if (candidate.saturated > 0) dot.flags |= kDotSaturated;
  if (candidate.left <= 1 || candidate.top <= 1 || candidate.right >= image_->width - 2 ||
      candidate.bottom >= image_->height - 2) {
    dot.flags |= kDotAtEdge;
  }
  if (masks_.blind != nullptr && masks_.blind->any_in(candidate.left - 1, candidate.top - 1,
                                                      candidate.right + 1, candidate.bottom + 1)) {
    dot.flags |= kDotAtEdge;
  }
}

// A fit that ends behind the mask's edge found what is masked.
bool DotMeasurement::is_blind(const Eigen::Vector2d& pixel) const noexcept {
  if (masks_.blind == nullptr) return false;
  const int u = nearest_pixel(pixel.x());
  const int v = nearest_pixel(pixel.y());
  return masks_.blind->any_in(u, v, u, v);
}

// Median and spread of the widths of the brightest spots that stand alone.
void DotMeasurement::learn_width(const std::vector<Candidate>& candidates) noexcept {
  widths_.clear();
  width_known_ = false;
  set_narrowest(parameters_->min_sigma);
  // Some from all that may be handed over: the very brightest may be something else than stars, and so may
  // the faintest of a flood.
  std::size_t elongated = 0;
  std::array<float, kSample> faint_widths{};
  std::size_t faint = 0;
  const std::size_t drawn_from = std::min(candidates.size(), limits::kDotsPerCamera);
  const std::size_t stride = std::max<std::size_t>(1, drawn_from / (2 * kSample));
  for (std::size_t i = 0; i < candidates.size() && widths_.size() < kSample; i += stride) {
    const Candidate& candidate = candidates[i];
    if (candidate.saturated > 0 || candidate.peaks > 1) continue;
    if (!may_be_point(candidate)) continue;
    start_at(candidate);
    // About what its area says, and loosely: one width for all would draw wide spots to itself.
    prior_.sigma = static_cast<float>(fit_.sigma);
    prior_.sigma_error = kUnlearntWidth * prior_.sigma;
    if (!fit_point(candidate, field_.size())) continue;
    if (fit_.sigma < parameters_->min_sigma || fit_.sigma > parameters_->max_point_sigma) continue;
    const double snr = fit_.flux * std::sqrt(fit_.flux_information);
    if (snr < kWidthSnr && snr > kFaintWidthSnr && faint < kSample)
      faint_widths[faint++] = static_cast<float>(fit_.sigma);
    if (snr < kWidthSnr) continue;
    widths_.push_back(static_cast<float>(fit_.sigma));
    elongated += is_elongated(fit_) ? 1 : 0;
  }
  // One long spot may be two stars; when most are long, the camera moved.
  trails_ = 2 * elongated > widths_.size();
  if (widths_.size() < kEnough && faint >= kEnoughFaint)
    for (std::size_t i = 0; i < faint && widths_.size() < kSample; ++i) widths_.push_back(faint_widths[i]);
  prior_.sigma = 1.0F;
  prior_.sigma_error = kUnlearntWidth;
  if (widths_.size() < kEnough) return;
  const auto median = [&] {
    const auto middle = widths_.begin() + static_cast<std::ptrdiff_t>(widths_.size() / 2);
    std::nth_element(widths_.begin(), middle, widths_.end());
    return *middle;
  };
  const float sigma = median();
  for (float& width : widths_) width = std::fabs(width - sigma);
  prior_.sigma = sigma;
  prior_.sigma_error = std::max(0.1F * sigma, 2 * median());
  width_known_ = true;
  set_narrowest(std::max(parameters_->min_sigma, kNarrowest * sigma));
}

void DotMeasurement::set_narrowest(float sigma) noexcept {
  SpotProfile profile;
  profile.fill(1, sigma, 3);
  least_beside_ = static_cast<double>(profile.share[2]) / static_cast<double>(profile.share[1]);
}

// Spots in each other's light once more, now that all are known. Returns whether there are any.
bool DotMeasurement::remeasure_crowded(const std::vector<Candidate>& candidates,
                                       std::vector<Dot>& dots) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < field_.size(); ++i) {
    if (dot_of_spot_[i] < 0) continue;
    start_at(field_[i]);
    const int radius = radius_for(fit_.sigma);
    if (lone_[i] != 0 && field_.is_far(ahead_.distance(), radius)) continue;
    if (field_.is_alone(i, radius)) continue;
    any = true;
    Dot dot;
    if (measure_point(candidates[i], i, dot) &&
        !field_.has_twin(i, static_cast<float>(fit_.u), static_cast<float>(fit_.v))) {
      finish(candidates[i], dot);
      field_.set(i, fitted());
      dots[static_cast<std::size_t>(dot_of_spot_[i])] = dot;
    } else {
      field_.set(i, {});
      dots[static_cast<std::size_t>(dot_of_spot_[i])].snr = 0;
      dot_of_spot_[i] = -1;
    }
  }
  return any;
}

// Brightest first. Each candidate is moved once.
void DotMeasurement::put_in_order(std::vector<Candidate>& candidates) noexcept {
  ranking_.resize(candidates.size());
  ranking_scratch_.resize(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i)
    ranking_[i] = {falling_key(candidates[i].height), static_cast<std::uint32_t>(i)};
  sort_by_key(ranking_, ranking_scratch_);
  unordered_ = candidates;
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i] = unordered_[ranking_[i].index];
  for (auto first = candidates.begin(); first != candidates.end();) {  // ties in reading order
    const auto last = std::find_if(first, candidates.end(), [&](const Candidate& candidate) {
      return candidate.height != first->height;
    });
    if (last - first > 1) std::sort(first, last, brighter);
    first = last;
  }
}

float DotMeasurement::start(const ImageView& image, bool invert, const ExtractorParameters& parameters,
                            const ImageMasks& masks, std::vector<Candidate>& candidates) noexcept {
  image_ = &image;
  parameters_ = &parameters;
  invert_ = invert;
  masks_ = masks;
  prior_.aperture = std::sqrt(parameters.fill_factor);
  field_.clear();
  dot_of_spot_.clear();
  lone_.assign(candidates.size(), 0);
  put_in_order(candidates);
  learn_width(candidates);
  return width_known_ ? prior_.sigma : 0;
}

std::size_t DotMeasurement::measure(const std::vector<Candidate>& candidates,
                                    std::vector<Dot>& dots) noexcept {
  const std::size_t enough = std::min(dots.capacity(), dots.size() + kMost);
  const std::size_t before = dots.size();
  std::size_t measured = 0;
  residuals_ = pixels_ = 0;
  // Peaks of one blob are taken to be spots before they are measured: their light must not draw each other.
  for (const Candidate& candidate : candidates) {
    FieldSpot spot;
    spot.u = candidate.u;
    spot.v = candidate.v;
    if (candidate.peaks > 1) {
      spot.sigma = prior_.sigma;
      spot.flux = static_cast<float>(2 * M_PI) * (spot.sigma * spot.sigma + 0.58F) * candidate.height;
    }
    field_.add(spot);
    dot_of_spot_.push_back(-1);
  }
  for (std::size_t i = 0; i < candidates.size() && dots.size() < enough; ++i, ++measured) {
    const Candidate& candidate = candidates[i];
    Dot dot;
    if (i % FitsAhead::kMost == 0 && width_known_ && !trails_)
      ahead_.fit({image_, invert_, masks_}, prior_, parameters_->max_point_sigma, field_, candidates, i);
    const FitAhead* ahead = width_known_ && !trails_ ? &ahead_[i % FitsAhead::kMost] : nullptr;
    bool point = false;
    if (ahead != nullptr && ahead->state == FitAhead::kDone) {
      lone_[i] = 1;
      crowded_ = false;
      fit_ = ahead->fit;
      point = is_near(candidate) && judge_point(candidate, i, ahead->light, dot);
    } else {
      start_at(candidate);
      if (field_[i].flux > 0) start_at(field_[i]);
      if (ahead != nullptr && ahead->state == FitAhead::kBegun) fit_ = ahead->fit;
      point = may_be_point(candidate) && measure_point(candidate, i, dot);
    }
    if (point && candidate.saturated > 0 && is_better_as_disc(candidate, dot)) point = false;
    field_.set(i, {});
    if (point) {
      if (lone_[i] == 0 && field_.has_twin(i, static_cast<float>(fit_.u), static_cast<float>(fit_.v)))
        continue;
      field_.set(i, fitted());
      dot_of_spot_[i] = static_cast<int>(dots.size());
    } else if (!measure_disc(candidate, dot)) {
      continue;
    }
    if (is_blind(dot.pixel)) continue;
    finish(candidate, dot);
    dots.push_back(dot);
  }
  for (int sweep = 0; sweep < kSweeps && remeasure_crowded(candidates, dots); ++sweep) {
  }
  for (std::size_t i = before; i < dots.size(); ++i) dots[i].covariance *= noise_share();
  std::erase_if(dots, [](const Dot& dot) { return dot.snr == 0; });
  return candidates.size() - measured;
}

}  // namespace omma
