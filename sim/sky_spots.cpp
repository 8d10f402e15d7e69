#include "sim/sky_spots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {
namespace {

bool hidden(const Eigen::Vector3d& direction, std::span<const CardView> cards) {
  return std::any_of(cards.begin(), cards.end(), [&](const CardView& card) { return card.hides(direction); });
}

void add_point(const CameraView& camera, const Eigen::Vector3d& direction, double flux,
               std::vector<PointSource>& points) {
  Eigen::Vector2d pixel;
  double kept = 0;
  if (!camera.project(direction, pixel, kept)) return;
  points.push_back(
      {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), static_cast<float>(flux * kept)});
}

}  // namespace

void add_stars(const CameraView& camera, const SkyView& view, std::span<const SkyStar> stars,
               const std::optional<Disc>& moon, std::span<const CardView> cards, SpotList& list) {
  const double cos_edge = std::cos(std::min(0.5 * camera.sensor().field, std::numbers::pi));
  const double cos_moon = moon ? std::cos(0.5 * moon->diameter) : 2.0;
  const double share = 1.0 / static_cast<double>(view.drawn.size());
  for (const SkyStar& star : stars) {
    const Eigen::Vector3d direction = view.camera_from_j2000 * star.direction;
    if (direction.z() < cos_edge) continue;
    if (moon && star.direction.dot(moon->direction) > cos_moon) continue;
    Spot spot;
    spot.kind = SpotKind::kStar;
    spot.hr = star.hr;
    double kept = 0;
    const double through = view.transmission(direction);
    if (through == 0 || !camera.project(direction, spot.centre, kept) || hidden(direction, cards)) continue;
    const std::size_t first = list.points.size();
    const double flux = camera.star_electrons(star.magnitude) * share * through;
    for (const Eigen::Matrix3d& camera_from_j2000 : view.drawn) {
      add_point(camera, camera_from_j2000 * star.direction, flux, list.points);
    }
    list.close(spot, first);
  }
}

void add_disc(const CameraView& camera, const SkyView& view, SpotKind kind, const Disc& disc,
              const Eigen::Vector3d* lit_by, std::span<const CardView> cards,
              const DiscQuadrature& quadrature, SpotList& list) {
  const Eigen::Vector3d direction = view.camera_from_j2000 * disc.direction;
  Spot spot;
  spot.kind = kind;
  double kept = 0;
  const double through = view.transmission(direction);
  if (through == 0 || !camera.project(direction, spot.centre, kept) || hidden(direction, cards)) return;
  const double radius = 0.5 * disc.diameter;
  const auto& rule =
      quadrature.rule(radius / camera.camera().lens.pixel_angle() / camera.point_spread().sigma());
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(disc.direction);
  std::vector<double> lit;
  double all = 0;
  for (const QuadraturePoint& q : rule) {
    const double depth = std::sqrt(std::max(0.0, 1 - q.position.squaredNorm()));
    const Eigen::Vector3d normal = basis * q.position - depth * disc.direction;
    lit.push_back(q.weight * (lit_by == nullptr ? 1 : std::max(0.0, normal.dot(*lit_by))));
    all += lit.back();
  }
  if (!(all > 0)) return;  // new Moon
  const double flux =
      through * camera.star_electrons(disc.magnitude) / (all * static_cast<double>(view.drawn.size()));
  const std::size_t first = list.points.size();
  for (const Eigen::Matrix3d& camera_from_j2000 : view.drawn) {
    for (std::size_t k = 0; k < rule.size(); ++k) {
      if (lit[k] == 0) continue;
      const Eigen::Vector3d limb =
          (disc.direction + std::tan(radius) * basis * rule[k].position).normalized();
      add_point(camera, camera_from_j2000 * limb, flux * lit[k], list.points);
    }
  }
  list.close(spot, first);
}

void add_glare(const CameraView& camera, const Spot& spot, const SpotList& list,
               std::vector<float>& electrons) {
  constexpr double kFaintest = 0.01;  // electrons a pixel; below that the halo is not followed
  double flux = 0;
  for (const PointSource& point : list.points_of(spot)) flux += point.flux;
  const double core = camera.sensor().glare_radius;
  const double strength = camera.sensor().glare * flux * core / (2 * std::numbers::pi);
  if (strength <= 0) return;
  const double reach = std::cbrt(strength / kFaintest);
  const int u0 = std::max(0, static_cast<int>(std::floor(std::max(0.0, spot.centre.x() - reach))));
  const int v0 = std::max(0, static_cast<int>(std::floor(std::max(0.0, spot.centre.y() - reach))));
  const int u1 = static_cast<int>(std::min<double>(camera.width(), spot.centre.x() + reach + 1));
  const int v1 = static_cast<int>(std::min<double>(camera.height(), spot.centre.y() + reach + 1));
  for (int v = v0; v < v1; ++v) {
    const auto y = static_cast<float>(v - spot.centre.y());
    const auto constant = y * y + static_cast<float>(core * core);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(v) * camera.width();
    for (int u = u0; u < u1; ++u) {
      const auto x = static_cast<float>(u - spot.centre.x());
      const float r2 = x * x + constant;
      const float lit = camera.transmissions()[static_cast<std::size_t>(row + u)] > 0 ? 1.0F : 0.0F;
      electrons[static_cast<std::size_t>(row + u)] +=
          lit * static_cast<float>(strength) / (r2 * std::sqrt(r2));
    }
  }
}

}  // namespace omma::sim
