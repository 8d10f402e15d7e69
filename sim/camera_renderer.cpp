#include "sim/camera_renderer.hpp"

#include <algorithm>
#include <numeric>

#include "sim/stray_light.hpp"

namespace omma::sim {

CameraRenderer::CameraRenderer(const Scenario& scenario, std::span<const SkyStar> stars,
                               const CameraView& view, int index)
    : scenario_(scenario), stars_(stars), view_(view), index_(index), electrons_(view.base()) {}

// The instants drawn lie evenly about the midpoint.
double CameraRenderer::drawn_time(std::uint64_t frame, int sample) const {
  const Sensor& sensor = view_.sensor();
  return scenario_.time_of(frame) + sensor.exposure * ((sample + 0.5) / sensor.blur_samples - 0.5);
}

Eigen::Matrix3d CameraRenderer::camera_from_j2000(const SceneInstant& instant) const {
  return (view_.camera().rig_from_camera.rotation.conjugate() * instant.rig_from_j2000).toRotationMatrix();
}

void CameraRenderer::draw(std::uint64_t frame) {
  frame_ = frame;
  const SceneInstant midpoint = scene_at(scenario_, scenario_.time_of(frame));
  std::vector<SceneInstant> drawn;
  drawn.reserve(static_cast<std::size_t>(view_.sensor().blur_samples));
  for (int k = 0; k < view_.sensor().blur_samples; ++k)
    drawn.push_back(scene_at(scenario_, drawn_time(frame, k)));
  std::vector<CardView> cards;
  for (std::size_t c = 0; c < scenario_.cards.size(); ++c) {
    cards.emplace_back(view_, scenario_.cards[c], midpoint.rig_from_body[c]);
  }

  electrons_ = view_.base();
  std::vector<std::size_t> far_to_near(cards.size());
  std::iota(far_to_near.begin(), far_to_near.end(), std::size_t{0});
  std::stable_sort(far_to_near.begin(), far_to_near.end(),
                   [&](std::size_t a, std::size_t b) { return cards[a].distance() > cards[b].distance(); });
  for (const std::size_t c : far_to_near) cards[c].paint_plate(electrons_);

  list_.clear();
  add_sky(midpoint, drawn, cards);
  add_cards(drawn, cards);
  for (const PointSource& point : list_.points) {
    view_.point_spread().add(point, view_.width(), view_.height(), electrons_.data());
  }
  for (const Spot& spot : list_.spots) {
    if (spot.kind == SpotKind::kMoon || spot.kind == SpotKind::kSun)
      add_glare(view_, spot, list_, electrons_);
  }
  if (scenario_.sun) add_stray_sunlight(camera_from_j2000(midpoint) * scenario_.sun->direction, cards);
  // A dark disc is light taken away, and rounding may take a trace too much.
  for (float& value : electrons_) value = std::max(value, 0.0F);
  bloom(view_.sensor(), view_.width(), view_.height(), electrons_);
}

void CameraRenderer::add_sky(const SceneInstant& midpoint, std::span<const SceneInstant> drawn,
                             std::span<const CardView> cards) {
  SkyView sky;
  sky.camera_from_j2000 = camera_from_j2000(midpoint);
  for (const SceneInstant& instant : drawn) sky.drawn.push_back(camera_from_j2000(instant));
  if (scenario_.ground) {
    sky.ground = scenario_.ground;
    sky.ground->up = view_.camera().rig_from_camera.rotation.conjugate() * scenario_.ground->up;
  }
  add_stars(view_, sky, stars_, scenario_.moon, cards, list_);
  const Eigen::Vector3d* lit_by = scenario_.sun ? &scenario_.sun->direction : nullptr;
  if (scenario_.moon)
    add_disc(view_, sky, SpotKind::kMoon, *scenario_.moon, lit_by, cards, quadrature_, list_);
  if (scenario_.sun) add_disc(view_, sky, SpotKind::kSun, *scenario_.sun, nullptr, cards, quadrature_, list_);
}

// A card before the Sun keeps the lens in the shade.
void CameraRenderer::add_stray_sunlight(const Eigen::Vector3d& sun, std::span<const CardView> cards) {
  if (std::any_of(cards.begin(), cards.end(), [&](const CardView& card) { return card.hides(sun); })) return;
  double flux = view_.star_electrons(scenario_.sun->magnitude);
  if (scenario_.ground) {
    const Eigen::Vector3d up = view_.camera().rig_from_camera.rotation.conjugate() * scenario_.ground->up;
    flux *= scenario_.ground->transmission(up.dot(sun));
  }
  if (flux <= 0) return;
  add_veil(view_, sun, flux, electrons_);
  Eigen::Vector2d image;
  double kept = 0;
  if (view_.project(sun, image, kept)) add_ghosts(view_, image, flux * kept, electrons_);
}

void CameraRenderer::add_cards(std::span<const SceneInstant> drawn, std::span<const CardView> cards) {
  const double share = 1.0 / static_cast<double>(drawn.size());
  for (std::size_t c = 0; c < cards.size(); ++c) {
    std::vector<CardView> moved;
    for (const SceneInstant& instant : drawn) {
      moved.emplace_back(view_, scenario_.cards[c], instant.rig_from_body[c]);
    }
    for (std::size_t t = 0; t < scenario_.cards[c].body.targets.size(); ++t) {
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
      for (const CardView& card : moved) card.add_disc(t, share, quadrature_, list_.points);
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
