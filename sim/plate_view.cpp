#include "sim/plate_view.hpp"

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

PlateView::PlateView(const CameraView& camera, const Face& face, const Pose& camera_from_face)
    : camera_(camera),
      width_(face.width),
      height_(face.height),
      camera_from_face_(camera_from_face),
      eye_(camera_from_face_.inverse().translation),
      face_from_camera_(camera_from_face_.rotation.conjugate().toRotationMatrix().cast<float>()) {}

bool PlateView::hides(const Eigen::Vector3d& direction, double distance) const {
  const Eigen::Vector3d ray = camera_from_face_.rotation.conjugate() * direction;
  const double range = -eye_.z() / ray.z();
  if (!(range > 0) || range >= distance) return false;
  const Eigen::Vector3d hit = eye_ + range * ray;
  return std::abs(hit.x()) < 0.5 * width_ && std::abs(hit.y()) < 0.5 * height_;
}

bool PlateView::shades(const Eigen::Vector3d& point, const Eigen::Vector3d& to_sun) const {
  constexpr double kApart = 1e-6;  // [m]: a point of the face itself
  const Eigen::Vector3d from = camera_from_face_.inverse() * point;
  const Eigen::Vector3d ray = camera_from_face_.rotation.conjugate() * to_sun;
  const double range = -from.z() / ray.z();
  if (!(range > kApart) || !std::isfinite(range)) return false;
  const Eigen::Vector3d hit = from + range * ray;
  return std::abs(hit.x()) < 0.5 * width_ && std::abs(hit.y()) < 0.5 * height_;
}

bool PlateView::stands_before(const PlateView& other, const Eigen::Vector3d& to_sun) const {
  constexpr double kAbove = 1e-6;  // [m]
  const double side = (other.camera_from_face_.rotation.conjugate() * to_sun).z() < 0 ? -1 : 1;
  const Pose other_from_face = other.camera_from_face_.inverse() * camera_from_face_;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector3d at(corner % 2 == 0 ? -0.5 * width_ : 0.5 * width_,
                             corner / 2 == 0 ? -0.5 * height_ : 0.5 * height_, 0);
    if (side * (other_from_face * at).z() > kAbove) return true;
  }
  return false;
}

bool FaceLight::in_shade(const Eigen::Vector3d& point) const {
  return std::any_of(occluders.begin(), occluders.end(),
                     [&](const PlateView* face) { return face->shades(point, to_sun); });
}

bool PlateView::covers_in_shade(const Eigen::Vector3f& ray_camera, const FaceLight& light) const {
  if (!covers(ray_camera)) return false;
  const Eigen::Vector3d ray = camera_from_face_.rotation.conjugate() * ray_camera.cast<double>();
  Eigen::Vector3d point = eye_ - eye_.z() / ray.z() * ray;
  point.z() = 0;
  return light.in_shade(camera_from_face_ * point);
}

bool PlateView::covers(const Eigen::Vector3f& ray_camera) const {
  const Eigen::Vector3f ray = face_from_camera_ * ray_camera;
  const Eigen::Vector3f eye = eye_.cast<float>();
  const float range = -eye.z() / ray.z();  // a ray of zeros, where the lens has none, gives NaN: not on it
  if (!(range > 0)) return false;
  return std::abs(eye.x() + range * ray.x()) < 0.5F * static_cast<float>(width_) &&
         std::abs(eye.y() + range * ray.y()) < 0.5F * static_cast<float>(height_);
}

