#include "components/tracker/target_patches.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr std::size_t kNeighbours = 10;   // of a target, that share its patches
constexpr double kThinnest = 0.02;        // thickness over width below which a body is a plane
constexpr double kFlattestTriple = 0.08;  // sine of the angle between a triple's edges
constexpr double kFarthestFourth =
    1.4;                             // dots choose the largest of their triangles: coordinates stay within 1
constexpr int kAlignmentRounds = 4;  // parallel projection brought to perspective
constexpr double kAlignmentSlack = 0.03;  // what they leave, part of the patch's size
constexpr double kSlack = 0.01;           // added to each coordinate's tolerance

std::vector<std::uint8_t> neighbours_of(const TargetBody& body, std::size_t target) {
  std::vector<std::uint8_t> others;
  for (std::size_t i = 0; i < body.targets.size(); ++i)
    if (i != target) others.push_back(static_cast<std::uint8_t>(i));
  const auto squared_distance = [&](std::uint8_t i) {
    return (body.targets[i].position - body.targets[target].position).squaredNorm();
  };
  std::stable_sort(others.begin(), others.end(),
                   [&](std::uint8_t a, std::uint8_t b) { return squared_distance(a) < squared_distance(b); });
  if (others.size() > kNeighbours) others.resize(kNeighbours);
  return others;
}

bool is_flat(const TargetBody& body) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Target& target : body.targets) mean += target.position;
  mean /= static_cast<double>(std::max<std::size_t>(1, body.targets.size()));
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Target& target : body.targets)
    scatter += (target.position - mean) * (target.position - mean).transpose();
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
  return spread[0] <= kThinnest * kThinnest * spread[1];
}

bool parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.dot(b) > 0.999;
}

/// Which way the face that the three targets share looks along the normal n of the triple; 0: they share
/// none.
std::int8_t front_of(const TargetBody& body, std::size_t i, std::size_t j, std::size_t k,
                     const Eigen::Vector3d& n) {
  const Eigen::Vector3d& face = body.targets[i].normal;
  const double along = face.dot(n);
  if (!parallel(face, body.targets[j].normal) || !parallel(face, body.targets[k].normal) ||
      !(std::abs(along) > 0.99))
    return 0;
  return along > 0 ? 1 : -1;
}

/// Three targets of one face that are seen at all are seen from its front.
bool seen_from_behind(const DotPatch& patch, std::int8_t front) noexcept {
  return front * (patch.u.x() * patch.v.y() - patch.u.y() * patch.v.x()) > 0;
}

/// How far perspective may move the affine coordinates of a fourth point off their parallel-projection
/// values, to first order, when the patch is tilted by up to atan(tilt).
void perspective_reach(const DotPatch& patch, double tilt, double& alpha_reach, double& beta_reach) noexcept {
  const double a = patch.alpha, b = patch.beta;
  alpha_reach = tilt * std::abs(a) * ((1 - a) * patch.u - b * patch.v).norm();
  beta_reach = tilt * std::abs(b) * ((1 - b) * patch.v - a * patch.u).norm();
}

}  // namespace

TargetPatches::TargetPatches(const TargetBody& body, double tilt_factor)
    : tilt_factor_(tilt_factor), flat_(is_flat(body)) {
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    const std::vector<std::uint8_t> neighbours = neighbours_of(body, i);
    for (const std::uint8_t j : neighbours)
      for (const std::uint8_t k : neighbours)
        if (j != k) add_triple(body, neighbours, static_cast<std::uint8_t>(i), j, k);
  }
  std::stable_sort(planar_.begin(), planar_.end(),
                   [](const Fourth& a, const Fourth& b) { return a.alpha < b.alpha; });
}

void TargetPatches::add_triple(const TargetBody& body, std::span<const std::uint8_t> neighbours,
                               std::uint8_t i, std::uint8_t j, std::uint8_t k) {
  const Eigen::Vector3d& origin = body.targets[i].position;
  const Eigen::Vector3d e1 = body.targets[j].position - origin, e2 = body.targets[k].position - origin;
  const Eigen::Vector3d cross = e1.cross(e2);
  const double area = cross.norm();
  if (!(area > kFlattestTriple * e1.norm() * e2.norm())) return;
  const Eigen::Vector3d n = cross / area;
  Triple triple{{i, j, k},
                static_cast<float>(e1.squaredNorm()),
                static_cast<float>(e1.dot(e2)),
                static_cast<float>(e2.squaredNorm()),
                static_cast<float>(area),
                static_cast<std::uint32_t>(fourths_.size()),
                0,
                front_of(body, i, j, k, n)};
  for (const std::uint8_t l : neighbours) {
    if (l == j || l == k) continue;
    const Eigen::Vector3d d = body.targets[l].position - origin;
    const double alpha = d.cross(e2).dot(n) / area, beta = e1.cross(d).dot(n) / area;
    const bool in_reach = std::abs(alpha) < kFarthestFourth && std::abs(beta) < kFarthestFourth &&
                          std::abs(1 - alpha - beta) < kFarthestFourth;
    const Fourth fourth{static_cast<float>(alpha), static_cast<float>(beta), static_cast<float>(d.dot(n)),
                        static_cast<std::uint32_t>(triples_.size()), l};
    const bool on_face = triple.front != 0 && parallel(body.targets[l].normal, body.targets[i].normal) &&
                         std::abs(d.dot(n)) < kThinnest * std::sqrt(area);
    if ((flat_ || on_face) && in_reach) planar_.push_back(fourth);
    if (flat_) continue;  // all of them lie in the plane
    fourths_.push_back(fourth);
    ++triple.count;
  }
  triples_.push_back(triple);
}

