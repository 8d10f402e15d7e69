#include "sim/card_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace omma::sim {

CardView::CardView(const CameraView& camera, const Card& card, const Pose& rig_from_body,
                   const std::optional<Sunlight>& sunlight)
    : camera_(camera),
      card_(card),
      camera_from_body_(camera.camera().rig_from_camera.inverse() * rig_from_body),
      sunlight_(sunlight) {
  faces_.reserve(card.faces.size());
  for (const Face& face : card.faces)
    faces_.emplace_back(camera, face, camera_from_body_ * face.body_from_face);
}

bool CardView::hides(const Eigen::Vector3d& direction, double distance) const {
  return std::any_of(faces_.begin(), faces_.end(),
                     [&](const PlateView& face) { return face.hides(direction, distance); });
}

// Of a surface in the Sun, which does not see the camera's side of it from behind; and what light there is in
// the shade.
FaceLight CardView::printed_light(const PlateView& face, double albedo) const {
  FaceLight light;
  light.lit = light.shaded = albedo * camera_.surface_electrons(card_.printed->ambient);
  if (!sunlight_) return light;
  light.to_sun = sunlight_->to_sun;
  const double seen_side = face.eye().z() < 0 ? -1 : 1;
  const double cosine = seen_side * (face.camera_from_face().rotation.conjugate() * sunlight_->to_sun).z();
  if (cosine > 0)
    light.lit += albedo * cosine / std::numbers::pi * sunlight_->flux * camera_.star_electrons(0);
  return light;
}

// Faces of this body, and of the others, that may keep the Sun from a face.
std::vector<const PlateView*> CardView::occluders(const PlateView& face,
                                                  std::span<const CardView> cards) const {
  std::vector<const PlateView*> found;
  const auto add = [&](const CardView& card) {
    for (const PlateView& other : card.faces_) {
      if (&other != &face && other.stands_before(face, sunlight_->to_sun)) found.push_back(&other);
    }
  };
  add(*this);
  for (const CardView& card : cards) {
    if (&card.card_ != &card_) add(card);
  }
  return found;
}

FaceLight CardView::plate_light(const PlateView& face, std::span<const CardView> cards) const {
  if (!card_.printed) {
    const double electrons = camera_.surface_electrons(card_.plate_magnitude);
    return {electrons, electrons, {}, {}};
  }
  FaceLight light = printed_light(face, card_.printed->plate);
  if (light.lit > light.shaded) light.occluders = occluders(face, cards);
  return light;
}

FaceLight CardView::disc_light(const PlateView& face) const {
  if (card_.printed) return printed_light(face, card_.printed->disc);
  const double electrons = camera_.surface_electrons(card_.disc_magnitude);
  return {electrons, electrons, {}, {}};
}

void CardView::paint(std::span<const CardView> cards, std::vector<float>& electrons) const {
  if (faces_.size() == 1) {
    faces_.front().paint(plate_light(faces_.front(), cards), electrons);
    return;
  }
  std::vector<std::size_t> far_to_near(faces_.size());
  std::iota(far_to_near.begin(), far_to_near.end(), std::size_t{0});
  std::stable_sort(far_to_near.begin(), far_to_near.end(),
                   [&](std::size_t a, std::size_t b) { return faces_[a].distance() > faces_[b].distance(); });
  FaceLayer layer;
  for (const std::size_t f : far_to_near) faces_[f].join(plate_light(faces_[f], cards), layer);
  for (std::size_t i = 0; i < layer.covered.size(); ++i) {
    const float dark = camera_.dark()[i];
    electrons[i] = dark + (1 - layer.covered[i]) * (electrons[i] - dark) + layer.light[i];
  }
}

Eigen::Vector3d CardView::on_face(std::size_t target) const {
  return card_.faces[card_.face_of[target]].body_from_face.inverse() * card_.body.targets[target].position;
}

bool CardView::faces_camera(std::size_t target) const {
  const Eigen::Vector3d& eye = face_of(target).eye();
  return eye.z() > on_face(target).z() && eye.z() > 0;
}

bool CardView::is_lamp(std::size_t target) const {
  return card_.led && card_.body.targets[target].type == 1;
}

bool CardView::disc_centre(std::size_t target, Eigen::Vector2d& pixel, Eigen::Vector3d& direction,
                           double& distance) const {
  if (!faces_camera(target)) return false;
  const Eigen::Vector3d point = camera_from_body_ * card_.body.targets[target].position;
  distance = point.norm();
  direction = point / distance;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (f != card_.face_of[target] && faces_[f].hides(direction, distance * (1 - 1e-9))) return false;
  }
  double kept = 0;
  return camera_.project(direction, pixel, kept);
}

// A printed disc leaves its surface's light times the solid angle dA cos γ / d² that each share of it fills;
// a lamp its brightness from 1 m, times cosᵐ γ / d².
void CardView::add_disc(std::size_t target, double share, const DiscQuadrature& quadrature,
                        std::span<const CardView> cards, std::vector<PointSource>& points) const {
  if (!faces_camera(target)) return;
  const PlateView& face = face_of(target);
  const double radius = 0.5 * card_.disc_diameter;
  const Eigen::Vector3d centre = on_face(target);
  const double radius_px = radius / (face.eye() - centre).norm() / camera_.camera().lens.pixel_angle();
  const bool lamp = is_lamp(target);
  const double area = std::numbers::pi * radius * radius;
  const FaceLight disc = disc_light(face);
  const FaceLight plate = plate_light(face, cards);
  const auto light_at = [&](const Eigen::Vector3d& point) {
    if (lamp) return camera_.star_electrons(card_.led->magnitude);
    return plate.in_shade(point) ? (disc.shaded - plate.shaded) * area : (disc.lit - plate.lit) * area;
  };
  for (const QuadraturePoint& q : quadrature.rule(radius_px / camera_.point_spread().sigma())) {
    const Eigen::Vector3d on_disc = centre + radius * Eigen::Vector3d(q.position.x(), q.position.y(), 0);
    const Eigen::Vector3d point = face.camera_from_face() * on_disc;
    const double distance = point.norm();
    Eigen::Vector2d pixel;
    double kept = 0;
    if (!camera_.project(point / distance, pixel, kept)) continue;
    const double cosine = (face.eye().z() - centre.z()) / distance;
    const double seen =
        q.weight * (lamp ? std::pow(cosine, card_.led->order) : cosine) / (distance * distance);
    points.push_back({static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                      static_cast<float>(share * light_at(point) * seen * kept)});
  }
}

}  // namespace omma::sim