// The part of the image that holds the plate. Where its outline leaves the field, all of the image.
bool PlateView::find_box(Box& box) const {
  const double half_diagonal = 0.5 * std::hypot(width_, height_);
  const double centre_angle =
      std::acos(std::clamp(camera_from_face_.translation.z() / distance(), -1.0, 1.0));
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
        camera_from_face_ * Eigen::Vector3d(corner.x() * width_, corner.y() * height_, 0);
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
template <class Is>
float PlateView::coverage_of_pixel(const Eigen::Vector3f* upper, const Eigen::Vector3f* lower, const Is& is) {
  int inside = 0;
  for (int j = 0; j < kSubPixels; ++j) {
    const float y = (static_cast<float>(j) + 0.5F) / kSubPixels;
    const Eigen::Vector3f left = (1 - y) * upper[0] + y * lower[0];
    const Eigen::Vector3f right = (1 - y) * upper[1] + y * lower[1];
    for (int i = 0; i < kSubPixels; ++i) {
      const float x = (static_cast<float>(i) + 0.5F) / kSubPixels;
      inside += is((1 - x) * left + x * right) ? 1 : 0;
    }
  }
  return static_cast<float>(inside) / (kSubPixels * kSubPixels);
}

template <class Is>
std::vector<float> PlateView::coverage(const Box& box, const Is& is) const {
  const int columns = box.u1 - box.u0;
  const int rows = box.v1 - box.v0;
  const auto& rays = camera_.corner_rays();
  const std::ptrdiff_t pitch = camera_.width() + 1;
  std::vector<float> covered(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<char> above(static_cast<std::size_t>(columns) + 1);
  std::vector<char> below(above.size());
  for (int v = box.v0; v <= box.v1; ++v) {
    const Eigen::Vector3f* row = rays.data() + v * pitch + box.u0;
    for (int i = 0; i <= columns; ++i) below[static_cast<std::size_t>(i)] = is(row[i]) ? 1 : 0;
    if (v > box.v0) {
      float* out = covered.data() + static_cast<std::ptrdiff_t>(v - 1 - box.v0) * columns;
      for (int i = 0; i < columns; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const int corners = above[k] + above[k + 1] + below[k] + below[k + 1];
        if (corners == 4) out[i] = 1;
        if (corners > 0 && corners < 4) out[i] = coverage_of_pixel(row - pitch + i, row + i, is);
      }
    }
    above.swap(below);
  }
  return covered;
}

// A face that leaves the field has all of the image for its box: what it does not cover is cut off, but for
// what the softened edge needs.
bool PlateView::tighten(Box& box, std::vector<float>& covered) const {
  const int columns = box.u1 - box.u0;
  Box tight{box.u1, box.v1, box.u0, box.v0};
  std::size_t at = 0;
  for (int v = box.v0; v < box.v1; ++v) {
    for (int u = box.u0; u < box.u1; ++u, ++at) {
      if (covered[at] == 0) continue;
      tight = {std::min(tight.u0, u), std::min(tight.v0, v), std::max(tight.u1, u + 1), v + 1};
    }
  }
  if (tight.u0 >= tight.u1) return false;
  const int margin = camera_.point_spread().radius() + 1;
  tight = {std::max(box.u0, tight.u0 - margin), std::max(box.v0, tight.v0 - margin),
           std::min(box.u1, tight.u1 + margin), std::min(box.v1, tight.v1 + margin)};
  std::vector<float> kept;
  kept.reserve(static_cast<std::size_t>(tight.u1 - tight.u0) * static_cast<std::size_t>(tight.v1 - tight.v0));
  for (int v = tight.v0; v < tight.v1; ++v) {
    const auto row = covered.begin() + static_cast<std::ptrdiff_t>(v - box.v0) * columns;
    kept.insert(kept.end(), row + (tight.u0 - box.u0), row + (tight.u1 - box.u0));
  }
  covered = std::move(kept);
  box = tight;
  return true;
}

template <class Lay>
void PlateView::lay(const FaceLight& face_light, const Lay& one_pixel) const {
  Box box;
  if (!find_box(box)) return;
  std::vector<float> covered = coverage(box, [&](const auto& ray) { return covers(ray); });
  if (!tighten(box, covered)) return;
  const int columns = box.u1 - box.u0;
  const double sigma = camera_.point_spread().sigma();
  std::vector<float> shaded;
  if (!face_light.occluders.empty()) {
    shaded = coverage(box, [&](const auto& ray) { return covers_in_shade(ray, face_light); });
    soften(shaded, columns, box.v1 - box.v0, sigma);
  }
  soften(covered, columns, box.v1 - box.v0, sigma);
  const auto lit = static_cast<float>(face_light.lit);
  const auto loss = static_cast<float>(face_light.lit - face_light.shaded);
  const auto surface_of = [&](std::size_t i) {
    if (shaded.empty() || !(covered[i] > 0)) return lit;
    return lit - loss * std::min(1.0F, shaded[i] / covered[i]);
  };
  for (int v = box.v0; v < box.v1; ++v) {
    const std::size_t row = static_cast<std::size_t>(v - box.v0) * static_cast<std::size_t>(columns);
    for (int u = box.u0; u < box.u1; ++u) {
      const std::size_t i = row + static_cast<std::size_t>(u - box.u0);
      const auto at = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width()) +
                      static_cast<std::size_t>(u);
      one_pixel(at, covered[i], surface_of(i) * camera_.solid_angles()[at] * camera_.transmissions()[at]);
    }
  }
}

void PlateView::paint(const FaceLight& face_light, std::vector<float>& electrons) const {
  lay(face_light, [&](std::size_t at, float share, float light) {
    electrons[at] = (1 - share) * electrons[at] + share * (camera_.dark()[at] + light);
  });
}

void PlateView::join(const FaceLight& face_light, FaceLayer& layer) const {
  lay(face_light, [&](std::size_t at, float share, float light) {
    if (layer.covered.empty()) {
      layer.covered.resize(camera_.transmissions().size());
      layer.light.resize(camera_.transmissions().size());
    }
    float& covered = layer.covered[at];
    const float behind = covered > 0 ? std::min(1.0F, (1 - share) / covered) : 0.0F;
    layer.light[at] = behind * layer.light[at] + share * light;
    covered = std::min(1.0F, covered + share);
  });
}

}  // namespace omma::sim
