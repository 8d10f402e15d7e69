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
               std::span<const float> factors, const std::optional<Disc>& moon,
               std::span<const CardView> cards, SpotList& list) {
  constexpr double kRefracted = 0.012;  // 40': as far as the air lifts a star
  const double edge = std::min(0.5 * camera.sensor().field + kRefracted, std::numbers::pi);
  const double cos_edge = std::cos(edge);
  const double cos_moon = moon ? std::cos(0.5 * moon->diameter) : 2.0;
  const double share = 1.0 / static_cast<double>(view.drawn.size());
  const Eigen::Vector3d axis = view.midpoint.camera_from_j2000.row(2).transpose();
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const SkyStar& star = stars[i];
    if (axis.dot(star.direction) < cos_edge) continue;
    if (moon && star.direction.dot(moon->direction) > cos_moon) continue;
    const Eigen::Vector3d aberrated = (star.direction + view.velocity_over_c).normalized();
    const Eigen::Vector3d direction = view.seen(view.midpoint, aberrated);
    Spot spot;
    spot.kind = SpotKind::kStar;
    spot.hr = star.hr;
    double kept = 0;
    const double through = view.transmission(direction);
    if (through == 0 || !camera.project(direction, spot.centre, kept) || hidden(direction, cards)) continue;
    const std::size_t first = list.points.size();
    const double factor = factors.empty() ? 1.0 : double{factors[i]};
    const double flux = camera.star_electrons(star.magnitude) * factor * share * through;
    for (const CameraTurn& turn : view.drawn)
      add_point(camera, view.seen(turn, aberrated), flux, list.points);
    list.close(spot, first);
  }
}

void add_disc(const CameraView& camera, const SkyView& view, Spot spot, const Disc& disc, double factor,
              std::span<const CardView> cards, const DiscQuadrature& quadrature, SpotList& list) {
  const Eigen::Vector3d direction = view.seen(view.midpoint, disc.direction);
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
    lit.push_back(q.weight * (disc.to_sun ? std::max(0.0, normal.dot(*disc.to_sun)) : 1));
    all += lit.back();
  }
  if (!(all > 0)) return;  // new Moon
  const double flux = factor * through * camera.star_electrons(disc.magnitude) /
                      (all * static_cast<double>(view.drawn.size()));
  const std::size_t first = list.points.size();
  for (const CameraTurn& turn : view.drawn) {
    for (std::size_t k = 0; k < rule.size(); ++k) {
      if (lit[k] == 0) continue;
      const Eigen::Vector3d limb =
          (disc.direction + std::tan(radius) * basis * rule[k].position).normalized();
      add_point(camera, view.seen(turn, limb), flux * lit[k], list.points);
    }
  }
  list.close(spot, first);
}

void add_lamps(const CameraView& camera, const SkyView& view, std::span<const CardView> cards,
               SpotList& list) {
  const double share = 1.0 / static_cast<double>(view.drawn.size());
  for (const Lamp& lamp : view.ground->lamps) {
    const auto direction = [&](const CameraTurn& turn) -> Eigen::Vector3d {
      const Eigen::Vector3d level =
          std::cos(lamp.azimuth) * turn.north + std::sin(lamp.azimuth) * turn.north.cross(turn.up);
      return std::cos(lamp.elevation) * level + std::sin(lamp.elevation) * turn.up;
    };
    if (hidden(direction(view.midpoint), cards)) continue;
    for (const CameraTurn& turn : view.drawn)
      add_point(camera, direction(turn), share * camera.star_electrons(lamp.magnitude), list.points);
  }
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
