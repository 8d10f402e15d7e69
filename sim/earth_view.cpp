#include "sim/earth_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/catalogue/orbit.hpp"

namespace omma::sim {
namespace {

constexpr double kTwilight = 0.02;       // sine of the Sun's depression over which twilight falls e-fold
constexpr double kFaintestShare = 1e-9;  // of the limb's light; above it the air is empty
constexpr double kSquareArcsecondsPerSteradian = 206264.806 * 206264.806;

}  // namespace

double daylight(double cosine) {
  const double x = cosine / kTwilight;
  return x > 30 ? cosine : kTwilight * std::log1p(std::exp(x));
}

EarthView::EarthView(const CameraView& camera, const EarthPlace& place,
                     const Eigen::Matrix3d& camera_from_j2000)
    : camera_(camera), look_(place.look), to_sun_(camera_from_j2000 * place.to_sun) {
  // Chapman's grazing incidence: a horizontal ray passes sqrt(2 pi R / H) times the air above a place.
  tangent_depth_ = look_.optical_depth * std::sqrt(2 * std::numbers::pi * kEarthRadius / look_.scale_height);
  const Eigen::Vector3d stretch(1, 1, kEarthRadius / kEarthPolarRadius);
  squash_ = camera_from_j2000 * stretch.asDiagonal() * camera_from_j2000.transpose();
  eye_ = squash_ * (camera_from_j2000 * place.observer) / kEarthRadius;
  sunlight_ = std::pow(10.0, -0.4 * place.sun_magnitude) * look_.albedo / std::numbers::pi;
  night_ = std::pow(10.0, -0.4 * look_.night_magnitude) * kSquareArcsecondsPerSteradian;
  const double top = look_.scale_height * std::log(tangent_depth_ / kFaintestShare);
  const double radius = std::min(1.0, (1 + top / kEarthRadius) / eye_.norm() + 0.02);
  cos_reach_ = std::cos(std::asin(radius));
  blur_limb();
}

double EarthView::opacity(double height) const {
  return height < 0 ? 1 : -std::expm1(-tangent_depth_ * std::exp(-height / look_.scale_height));
}

// The limb is a straight edge to a spot of the point spread: its profile is that of the air, convolved with
// the spread of lens and pixel, in height.
void EarthView::blur_limb() {
  const double distance = kEarthRadius * std::sqrt(std::max(0.0, eye_.squaredNorm() - 1));
  const double spread = std::hypot(camera_.point_spread().sigma(), std::sqrt(1.0 / 12)) *
                        camera_.camera().lens.pixel_angle() * distance;
  const double step = std::max(0.25 * look_.scale_height, spread / 40);
  const int taps = static_cast<int>(std::ceil(5 * spread / step));
  const double top = look_.scale_height * std::log(tangent_depth_ / kFaintestShare);
  first_height_ = static_cast<float>(-taps * step);
  height_step_ = static_cast<float>(step);
  const int nodes = 2 * taps + static_cast<int>(std::ceil(top / step)) + 1;
  std::vector<double> sharp;
  for (int i = -taps; i < nodes + taps; ++i) sharp.push_back(opacity(first_height_ + i * step));
  std::vector<double> kernel;
  double sum = 0;
  for (int k = -taps; k <= taps; ++k) {
    kernel.push_back(taps == 0 ? 1 : std::exp(-0.5 * std::pow(k * step / spread, 2)));
    sum += kernel.back();
  }
  limb_.clear();
  for (int i = 0; i < nodes; ++i) {
    double value = 0;
    for (std::size_t k = 0; k < kernel.size(); ++k)
      value += kernel[k] * sharp[static_cast<std::size_t>(i) + k];
    limb_.push_back(static_cast<float>(value / sum));
  }
}

float EarthView::blurred_opacity(float height) const {
  const float at = (height - first_height_) / height_step_;
  if (at < 0) return 1;
  const auto node = static_cast<std::size_t>(at);
  if (node + 1 >= limb_.size()) return 0;
  const float part = at - static_cast<float>(node);
  return limb_[node] + part * (limb_[node + 1] - limb_[node]);
}

float EarthView::radiance(float cosine) const {
  return static_cast<float>(sunlight_ * daylight(cosine) + night_);
}

std::optional<EarthSight> EarthView::sight(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d ray = (squash_ * direction).normalized();
  const double along = eye_.dot(ray);
  if (!(along < 0)) return std::nullopt;
  EarthSight sight;
  const double closest = eye_.cross(ray).norm();
  sight.height = (closest - 1) * kEarthRadius;
  const double depth = closest < 1 ? std::sqrt(1 - closest * closest) : 0;
  sight.normal = (eye_ - (along + depth) * ray).normalized();
  return sight;
}

double EarthView::transmission(const Eigen::Vector3d& direction) const {
  const auto along = sight(direction);
  return along ? 1 - opacity(along->height) : 1;
}

void EarthView::paint(std::vector<float>& electrons) const {
  const Eigen::Matrix3f squash = squash_.cast<float>();
  const Eigen::Vector3f eye = eye_.cast<float>();
  const Eigen::Vector3f to_centre = -eye.normalized();
  const Eigen::Vector3f to_sun = to_sun_.cast<float>();
  const auto reach = static_cast<float>(cos_reach_);
  const auto radius = static_cast<float>(kEarthRadius);
  const auto per_unit = static_cast<float>(camera_.star_electrons(0));
  const auto& rays = camera_.corner_rays();
  const auto pitch = static_cast<std::size_t>(camera_.width()) + 1;
  std::size_t at = 0;
  for (int v = 0; v < camera_.height(); ++v) {
    for (int u = 0; u < camera_.width(); ++u, ++at) {
      const std::size_t corner = static_cast<std::size_t>(v) * pitch + static_cast<std::size_t>(u);
      if (!(camera_.transmissions()[at] > 0)) continue;
      const Eigen::Vector3f ray = (squash * (rays[corner] + rays[corner + pitch + 1])).normalized();
      if (!(ray.dot(to_centre) > reach)) continue;
      const float closest = eye.cross(ray).norm();
      const float share = blurred_opacity((closest - 1) * radius);
      if (!(share > 0)) continue;
      const float depth = closest < 1 ? std::sqrt(1 - closest * closest) : 0.0F;
      const float cosine = (eye - (eye.dot(ray) + depth) * ray).normalized().dot(to_sun);
      const float dark = camera_.dark()[at];
      const float earth =
          per_unit * radiance(cosine) * camera_.solid_angles()[at] * camera_.transmissions()[at];
      electrons[at] = dark + (1 - share) * (electrons[at] - dark) + share * earth;
    }
  }
}

EarthView::Light EarthView::light() const {
  constexpr int kRings = 24;
  constexpr int kRingPoints = 48;
  Light light{Eigen::Vector3d::Zero(), 0};
  const Eigen::Vector3d centre = -eye_.normalized();
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(centre);
  const double solid_angle = 2 * std::numbers::pi * (1 - cos_reach_) / (kRings * kRingPoints);
  for (int ring = 0; ring < kRings; ++ring) {
    const double cosine = 1 - (1 - cos_reach_) * (ring + 0.5) / kRings;
    const double sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < kRingPoints; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / kRingPoints;
      const Eigen::Vector3d ray =
          cosine * centre + sine * (basis * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      const auto along = sight(ray);
      if (!along) continue;
      const double flux =
          solid_angle * opacity(along->height) * radiance(static_cast<float>(along->normal.dot(to_sun_)));
      light.flux += flux;
      light.direction += flux * ray;
    }
  }
  light.direction.normalize();
  return light;
}

}  // namespace omma::sim
