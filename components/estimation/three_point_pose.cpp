#include "components/estimation/three_point_pose.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omma {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Squared sides of the triangle 12, 13, 23, and −2 cos of the angles between the rays: the equations are
/// lᵢ² + lⱼ² + bᵢⱼ lᵢ lⱼ = aᵢⱼ for the distances l along the rays.
struct Triangle {
  double a12, a13, a23;
  double b12, b13, b23;
};

/// Real roots of x² + b x + c, without cancellation; false where there are none.
bool quadratic_roots(double b, double c, double& r1, double& r2) noexcept {
  const double discriminant = b * b - 4 * c;
  if (!(discriminant >= 0)) return false;
  const double y = std::sqrt(discriminant);
  if (b < 0) {
    r1 = 0.5 * (-b + y);
    r2 = r1 != 0 ? c / r1 : 0;
  } else {
    r2 = 0.5 * (-b - y);
    r1 = r2 != 0 ? c / r2 : 0;
  }
  return true;
}

/// One real root of x³ + b x² + c x + d: Newton from a point past the outer stationary point, where it
/// converges monotonically.
double cubic_root(double b, double c, double d) noexcept {
  double x = -b / 3;
  if (b * b >= 3 * c) {
    const double v = std::sqrt(b * b - 3 * c);
    const double t1 = (-b - v) / 3;
    const double k1 = ((t1 + b) * t1 + c) * t1 + d;
    if (k1 > 0) {
      x = t1 - std::sqrt(k1 / std::max(v, 1e-300));
    } else {
      const double t2 = (-b + v) / 3;
      const double k2 = ((t2 + b) * t2 + c) * t2 + d;
      x = t2 + std::sqrt(std::max(0.0, -k2) / std::max(v, 1e-300));
    }
  } else if (std::abs((3 * x + 2 * b) * x + c) < 1e-4) {
    x += 1;
  }
  for (int i = 0; i < 50; ++i) {
    const double value = ((x + b) * x + c) * x + d;
    const double slope = (3 * x + 2 * b) * x + c;
    if (slope == 0) break;
    const double step = value / slope;
    x -= step;
    if (!(std::abs(step) > 1e-14 * (1 + std::abs(x)))) break;
  }
  return x;
}

/// Eigenvector of the symmetric, singular matrix `m` for its eigenvalue `e` ≠ 0 (Persson & Nordberg, alg. 2).
Vector3d eigenvector(const Matrix3d& m, double e) noexcept {
  const double scale = 1.0 / (e * (m(0, 0) + m(1, 1)) - m(0, 0) * m(1, 1) - e * e + m(0, 1) * m(0, 1));
  const double a1 = -(e * m(0, 2) + m(0, 1) * m(1, 2) - m(0, 2) * m(1, 1)) * scale;
  const double a2 = -(e * m(1, 2) + m(0, 1) * m(0, 2) - m(0, 0) * m(1, 2)) * scale;
  return Vector3d(a1, a2, 1).normalized();
}

/// The conic of the pencil that is a pair of planes (Persson & Nordberg, eq. 10 to 13).
Matrix3d degenerate_conic(const Triangle& t) noexcept {
  const double c31 = -0.5 * t.b13, c23 = -0.5 * t.b23, c12 = -0.5 * t.b12;
  const double blob = c12 * c23 * c31 - 1;
  const double s31 = 1 - c31 * c31, s23 = 1 - c23 * c23, s12 = 1 - c12 * c12;
  const double p3 = t.a13 * (t.a23 * s31 - t.a13 * s23);
  const double p2 =
      2 * blob * t.a23 * t.a13 + t.a13 * (2 * t.a12 + t.a13) * s23 + t.a23 * (t.a23 - t.a12) * s31;
  const double p1 =
      t.a23 * (t.a13 - t.a23) * s12 - t.a12 * t.a12 * s23 - 2 * t.a12 * (blob * t.a23 + t.a13 * s23);
  const double p0 = t.a12 * (t.a12 * s23 - t.a23 * s12);
  const double g = std::abs(p3) >= std::abs(p0) ? cubic_root(p2 / p3, p1 / p3, p0 / p3)
                                                : 1.0 / cubic_root(p1 / p0, p2 / p0, p3 / p0);
  Matrix3d m;
  m(0, 0) = t.a23 * (1 - g);
  m(0, 1) = m(1, 0) = 0.5 * t.a23 * t.b12;
  m(0, 2) = m(2, 0) = -0.5 * t.a23 * t.b13 * g;
  m(1, 1) = t.a23 - t.a12 + t.a13 * g;
  m(1, 2) = m(2, 1) = 0.5 * t.b23 * (t.a13 * g - t.a12);
  m(2, 2) = g * (t.a13 - t.a23) - t.a12;
  return m;
}

