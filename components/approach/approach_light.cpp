// Approach: what one frame set shows of lights: the zero point of its stars, the brightness of candidates,
// the light of a body that is followed.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/approach/approach.hpp"
#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kStarSnr = 10;     // fainter stars say little about the zero point
constexpr double kPartSigma = 0.3;  // of ln brightness: what a dot may lack of the light of a body that parts
constexpr double kDotScatter = 0.1;  // of ln brightness of dots, beside their noise
constexpr double kOfLate = 0.2;      // of a running mean, a frame set
constexpr double kExpected =
    0.4;  // of ln brightness: a light known so well is looked for under the noise of dots
constexpr double kLeastSnr = 4;  // of the light expected: less says nothing
constexpr std::uint8_t kPartOfFlux = kDotSaturated | kDotAtEdge | kDotElongated | kDotHotPixel;

}  // namespace

void Approach::learn_zero() noexcept {
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) zeros_[c].begin_frame();
  for (std::size_t i = 0; i < pairings->sky.pairs.size(); ++i) {
    const Pairing& pair = pairings->sky.pairs[i];
    const Dot& dot = dots->cameras[pair.camera].dots[pair.dot];
    const bool culled = i < attitude->used.size() && attitude->used[i] == 0;
    if (culled || dot.snr < kStarSnr || (dot.flags & kPartOfFlux) != 0 || !(dot.flux > 0)) continue;
    zeros_[pair.camera].add_star(std::log(dot.flux), 1 / dot.snr, magnitudes_[pair.entry],
                                 off_axis(pair.sight.point, pair.camera));
  }
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) zeros_[c].end_frame();
}

ExpectedLight Approach::expected(const Followed& body) const noexcept {
  ExpectedLight light{.direction = body.bearing.direction(),
                      .range = body.range.range(),
                      .log_range_sigma = body.range.log_range_sigma(),
                      .size = body.size,
                      .pixel = finest_pixel_,
                      .summed = body.summed};
  light.sigma = std::sqrt(0.5 * (body.bearing.covariance() + attitude_covariance_).trace());
  return light;
}

void Approach::see_light(Followed& body) noexcept {
  const ExpectedLight expected = this->expected(body);
  find_light(*leftovers, *dots, rig_, rig_from_j2000_, expected, sightings_);
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    LightSighting& of_dots = sightings_[c];
    LightSighting sum;
    const bool summed = look(expected, c, sum) == Looked::kSeen;
    const bool bright = summed && sum.flux >= parameters_.modes.snr_leave * sum.flux_sigma;
    if (aperture_radius(expected, rig_.cameras[c]) > 0) of_dots.whole = false;  // may leave a part out
    const LightSighting& sighting = bright ? sum : of_dots;
    Eigen::Matrix3d pull = Eigen::Matrix3d::Zero();
    if (!bright && of_dots.seen) pull = pull_of_stars(of_dots.direction, of_dots.flux, c);
    widen(of_dots, pull);
    if (sighting.seen) {
      body.flux = body.seen ? std::max(body.flux, sighting.flux) : sighting.flux;
      body.snr = std::max(body.snr, sighting.flux / sighting.flux_sigma);
      body.seen = true;
      body.pull += kOfLate * (pull - body.pull);
      body.summed += kOfLate * ((bright ? 1.0 : 0.0) - body.summed);
      body.bearing.update(body.bearing.innovation(sighting.whitener, attitude_covariance_));
    }
    if (summed || of_dots.seen) see_brightness(body, c, summed ? sum : of_dots, summed);
  }
}

// All the light of the image where the body is expected.
Looked Approach::look(const ExpectedLight& expected, std::size_t camera, LightSighting& out) noexcept {
  const DotList& list = dots->cameras[camera];
  if (list.status != FrameStatus::kFresh || camera >= frames->cameras.size() ||
      !(parameters_.gain[camera] > 0))
    return Looked::kNothing;
  find_stars(expected.direction, aperture_radius(expected, rig_.cameras[camera]) + 3, camera);
  const Aperture aperture{.noise = list.noise, .gain = parameters_.gain[camera]};
  return look_at_light(frames->cameras[camera].image, rig_.cameras[camera], static_cast<std::uint8_t>(camera),
                       aperture, stars_, floor_px_, rig_from_j2000_, expected, out);
}

