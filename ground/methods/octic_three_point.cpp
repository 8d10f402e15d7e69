#include "ground/methods/octic_three_point.hpp"

#include <Eigen/LU>
#include <cmath>
#include <unsupported/Eigen/Polynomials>
#include <vector>

#include "ground/methods/absolute_orientation.hpp"

namespace omma {
namespace {

using Eigen::Vector3d;

constexpr int kPolishSteps = 20;
constexpr double kNearlyReal = 0.05;  // |imaginary| of a root worth polishing, part of its magnitude

/// Coefficients by rising power.
template <int kDegree>
using Polynomial = Eigen::Matrix<double, kDegree + 1, 1>;

template <int kRows, int kOtherRows>
Eigen::Matrix<double, kRows + kOtherRows - 1, 1> product(const Eigen::Matrix<double, kRows, 1>& a,
                                                         const Eigen::Matrix<double, kOtherRows, 1>& b) {
  Eigen::Matrix<double, kRows + kOtherRows - 1, 1> c;
  c.setZero();
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kOtherRows; ++j) c(i + j) += a(i) * b(j);
  return c;
}

/// |w + x v − y u|² = a² between the points at x on one ray and at y on the other, w from the second centre
/// to the first: x² + y² − 2 cos x y + 2 w·v x − 2 w·u y + w² − a².
struct Side {
  double cosine, first, second, constant;
  Side(const Vector3d& w, const Vector3d& v, const Vector3d& u, double squared_length)
      : cosine(v.dot(u)), first(w.dot(v)), second(w.dot(u)), constant(w.squaredNorm() - squared_length) {}
};

/// Of the range along the first ray.
Polynomial<8> octic(const Side& s12, const Side& s13, const Side& s23, Polynomial<3>& u, Polynomial<4>& v) {
  // y² + p y + q = 0 (side 12), z² + r z + s = 0 (side 13), with polynomials in x.
  const Polynomial<1> p(-2 * s12.second, -2 * s12.cosine), r(-2 * s13.second, -2 * s13.cosine);
  const Polynomial<2> q(s12.constant, 2 * s12.first, 1), s(s13.constant, 2 * s13.first, 1);
  // Side 23 less both: c y z + a y + b z + d = 0.
  const double c = -2 * s23.cosine;
  const Polynomial<1> a(2 * s23.first - p(0), -p(1)), b(-2 * s23.second - r(0), -r(1));
  Polynomial<2> d = -q - s;
  d(0) += s23.constant;
  // z = −(a y + d)/(c y + b) into side 13: α y² + β y + γ = 0; less α times side 12: u y + v = 0.
  const Polynomial<2> alpha = product(a, a) - c * product(r, a) + c * c * s;
  const Polynomial<3> beta =
      2 * product(a, d) - product(r, Polynomial<2>(product(a, b) + c * d)) + 2 * c * product(s, b);
  const Polynomial<4> gamma = product(d, d) - product(r, product(d, b)) + product(s, product(b, b));
  u = beta - product(alpha, p);
  v = gamma - product(alpha, q);
  // y = −v/u into side 12: v² − p u v + q u² = 0.
  return product(v, v) - product(p, product(u, v)) + product(q, product(u, u));
}

/// Newton on the three sides' equations; false where it does not settle in front of the cameras.
bool polish(const ThreePoints& sights, Vector3d& l) {
  const int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  for (int step = 0; step < kPolishSteps; ++step) {
    Vector3d error;
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(pairs[k][0]), j = static_cast<std::size_t>(pairs[k][1]);
      const Vector3d gap = sights.origin[i] + l(pairs[k][0]) * sights.ray[i] - sights.origin[j] -
                           l(pairs[k][1]) * sights.ray[j];
      error(k) = gap.squaredNorm() - (sights.point[i] - sights.point[j]).squaredNorm();
      slope(k, pairs[k][0]) = 2 * gap.dot(sights.ray[i]);
      slope(k, pairs[k][1]) = -2 * gap.dot(sights.ray[j]);
    }
    const Vector3d change = slope.partialPivLu().solve(error);
    if (!change.allFinite()) return false;
    l -= change;
    if (change.norm() < 1e-13 * l.norm()) return l.minCoeff() > 0;
  }
  return false;
}

}  // namespace

int octic_three_point(const ThreePoints& sights, std::array<Pose, kMostOcticPoses>& rig_from_body) {
  const auto side = [&](std::size_t i, std::size_t j) {
    return Side(sights.origin[i] - sights.origin[j], sights.ray[i], sights.ray[j],
                (sights.point[i] - sights.point[j]).squaredNorm());
  };
  Polynomial<3> u;
  Polynomial<4> v;
  const Polynomial<8> polynomial = octic(side(0, 1), side(0, 2), side(1, 2), u, v);
  if (!polynomial.allFinite() || polynomial(8) == 0) return 0;
  const Eigen::PolynomialSolver<double, 8> solver(polynomial);
  std::vector<Vector3d> found;
  for (const std::complex<double>& root : solver.roots()) {
    if (!(std::abs(root.imag()) < kNearlyReal * std::abs(root)) || !(root.real() > 0)) continue;
    const double x = root.real();
    const double y = -Eigen::poly_eval(v, x) / Eigen::poly_eval(u, x);
    const Side s13 = side(0, 2), s23 = side(1, 2);
    const double z =
        -((2 * s23.first + 2 * side(0, 1).second + 2 * side(0, 1).cosine * x) * y + s23.constant -
          side(0, 1).constant - s13.constant - 2 * (side(0, 1).first + s13.first) * x - 2 * x * x) /
        (-2 * s23.cosine * y - 2 * s23.second + 2 * s13.second + 2 * s13.cosine * x);
    Vector3d l(x, y, z);
    if (!l.allFinite() || !polish(sights, l)) continue;
    bool is_new = true;
    for (const Vector3d& other : found) is_new &= (other - l).norm() > 1e-9 * l.norm();
    if (is_new) found.push_back(l);
  }
  int count = 0;
  for (const Vector3d& l : found) {
    std::array<Vector3d, 3> places;
    for (std::size_t i = 0; i < 3; ++i)
      places[i] = sights.origin[i] + l(static_cast<Eigen::Index>(i)) * sights.ray[i];
    rig_from_body[static_cast<std::size_t>(count++)] = absolute_orientation(sights.point, places);
  }
  return count;
}

}  // namespace omma