/// Distances in the plane l1 = w0 l2 + w1 l3; appends to `distances`.
void distances_in_plane(const Triangle& t, double w0, double w1,
                        std::array<Vector3d, kMostThreePointPoses>& distances, int& count) noexcept {
  const double a = 1.0 / ((t.a13 - t.a12) * w1 * w1 - t.a12 * t.b13 * w1 - t.a12);
  const double b = (t.a13 * t.b12 * w1 - t.a12 * t.b13 * w0 - 2 * w0 * w1 * (t.a12 - t.a13)) * a;
  const double c = ((t.a13 - t.a12) * w0 * w0 + t.a13 * t.b12 * w0 + t.a13) * a;
  double tau[2];
  if (!quadratic_roots(b, c, tau[0], tau[1])) return;
  for (const double ratio : tau) {
    if (!(ratio > 0) || count == kMostThreePointPoses) continue;
    const double d = t.a23 / (ratio * (t.b23 + ratio) + 1);
    if (!(d > 0)) continue;
    const double l2 = std::sqrt(d), l3 = ratio * l2, l1 = w0 * l2 + w1 * l3;
    if (l1 >= 0) distances[static_cast<std::size_t>(count++)] = Vector3d(l1, l2, l3);
  }
}

int central_distances(const Triangle& t, std::array<Vector3d, kMostThreePointPoses>& distances) noexcept {
  const Matrix3d m = degenerate_conic(t);
  const double b = -m.trace();
  const double c = m(0, 0) * (m(1, 1) + m(2, 2)) + m(1, 1) * m(2, 2) - m(0, 1) * m(0, 1) - m(0, 2) * m(0, 2) -
                   m(1, 2) * m(1, 2);
  double e1, e2;
  if (!quadratic_roots(b, c, e1, e2)) return 0;
  if (std::abs(e1) < std::abs(e2)) std::swap(e1, e2);
  const Vector3d v1 = eigenvector(m, e1), v2 = eigenvector(m, e2);
  const double s = std::sqrt(std::max(0.0, -e2 / e1));
  int count = 0;
  for (const double sign : {s, -s}) {
    const double w2 = 1.0 / (sign * v2[0] - v1[0]);
    distances_in_plane(t, (v1[1] - sign * v2[1]) * w2, (v1[2] - sign * v2[2]) * w2, distances, count);
  }
  return count;
}

bool triangle_of(const ThreePoints& s, Triangle& t) noexcept {
  const Vector3d d12 = s.point[0] - s.point[1], d13 = s.point[0] - s.point[2], d23 = s.point[1] - s.point[2];
  t = {d12.squaredNorm(),           d13.squaredNorm(),           d23.squaredNorm(),
       -2 * s.ray[0].dot(s.ray[1]), -2 * s.ray[0].dot(s.ray[2]), -2 * s.ray[1].dot(s.ray[2])};
  const double area2 = d12.cross(d13).squaredNorm();
  return area2 > 1e-10 * t.a12 * t.a13 && t.a23 > 0;
}

}  // namespace

