#include "sim/card_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {
namespace {

constexpr int kEdgeSamples = 24;  // along each side of the plate, to find its place in the image
constexpr int kSubPixels = 4;     // per axis, in pixels that the plate's edge crosses

// Convolves a width × height image in place with a sampled Gaussian, one axis after the other.
void soften(std::vector<float>& image, int width, int height, double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  std::vector<float> kernel(static_cast<std::size_t>(radius) + 1);
  float sum = 0;
  for (int i = 0; i <= radius; ++i) {
    kernel[static_cast<std::size_t>(i)] = static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += (i == 0 ? 1.0F : 2.0F) * kernel[static_cast<std::size_t>(i)];
  }
  std::vector<float> line(static_cast<std::size_t>(std::max(width, height)));
  auto filter = [&](float* first, int count, std::ptrdiff_t step) {
    for (int i = 0; i < count; ++i) line[static_cast<std::size_t>(i)] = first[i * step] / sum;
    for (int i = 0; i < count; ++i) {
      float value = 0;
      for (int k = -radius; k <= radius; ++k) {
        const int j = std::clamp(i + k, 0, count - 1);
        value += kernel[static_cast<std::size_t>(std::abs(k))] * line[static_cast<std::size_t>(j)];
      }
      first[i * step] = value;
    }
  };
  for (int v = 0; v < height; ++v) filter(image.data() + static_cast<std::ptrdiff_t>(v) * width, width, 1);
  for (int u = 0; u < width; ++u) filter(image.data() + u, height, width);
}

}  // namespace

CardView::CardView(const CameraView& camera, const Card& card, const Pose& rig_from_body)
    : camera_(camera),
      card_(card),
      camera_from_body_(camera.camera().rig_from_camera.inverse() * rig_from_body),
      eye_(camera_from_body_.inverse().translation),
      body_from_camera_(camera_from_body_.rotation.conjugate().toRotationMatrix().cast<float>()) {}

bool CardView::hides(const Eigen::Vector3d& direction, double distance) const {
  const Eigen::Vector3d ray = camera_from_body_.rotation.conjugate() * direction;
  const double range = -eye_.z() / ray.z();
  if (!(range > 0) || range >= distance) return false;
  const Eigen::Vector3d hit = eye_ + range * ray;
  return std::abs(hit.x()) < 0.5 * card_.width && std::abs(hit.y()) < 0.5 * card_.height;
}

bool CardView::on_plate(const Eigen::Vector3f& ray_camera) const {
  const Eigen::Vector3f ray = body_from_camera_ * ray_camera;
  const Eigen::Vector3f eye = eye_.cast<float>();
  const float range = -eye.z() / ray.z();  // a ray of zeros, where the lens has none, gives NaN: not on it
  if (!(range > 0)) return false;
  return std::abs(eye.x() + range * ray.x()) < 0.5F * static_cast<float>(card_.width) &&
         std::abs(eye.y() + range * ray.y()) < 0.5F * static_cast<float>(card_.height);
}