std::size_t TargetPatches::matching_planar(const DotPatch& patch, std::span<PatchLabels> out) const noexcept {
  double alpha_reach, beta_reach;
  perspective_reach(patch, tilt_factor_, alpha_reach, beta_reach);
  const auto alpha = static_cast<float>(patch.alpha), beta = static_cast<float>(patch.beta);
  const auto alpha_tolerance = static_cast<float>(alpha_reach + patch.alpha_noise + kSlack);
  const auto beta_tolerance = static_cast<float>(beta_reach + patch.beta_noise + kSlack);
  auto fourth = std::lower_bound(planar_.begin(), planar_.end(), alpha - alpha_tolerance,
                                 [](const Fourth& entry, float value) { return entry.alpha < value; });
  std::size_t count = 0;
  for (; fourth != planar_.end() && fourth->alpha <= alpha + alpha_tolerance; ++fourth) {
    if (!(std::abs(fourth->beta - beta) <= beta_tolerance)) continue;
    if (count == out.size()) break;
    const Triple& triple = triples_[fourth->triple];
    if (seen_from_behind(patch, triple.front)) continue;
    out[count++] = {triple.targets[0], triple.targets[1], triple.targets[2], fourth->target};
  }
  return count;
}

TargetPatches::Alignment TargetPatches::aligned(const DotPatch& patch, const Triple& triple,
                                                double sign) noexcept {
  // The first of the three is at depth 1; u, v are the edges as parallel projection would show them.
  Alignment found{patch.u, patch.v, 0, 0, Eigen::Vector3d::Zero()};
  const double g11 = triple.g11, g12 = triple.g12, g22 = triple.g22;
  const double gram = g11 * g22 - g12 * g12;
  double scale2 = 0;
  for (int round = 0; round < kAlignmentRounds; ++round) {
    found.u = patch.at[1] * (1 + found.z1) - patch.at[0];
    found.v = patch.at[2] * (1 + found.z2) - patch.at[0];
    const double uu = found.u.squaredNorm(), vv = found.v.squaredNorm(), uv = found.u.dot(found.v);
    // Squared scale S: (S g11 − uu)(S g22 − vv) = (S g12 − uv)², the larger root; then the depths of the
    // edges.
    const double b = 0.5 * (g11 * vv + g22 * uu - 2 * g12 * uv);
    const double discriminant = std::max(0.0, b * b - gram * (uu * vv - uv * uv));
    scale2 = (b + std::sqrt(discriminant)) / gram;
    found.z1 = sign * std::sqrt(std::max(0.0, scale2 * g11 - uu));
    found.z2 = sign * std::sqrt(std::max(0.0, scale2 * g22 - vv));
    if (scale2 * g12 - uv < 0) found.z2 = -found.z2;
  }
  const double k = 1.0 / (std::sqrt(scale2) * triple.area);
  found.normal = {(found.u.y() * found.z2 - found.z1 * found.v.y()) * k,
                  (found.z1 * found.v.x() - found.u.x() * found.z2) * k,
                  (found.u.x() * found.v.y() - found.u.y() * found.v.x()) * k};
  return found;
}

std::size_t TargetPatches::matching_solid(const DotPatch& patch, std::span<PatchLabels> out) const noexcept {
  const double size = std::max(patch.u.norm(), patch.v.norm());
  const double reach = patch.noise + kAlignmentSlack * size;
  std::size_t count = 0;
  for (const Triple& triple : triples_) {
    if (seen_from_behind(patch, triple.front)) continue;
    for (const double sign : {1.0, -1.0}) {
      const Alignment found = aligned(patch, triple, sign);
      for (std::uint32_t f = triple.first; f < triple.first + triple.count; ++f) {
        const Fourth& fourth = fourths_[f];
        const double alpha = fourth.alpha, beta = fourth.beta, gamma = fourth.gamma;
        const double depth = 1 + alpha * found.z1 + beta * found.z2 + gamma * found.normal.z();
        const Eigen::Vector2d at =
            patch.at[0] + alpha * found.u + beta * found.v + gamma * found.normal.head<2>();
        if (!((at - depth * patch.at[3]).squaredNorm() <= reach * reach * depth * depth)) continue;
        if (count == out.size()) return count;
        out[count++] = {triple.targets[0], triple.targets[1], triple.targets[2], fourth.target};
      }
    }
  }
  return count;
}

}  // namespace omma