bool polish_distances(const ThreePoints& s, int iterations, Vector3d& l) noexcept {
  const double a12 = (s.point[0] - s.point[1]).squaredNorm(), a13 = (s.point[0] - s.point[2]).squaredNorm(),
               a23 = (s.point[1] - s.point[2]).squaredNorm();
  for (int i = 0; i < iterations; ++i) {
    const Vector3d x1 = s.origin[0] + l[0] * s.ray[0], x2 = s.origin[1] + l[1] * s.ray[1],
                   x3 = s.origin[2] + l[2] * s.ray[2];
    const Vector3d d12 = x1 - x2, d13 = x1 - x3, d23 = x2 - x3;
    const double r1 = d12.squaredNorm() - a12, r2 = d13.squaredNorm() - a13, r3 = d23.squaredNorm() - a23;
    if (std::abs(r1) + std::abs(r2) + std::abs(r3) < 1e-14 * (a12 + a13 + a23)) return l.minCoeff() > 0;
    // Half the Jacobian is [p −q 0; u 0 −v; 0 x −y], inverted by hand.
    const double p = d12.dot(s.ray[0]), q = d12.dot(s.ray[1]), u = d13.dot(s.ray[0]), v = d13.dot(s.ray[2]),
                 x = d23.dot(s.ray[1]), y = d23.dot(s.ray[2]);
    const double determinant = 2 * (p * v * x - q * u * y);
    if (!(std::abs(determinant) > 0)) return false;
    const double k = 1.0 / determinant;
    l[0] -= k * (v * x * r1 - q * y * r2 + q * v * r3);
    l[1] -= k * (u * y * r1 - p * y * r2 + p * v * r3);
    l[2] -= k * (u * x * r1 - p * x * r2 + q * u * r3);
    if (!l.allFinite()) return false;
  }
  if (!(l.minCoeff() > 0)) return false;
  const Vector3d x1 = s.origin[0] + l[0] * s.ray[0], x2 = s.origin[1] + l[1] * s.ray[1],
                 x3 = s.origin[2] + l[2] * s.ray[2];
  const double left = std::abs((x1 - x2).squaredNorm() - a12) + std::abs((x1 - x3).squaredNorm() - a13) +
                      std::abs((x2 - x3).squaredNorm() - a23);
  return left < 1e-6 * (a12 + a13 + a23);
}

Pose pose_at_distances(const ThreePoints& s, const Vector3d& l) noexcept {
  const auto frame = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    Matrix3d axes;
    axes.col(0) = (b - a).normalized();
    axes.col(2) = (b - a).cross(c - a).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  };
  const Vector3d x1 = s.origin[0] + l[0] * s.ray[0], x2 = s.origin[1] + l[1] * s.ray[1],
                 x3 = s.origin[2] + l[2] * s.ray[2];
  const Matrix3d rotation = frame(x1, x2, x3) * frame(s.point[0], s.point[1], s.point[2]).transpose();
  Pose pose;
  pose.rotation = Eigen::Quaterniond(rotation).normalized();
  pose.translation = (x1 + x2 + x3) / 3 - pose.rotation * ((s.point[0] + s.point[1] + s.point[2]) / 3);
  return pose;
}

int central_three_point(const ThreePoints& sights,
                        std::array<Pose, kMostThreePointPoses>& rig_from_body) noexcept {
  Triangle triangle;
  if (!triangle_of(sights, triangle)) return 0;
  std::array<Vector3d, kMostThreePointPoses> distances;
  const int found = central_distances(triangle, distances);
  int count = 0;
  for (int i = 0; i < found; ++i) {
    Vector3d& l = distances[static_cast<std::size_t>(i)];
    if (!polish_distances(sights, 2, l)) continue;
    rig_from_body[static_cast<std::size_t>(count++)] = pose_at_distances(sights, l);
  }
  return count;
}

}  // namespace omma