// The part of the image that holds the plate. Where its outline leaves the field, all of the image.
bool CardView::plate_box(Box& box) const {
  const double half_diagonal = 0.5 * std::hypot(card_.width, card_.height);
  const double centre_angle =
      std::acos(std::clamp(camera_from_body_.translation.z() / distance(), -1.0, 1.0));
  const double reach = distance() > half_diagonal ? std::asin(half_diagonal / distance()) : std::numbers::pi;
  if (centre_angle - reach > 0.5 * camera_.sensor().field) return false;

  Eigen::Vector2d low(camera_.width(), camera_.height());
  Eigen::Vector2d high(0, 0);
  for (int i = 0; i < 4 * kEdgeSamples; ++i) {
    const double along = (i % kEdgeSamples) / static_cast<double>(kEdgeSamples) - 0.5;
    const int side = i / kEdgeSamples;
    Eigen::Vector2d corner = side == 0 ? Eigen::Vector2d(along, -0.5) : Eigen::Vector2d(0.5, along);
    if (side >= 2) corner = side == 2 ? Eigen::Vector2d(-along, 0.5) : Eigen::Vector2d(-0.5, -along);
    const Eigen::Vector3d point =
        camera_from_body_ * Eigen::Vector3d(corner.x() * card_.width, corner.y() * card_.height, 0);
    Eigen::Vector2d pixel;
    double kept = 0;
    if (!camera_.project(point.normalized(), pixel, kept)) {
      box = {0, 0, camera_.width(), camera_.height()};
      return true;
    }
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const int margin = camera_.point_spread().radius() + 1;
  box = {std::max(0, static_cast<int>(low.x()) - margin), std::max(0, static_cast<int>(low.y()) - margin),
         std::min(camera_.width(), static_cast<int>(high.x()) + margin + 2),
         std::min(camera_.height(), static_cast<int>(high.y()) + margin + 2)};
  return box.u0 < box.u1 && box.v0 < box.v1;
}

// Rays inside a pixel by bilinear interpolation between its corners': the lens bends far less than that over
// one pixel.
float CardView::coverage_of_pixel(const Eigen::Vector3f* upper, const Eigen::Vector3f* lower) const {
  int inside = 0;
  for (int j = 0; j < kSubPixels; ++j) {
    const float y = (static_cast<float>(j) + 0.5F) / kSubPixels;
    const Eigen::Vector3f left = (1 - y) * upper[0] + y * lower[0];
    const Eigen::Vector3f right = (1 - y) * upper[1] + y * lower[1];
    for (int i = 0; i < kSubPixels; ++i) {
      const float x = (static_cast<float>(i) + 0.5F) / kSubPixels;
      inside += on_plate((1 - x) * left + x * right) ? 1 : 0;
    }
  }
  return static_cast<float>(inside) / (kSubPixels * kSubPixels);
}

std::vector<float> CardView::coverage(const Box& box) const {
  const int columns = box.u1 - box.u0;
  const int rows = box.v1 - box.v0;
  const auto& rays = camera_.corner_rays();
  const std::ptrdiff_t pitch = camera_.width() + 1;
  std::vector<float> covered(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<char> above(static_cast<std::size_t>(columns) + 1);
  std::vector<char> below(above.size());
  for (int v = box.v0; v <= box.v1; ++v) {
    const Eigen::Vector3f* row = rays.data() + v * pitch + box.u0;
    for (int i = 0; i <= columns; ++i) below[static_cast<std::size_t>(i)] = on_plate(row[i]) ? 1 : 0;
    if (v > box.v0) {
      float* out = covered.data() + static_cast<std::ptrdiff_t>(v - 1 - box.v0) * columns;
      for (int i = 0; i < columns; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const int corners = above[k] + above[k + 1] + below[k] + below[k + 1];
        if (corners == 4) out[i] = 1;
        if (corners > 0 && corners < 4) out[i] = coverage_of_pixel(row - pitch + i, row + i);
      }
    }
    above.swap(below);
  }
  return covered;
}

void CardView::paint_plate(std::vector<float>& electrons) const {
  Box box;
  if (!plate_box(box)) return;
  const int columns = box.u1 - box.u0;
  std::vector<float> covered = coverage(box);
  soften(covered, columns, box.v1 - box.v0, camera_.point_spread().sigma());
  const auto surface = static_cast<float>(camera_.surface_electrons(card_.plate_magnitude));
  for (int v = box.v0; v < box.v1; ++v) {
    const float* share = covered.data() + static_cast<std::ptrdiff_t>(v - box.v0) * columns;
    for (int u = box.u0; u < box.u1; ++u) {
      const auto at = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width()) +
                      static_cast<std::size_t>(u);
      const float plate =
          camera_.dark()[at] + surface * camera_.solid_angles()[at] * camera_.transmissions()[at];
      const float c = share[u - box.u0];
      electrons[at] = (1 - c) * electrons[at] + c * plate;
    }
  }
}

bool CardView::faces_camera(std::size_t target) const {
  return eye_.z() > card_.body.targets[target].position.z() && eye_.z() > 0;
}

bool CardView::disc_centre(std::size_t target, Eigen::Vector2d& pixel, Eigen::Vector3d& direction,
                           double& distance) const {
  if (!faces_camera(target)) return false;
  const Eigen::Vector3d point = camera_from_body_ * card_.body.targets[target].position;
  distance = point.norm();
  direction = point / distance;
  double kept = 0;
  return camera_.project(direction, pixel, kept);
}

// The flux of a point is the surface's light times the solid angle dA cos γ / d² that its share of the disc
// fills.
void CardView::add_disc(std::size_t target, double share, const DiscQuadrature& quadrature,
                        std::vector<PointSource>& points) const {
  if (!faces_camera(target)) return;
  const double radius = 0.5 * card_.disc_diameter;
  const Eigen::Vector3d centre = card_.body.targets[target].position;
  const double radius_px = radius / (eye_ - centre).norm() / camera_.camera().lens.pixel_angle();
  const double light =
      camera_.surface_electrons(card_.disc_magnitude) - camera_.surface_electrons(card_.plate_magnitude);
  const double area = std::numbers::pi * radius * radius;
  for (const QuadraturePoint& q : quadrature.rule(radius_px / camera_.point_spread().sigma())) {
    const Eigen::Vector3d on_card = centre + radius * Eigen::Vector3d(q.position.x(), q.position.y(), 0);
    const Eigen::Vector3d point = camera_from_body_ * on_card;
    const double distance = point.norm();
    Eigen::Vector2d pixel;
    double kept = 0;
    if (!camera_.project(point / distance, pixel, kept)) continue;
    const double cosine = (eye_.z() - centre.z()) / distance;
    const double solid_angle = q.weight * area * cosine / (distance * distance);
    points.push_back({static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                      static_cast<float>(share * light * solid_angle * kept)});
  }
}

}  // namespace omma::sim
