#include "sim/camera_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/exposure.hpp"
#include "sim/star_colour.hpp"
#include "sim/stray_light.hpp"

namespace omma::sim {

CameraRenderer::CameraRenderer(const Scenario& scenario, std::span<const SkyStar> stars,
                               const CameraView& view, int index)
    : scenario_(scenario),
      stars_(stars),
      view_(view),
      index_(index),
      colours_(view.sensor().response),
      electrons_(view.base()) {
  if (view.sensor().response.empty()) return;
  for (const SkyStar& star : stars)
    star_factors_.push_back(static_cast<float>(colours_(star_colour(star.hr))));
}

CameraTurn CameraRenderer::turn_of(const SceneInstant& instant) const {
  const Eigen::Quaterniond camera_from_rig = view_.camera().rig_from_camera.rotation.conjugate();
  return {(camera_from_rig * instant.rig_from_j2000).toRotationMatrix(), camera_from_rig * instant.up_rig,
          camera_from_rig * instant.north_rig};
}

// A body beside the rig is in the Earth's shadow when the rig is.
std::optional<Sunlight> CameraRenderer::sunlight(const SkyScene& sky, const SkyView& view) const {
  if (!sky.sun) return std::nullopt;
  const Eigen::Vector3d to_sun = view.seen(view.midpoint, sky.sun->direction);
  const double flux = std::pow(10.0, -0.4 * sky.sun->magnitude) * view.transmission(to_sun);
  if (flux <= 0) return std::nullopt;
  return Sunlight{to_sun, flux * colours_(sky.sun->colour)};
}

void CameraRenderer::draw(std::uint64_t frame) {
  frame_ = frame;
  const SceneInstant midpoint = scene_at(scenario_, scenario_.time_of(frame));
  const SkyScene sky = sky_scene_at(scenario_, scenario_.time_of(frame));
  std::vector<SceneInstant> drawn;
  drawn.reserve(static_cast<std::size_t>(view_.sensor().blur_samples));
  for (int k = 0; k < view_.sensor().blur_samples; ++k)
    drawn.push_back(scene_at(scenario_, exposure_instant(view_.sensor(), scenario_.time_of(frame), k)));

  SkyView view;
  view.midpoint = turn_of(midpoint);
  for (const SceneInstant& instant : drawn) view.drawn.push_back(turn_of(instant));
  if (scenario_.ground) view.ground = &*scenario_.ground;
  view.velocity_over_c = sky.velocity_over_c;
  std::optional<EarthView> earth;
  if (sky.earth) view.earth = &earth.emplace(view_, *sky.earth, view.midpoint.camera_from_j2000);

  const std::optional<Sunlight> sunlight = this->sunlight(sky, view);
  std::vector<CardView> cards;
  for (std::size_t c = 0; c < scenario_.cards.size(); ++c)
    cards.emplace_back(view_, scenario_.cards[c], midpoint.rig_from_body[c], sunlight);

  electrons_ = view_.base();
  add_background(sky, view);
  std::vector<std::size_t> far_to_near(cards.size());
  std::iota(far_to_near.begin(), far_to_near.end(), std::size_t{0});
  std::stable_sort(far_to_near.begin(), far_to_near.end(),
                   [&](std::size_t a, std::size_t b) { return cards[a].distance() > cards[b].distance(); });
  for (const std::size_t c : far_to_near) cards[c].paint(cards, electrons_);

  list_.clear();
  add_sky(sky, view, cards);
  add_cards(drawn, sunlight, cards);
  for (const PointSource& point : list_.points) {
    view_.point_spread().add(point, view_.width(), view_.height(), electrons_.data());
  }
  for (const Spot& spot : list_.spots) {
    if (spot.kind == SpotKind::kMoon || spot.kind == SpotKind::kSun)
      add_glare(view_, spot, list_, electrons_);
  }
  add_stray_light(sky, view, cards);
  // A dark disc is light taken away, and rounding may take a trace too much.
  for (float& value : electrons_) value = std::max(value, 0.0F);
  bloom(view_.sensor(), view_.width(), view_.height(), electrons_);
}

void CameraRenderer::add_background(const SkyScene& sky, const SkyView& view) {
  if (view.earth != nullptr) view.earth->paint(electrons_);
  if (!scenario_.ground || !scenario_.ground->glow) return;
  GlowView glow;
  glow.up = view.midpoint.up;
  glow.north = view.midpoint.north;
  if (sky.moon) {
    glow.moon = view.seen(view.midpoint, sky.moon->direction);
    if (sky.moon->to_sun)
      glow.moon_phase = std::acos(std::clamp(-sky.moon->direction.dot(*sky.moon->to_sun), -1.0, 1.0));
  }
  glow_.add(view_, *scenario_.ground, glow, electrons_);
}

void CameraRenderer::add_sky(const SkyScene& sky, const SkyView& view, std::span<const CardView> cards) {
  add_stars(view_, view, stars_, star_factors_, sky.moon, cards, list_);
  const auto add = [&](SpotKind kind, const Disc& disc, SolarBody planet) {
    Spot spot;
    spot.kind = kind;
    spot.planet = planet;
    add_disc(view_, view, spot, disc, colours_(disc.colour), cards, quadrature_, list_);
  };
  for (const PlanetDisc& planet : sky.planets) {
    if (planet.disc.magnitude <= scenario_.faintest) add(SpotKind::kPlanet, planet.disc, planet.body);
  }
  if (sky.moon) add(SpotKind::kMoon, *sky.moon, SolarBody::kMoon);
  if (sky.sun) add(SpotKind::kSun, *sky.sun, SolarBody::kSun);
  if (view.ground != nullptr) add_lamps(view_, view, cards, list_);
}

// A card before the Sun keeps the lens in the shade.
void CameraRenderer::add_stray_light(const SkyScene& sky, const SkyView& view,
                                     std::span<const CardView> cards) {
  const auto hidden = [&](const Eigen::Vector3d& direction) {
    return std::any_of(cards.begin(), cards.end(),
                       [&](const CardView& card) { return card.hides(direction); });
  };
  if (view.earth != nullptr && view_.sensor().veil > 0) {
    const EarthView::Light light = view.earth->light();
    if (!hidden(light.direction))
      add_veil(view_, light.direction, light.flux * view_.star_electrons(0), electrons_);
  }
  if (!sky.sun) return;
  const Eigen::Vector3d sun = view.seen(view.midpoint, sky.sun->direction);
  if (hidden(sun)) return;
  const double flux =
      view_.star_electrons(sky.sun->magnitude) * colours_(sky.sun->colour) * view.transmission(sun);
  if (flux <= 0) return;
  add_veil(view_, sun, flux, electrons_);
  Eigen::Vector2d image;
  double kept = 0;
  if (view_.project(sun, image, kept)) add_ghosts(view_, image, flux * kept, electrons_);
}

void CameraRenderer::add_cards(std::span<const SceneInstant> drawn, const std::optional<Sunlight>& sunlight,
                               std::span<const CardView> cards) {
  const double share = 1.0 / static_cast<double>(drawn.size());
  for (std::size_t c = 0; c < scenario_.cards.size(); ++c) {
    std::vector<CardView> moved;
    for (const SceneInstant& instant : drawn)
      moved.emplace_back(view_, scenario_.cards[c], instant.rig_from_body[c], sunlight);
    for (std::size_t t = 0; t < scenario_.cards[c].body.targets.size(); ++t) {
      if (!scenario_.cards[c].body.targets[t].code.lit(frame_)) continue;  // it blinks, and is dark
      Spot spot;
      spot.kind = SpotKind::kTarget;
      spot.card = static_cast<std::uint16_t>(c);
      spot.target = static_cast<std::uint16_t>(t);
      Eigen::Vector3d direction;
      double distance = 0;
      if (!cards[c].disc_centre(t, spot.centre, direction, distance)) continue;
      bool hidden = false;
      for (std::size_t other = 0; other < cards.size(); ++other) {
        hidden = hidden || (other != c && cards[other].hides(direction, distance));
      }
      if (hidden) continue;
      const std::size_t first = list_.points.size();
      for (const CardView& card : moved) card.add_disc(t, share, quadrature_, cards, list_.points);
      list_.close(spot, first);
    }
  }
}

void CameraRenderer::truth(std::vector<SpotTruth>& out) {
  out.clear();
  for (const Spot& spot : list_.spots) {
    const SpotTruth truth = truth_of(view_, spot, list_, electrons_, patch_);
    // Moon and Sun are told however little their saturated discs say about themselves.
    if (truth.snr >= scenario_.truth_minimum_snr || spot.kind == SpotKind::kMoon ||
        spot.kind == SpotKind::kSun)
      out.push_back(truth);
  }
}

void CameraRenderer::read_out(std::span<std::uint8_t> grey) const {
  const RandomSequence sequence(scenario_.seed, static_cast<std::uint64_t>(index_), frame_);
  sim::read_out<std::uint8_t>(view_.sensor(), electrons_, view_.offsets(), sequence, 0, grey);
}

void CameraRenderer::read_out(std::span<std::uint16_t> grey) const {
  const RandomSequence sequence(scenario_.seed, static_cast<std::uint64_t>(index_), frame_);
  sim::read_out<std::uint16_t>(view_.sensor(), electrons_, view_.offsets(), sequence, 0, grey);
}

}  // namespace omma::sim
