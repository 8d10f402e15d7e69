#include "components/tracker/solar_pairing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kSmear = 0.5;   // phases and blooming shift a disc's centre [px]
constexpr double kBorder = 2.0;  // the image of a disc is larger than the disc [px]

bool is_disc(SolarBody body) {
  return body == SolarBody::kSun || body == SolarBody::kMoon;
}

/// Index of the brightest dot nobody claims within the gate about a predicted point; −1 for none.
int brightest_within(SeenDots& dots, std::size_t camera, const PredictedPoint& point, double gate_chi2) {
  const Eigen::Matrix2d information = point.covariance.inverse();
  const DotList& list = dots.list(camera);
  for (std::size_t d = 0; d < list.dots.size(); ++d) {  // brightest first
    const Eigen::Vector2d offset = list.dots[d].pixel - point.pixel;
    if (dots.claimed(camera)[d] == 0 && offset.dot(information * offset) < gate_chi2)
      return static_cast<int>(d);
  }
  return -1;
}

}  // namespace

void SolarPairing::claim(SeenDots& dots, std::size_t camera, std::uint16_t dot,
                         const SolarBodyPlace& place) noexcept {
  const RigDot* ray = dots.ray(camera, dot);
  if (ray == nullptr) return;
  Pairing pairing;
  pairing.sight = SeenDots::sight(*ray, place.direction);
  pairing.camera = static_cast<std::uint8_t>(camera);
  pairing.dot = dot;
  pairing.entry = static_cast<std::uint16_t>(place.body);
  if (pairs_.push_back(pairing)) dots.claimed(camera)[dot] = 1;
}

void SolarPairing::claim_discs(SeenDots& dots, const RigCamera& camera, std::size_t camera_index,
                               const CameraPrediction& prediction, const AssignmentGate& gate) noexcept {
  const DotList& list = dots.list(camera_index);
  for (const SolarBodyPlace& place : places_) {
    if (!is_disc(place.body) || !place.up) continue;
    PredictedPoint point;
    if (!prediction.point(place.direction, root_sum_square(place.sigma, 0.5 * place.radius), point)) continue;
    point.covariance += (gate.floor_px * gate.floor_px + kSmear * kSmear) * Eigen::Matrix2d::Identity();
    const int brightest = brightest_within(dots, camera_index, point, gate.chi2);
    if (brightest < 0) continue;
    const Dot& disc = list.dots[static_cast<std::size_t>(brightest)];
    if ((disc.flags & kDotSaturated) == 0) continue;  // a star, while a body stands before the Moon
    const double extent = place.radius / camera.lens.pixel_angle() + kBorder;
    for (std::size_t d = 0; d < list.dots.size(); ++d) {
      if (dots.claimed(camera_index)[d] == 0 && (list.dots[d].pixel - disc.pixel).norm() < extent)
        claim(dots, camera_index, static_cast<std::uint16_t>(d), place);
    }
  }
}

std::size_t SolarPairing::predict_planets(const CameraPrediction& prediction, float magnitude_limit,
                                          std::span<PredictedPoint> out) const noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < places_.size() && count < out.size(); ++i) {
    const SolarBodyPlace& place = places_[i];
    if (is_disc(place.body) || !place.up || place.magnitude > magnitude_limit) continue;
    PredictedPoint& point = out[count];
    if (!prediction.in_field(place.direction) || !prediction.point(place.direction, place.sigma, point))
      continue;
    point.entry = static_cast<std::uint16_t>(kFirstEntry + i);
    point.weight = std::pow(10.0F, -0.4F * place.magnitude);
    ++count;
  }
  return count;
}

}  // namespace omma
