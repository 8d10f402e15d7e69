#include "components/estimation/generalised_three_point.hpp"

#include <algorithm>
#include <cmath>

#include "components/estimation/positive_roots.hpp"

namespace omma {
namespace {

using Eigen::Vector3d;

constexpr int kPolishSteps = 12;
constexpr double kUnitOfLength = 4;  // of the octic: sizes of the triangle, so that roots are of order one
constexpr double kSame = 1e-7;       // distances that differ by less, in parts, are one solution

/// By rising power.
template <int kDegree>
using Polynomial = Eigen::Matrix<double, kDegree + 1, 1>;

template <int kRows, int kOtherRows>
Eigen::Matrix<double, kRows + kOtherRows - 1, 1> product(
    const Eigen::Matrix<double, kRows, 1>& a, const Eigen::Matrix<double, kOtherRows, 1>& b) noexcept {
  Eigen::Matrix<double, kRows + kOtherRows - 1, 1> c;
  c.setZero();
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kOtherRows; ++j) c(i + j) += a(i) * b(j);
  return c;
}

/// The points at x along ray v and at y along ray u, w from the second centre to the first, are a side of the
/// triangle apart: x² + y² − 2 cos x y + 2 w·v x − 2 w·u y + w² − a² = 0.
struct Side {
  double cosine, first, second, constant;
  Side(const ThreePoints& s, std::size_t i, std::size_t j, double unit) noexcept {
    const Vector3d w = (s.origin[i] - s.origin[j]) / unit;
    cosine = s.ray[i].dot(s.ray[j]);
    first = w.dot(s.ray[i]);
    second = w.dot(s.ray[j]);
    constant = w.squaredNorm() - (s.point[i] - s.point[j]).squaredNorm() / (unit * unit);
  }
};

/// The elimination: an octic in x, the first range; given x, y solves u(x) y + v(x) = 0, and z is a quotient.
struct Elimination {
  Polynomial<8> octic;
  Polynomial<3> u;
  Polynomial<4> v;
  Polynomial<1> a, b;  // c y z + a y + b z + d = 0
  Polynomial<2> d;
  double c;

  Elimination(const Side& s12, const Side& s13, const Side& s23) noexcept {
    // y² + p y + q = 0 (side 12), z² + r z + s = 0 (side 13), with polynomials in x.
    const Polynomial<1> p(-2 * s12.second, -2 * s12.cosine), r(-2 * s13.second, -2 * s13.cosine);
    const Polynomial<2> q(s12.constant, 2 * s12.first, 1), s(s13.constant, 2 * s13.first, 1);
    // Side 23 less both.
    c = -2 * s23.cosine;
    a = Polynomial<1>(2 * s23.first - p(0), -p(1));
    b = Polynomial<1>(-2 * s23.second - r(0), -r(1));
    d = -q - s;
    d(0) += s23.constant;
    // z = −(a y + d)/(c y + b) into side 13: α y² + β y + γ = 0; less α times side 12: u y + v = 0.
    const Polynomial<2> alpha = product(a, a) - c * product(r, a) + c * c * s;
    const Polynomial<2> mixed = product(a, b) + c * d;
    const Polynomial<3> beta = 2 * product(a, d) - product(r, mixed) + 2 * c * product(s, b);
    const Polynomial<4> gamma = product(d, d) - product(r, product(d, b)) + product(s, product(b, b));
    u = beta - product(alpha, p);
    v = gamma - product(alpha, q);
    // y = −v/u into side 12.
    octic = product(v, v) - product(p, product(u, v)) + product(q, product(u, u));
  }

  Vector3d ranges(double x) const noexcept {
    const auto at = [x](const auto& polynomial) {
      double value = 0;
      for (Eigen::Index k = polynomial.size() - 1; k >= 0; --k) value = value * x + polynomial(k);
      return value;
    };
    const double y = -at(v) / at(u);
    return {x, y, -(at(a) * y + at(d)) / (c * y + at(b))};
  }
};

bool share_a_centre(const ThreePoints& s, double size) noexcept {
  const double apart = (s.origin[1] - s.origin[0]).squaredNorm() + (s.origin[2] - s.origin[0]).squaredNorm();
  return apart <= 1e-20 * size * size;
}

}  // namespace

int generalised_three_point(const ThreePoints& sights,
                            std::array<Pose, kMostGeneralisedPoses>& rig_from_body) noexcept {
  const Vector3d first = sights.point[1] - sights.point[0], second = sights.point[2] - sights.point[0];
  const double size = std::sqrt(std::max(first.squaredNorm(), second.squaredNorm()));
  if (!(first.cross(second).norm() > 1e-5 * size * size)) return 0;
  if (share_a_centre(sights, size)) {
    std::array<Pose, kMostThreePointPoses> central;
    const int count = central_three_point(sights, central);
    std::copy_n(central.begin(), count, rig_from_body.begin());
    return count;
  }
  const double unit = kUnitOfLength * size;
  const Elimination elimination(Side(sights, 0, 1, unit), Side(sights, 0, 2, unit), Side(sights, 1, 2, unit));
  Coefficients<8> coefficients;
  std::copy_n(elimination.octic.data(), 9, coefficients.begin());
  const Roots<8> roots = positive_roots<8>(coefficients);
  std::array<Vector3d, kMostGeneralisedPoses> found;
  int count = 0;
  for (int i = 0; i < roots.count; ++i) {
    Vector3d l = unit * elimination.ranges(roots.at[static_cast<std::size_t>(i)]);
    if (!l.allFinite() || !polish_distances(sights, kPolishSteps, l)) continue;
    const auto end = found.begin() + count;
    if (std::any_of(found.begin(), end,
                    [&l](const Vector3d& other) { return (other - l).norm() < kSame * l.norm(); }))
      continue;
    found[static_cast<std::size_t>(count)] = l;
    rig_from_body[static_cast<std::size_t>(count++)] = pose_at_distances(sights, l);
  }
  return count;
}

}  // namespace omma