// Stars about a direction, with the light that this camera has of them.
void Approach::find_stars(const Eigen::Vector3d& direction, double reach_px, std::size_t camera) noexcept {
  const RigCamera& seen_by = rig_.cameras[camera];
  const double reach = reach_px * seen_by.lens.pixel_angle();
  double sigma = 0;
  const double zero = zeros_[camera].at(off_axis(direction, camera), sigma);
  stars_.clear();
  catalogue_.near(direction, reach, [&](std::uint16_t s) {
    const SkyStar& star = catalogue_.stars()[s];
    if (stars_.size() == stars_.capacity()) return;
    if ((star.direction - direction).squaredNorm() > reach * reach) return;
    stars_.push_back({star.direction, std::exp(zero - kLogPerMagnitude * star.magnitude)});
  });
}

// A star beside a dot may have a part in it: then the rest is the other way.
Eigen::Matrix3d Approach::pull_of_stars(const Eigen::Vector3d& direction, double flux,
                                        std::size_t camera) noexcept {
  constexpr double kBeside = 4;   // px: farther ones are dots of their own
  constexpr double kLeast = 0.3;  // of a dot is something else than the star
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  if (!zeros_[camera].known() || !(flux > 0)) return covariance;
  find_stars(direction, kBeside, camera);
  for (const StarNearby& star : stars_) {
    const double part = std::min(star.flux / flux, 1.0);
    const Eigen::Vector3d offset = part / std::max(1 - part, kLeast) * (star.direction - direction);
    covariance += offset * offset.transpose();
  }
  return covariance;
}

double Approach::off_axis(const Eigen::Vector3d& direction, std::size_t camera) const noexcept {
  const Eigen::Vector3d axis = rig_.cameras[camera].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  return std::acos(std::clamp(axis.dot(rig_from_j2000_ * direction), -1.0, 1.0));
}

CandidateLight Approach::light_of(const UnknownObject& object) const noexcept {
  CandidateLight light;
  double brightest = 0;
  for (std::size_t c = 0; c < dots->cameras.size(); ++c) {
    if (!object.bearing.seen || object.bearing.dot[c] < 0 || !zeros_[c].known()) continue;
    const Dot& dot = dots->cameras[c].dots[static_cast<std::size_t>(object.bearing.dot[c])];
    if ((dot.flags & kPartOfFlux) != 0 || double(dot.flux) <= brightest) continue;
    brightest = dot.flux;
    double sigma = 0;
    light.log_brightness = std::log(brightest) - zeros_[c].at(off_axis(object.direction, c), sigma);
    light.sigma = root_sum_square(1 / double(dot.snr), sigma, kDotScatter);
  }
  return light;
}

// S of RangeFilter: light of the sky in a circle about the body's lights, at one metre.
double Approach::sky_behind(const Followed& body, std::size_t camera, double background,
                            double zero) const noexcept {
  if (!(parameters_.gain[camera] > 0)) return 0;
  const double level = std::max(background - parameters_.black_level[camera], 0.0);
  const double radius = body.size.radius / rig_.cameras[camera].lens.pixel_angle();
  return level * std::numbers::pi * radius * radius * std::exp(-zero);
}

// Noise in proportion to the light expected: with the light seen, a faint measurement would count for less.
// What was looked for where it is expected may be fainter than what was found.
void Approach::see_brightness(Followed& body, std::size_t camera, const LightSighting& light,
                              bool looked_for) noexcept {
  if (!zeros_[camera].known() || !light.whole) return;
  double zero_sigma = 0;
  const double zero = zeros_[camera].at(light.axis_angle, zero_sigma);
  Brightness seen{.sky = sky_behind(body, camera, light.background, zero)};
  const bool expects = body.range.expected_brightness_sigma(seen.sky) < kExpected;
  const double expected_flux = std::exp(body.range.expected_brightness(seen.sky) + zero);
  const double flux = expects ? expected_flux : light.flux;
  const bool bright = light.flux >= parameters_.modes.snr_leave * light.flux_sigma;
  if (!bright && !looked_for) return;
  if (!bright && flux < kLeastSnr * light.flux_sigma) return;
  // While its range is not known the light may be more than one dot.
  const double part = body.range.log_range_sigma() < kRangeKnown ? 0.0 : kPartSigma;
  seen.sigma = root_sum_square(root_sum_square(light.flux_sigma, light.unsure) / flux, zero_sigma, part);
  // The logarithm of much noise is too small.
  seen.log = bright || !expects ? std::log(light.flux) - zero
                                : body.range.expected_brightness(seen.sky) + light.flux / expected_flux - 1;
  // A thing beside it, or a glint: not for once. Many in a row, and the light has changed.
  const bool fits = body.range.fits(seen);
  body.unlike = fits ? 0 : body.unlike + 1;
  if (!fits && body.unlike <= parameters_.patience) return;
  if (!fits) body.range.restart();
  body.unlike = 0;
  body.range.see_brightness(seen);
}

}  // namespace omma
