#include "components/tracker/target_patches.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace omma {
namespace {

constexpr std::size_t kNeighbours = 10;   // of a target, that share its patches on a card or a face
constexpr double kThinnest = 0.02;        // thickness over width below which a body is a plane
constexpr double kFlattestTriple = 0.08;  // sine of the angle between a triple's edges
constexpr double kFarthestFourth =
    1.4;                              // dots choose the largest of their triangles: coordinates stay within 1
constexpr int kAlignmentRounds = 3;   // parallel projection brought to perspective
constexpr float kTurnedAway = 0.15F;  // cosine from the line of sight to the patch
constexpr float kAlignmentSlack = 0.015F;  // what they leave, part of the patch's size
constexpr double kSlack = 0.01;            // added to each coordinate's tolerance

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

/// Two targets that no place has both before it: each behind the other's face.
bool never_together(const Target& a, const Target& b) {
  return a.normal.dot(b.normal) < -0.98 && a.normal.dot(b.position - a.position) <= 0;
}

/// How four triples lie in space where three dots show them: edges (u, v with depths z1, z2) and unit normal
/// (one metre) at the scale of the image with the first of them at depth 1.
struct Alignment {
  Four ux, uy, vx, vy, z1, z2, nx, ny, nz;
  FourMask possible;
};

template <class Block>
[[gnu::always_inline]] inline Alignment aligned(const DotPatch& patch, const Block& block,
                                                float sign) noexcept {
  const Eigen::Vector2f a = patch.at[0].cast<float>(), b = patch.at[1].cast<float>(),
                        c = patch.at[2].cast<float>();
  const Four g11 = load_four(block.g11.data()), g12 = load_four(block.g12.data()),
             g22 = load_four(block.g22.data()), per_gram = load_four(block.per_gram.data());
  Alignment found{};
  Four scale2{};
  for (int round = 0; round < kAlignmentRounds; ++round) {
    found.ux = b.x() * (1 + found.z1) - a.x();
    found.uy = b.y() * (1 + found.z1) - a.y();
    found.vx = c.x() * (1 + found.z2) - a.x();
    found.vy = c.y() * (1 + found.z2) - a.y();
    const Four uu = found.ux * found.ux + found.uy * found.uy, vv = found.vx * found.vx + found.vy * found.vy,
               uv = found.ux * found.vx + found.uy * found.vy,
               cross = found.ux * found.vy - found.uy * found.vx;
    // Squared scale S: (S g11 − uu)(S g22 − vv) = (S g12 − uv)², the larger root; then the depths of the
    // edges.
    const Four half = (0.5F * (g11 * vv + g22 * uu) - g12 * uv) * per_gram;
    const Four discriminant = half * half - cross * cross * per_gram;
    scale2 = half + root(at_least_zero(discriminant));
    const Four z1 = scale2 * g11 - uu, z2 = scale2 * g22 - vv;
    found.z1 = sign * root(at_least_zero(z1));
    found.z2 = sign * root(at_least_zero(z2));
    found.z2 = scale2 * g12 < uv ? -found.z2 : found.z2;
  }
  const Four k = load_four(block.per_area.data()) / root(scale2);
  found.nx = (found.uy * found.z2 - found.z1 * found.vy) * k;
  found.ny = (found.z1 * found.vx - found.ux * found.z2) * k;
  found.nz = (found.ux * found.vy - found.uy * found.vx) * k;
  // Each of the three has its face towards the camera.
  found.possible = scale2 > 0;
  const Four scale = root(scale2);
  for (const auto& facing : block.facing)
    found.possible &= load_four(facing[0].data()) * found.z1 + load_four(facing[1].data()) * found.z2 +
                          load_four(facing[2].data()) * found.nz <=
                      kTurnedAway * scale;
  return found;
}

}  // namespace

TargetPatches::TargetPatches(const TargetBody& body, double tilt_factor)
    : tilt_factor_(tilt_factor), flat_(is_flat(body)) {
  std::vector<Solid> solid;
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    has_faces_ = has_faces_ || !body.targets[i].normal.isZero(0);
    const std::vector<std::uint8_t> neighbours = neighbours_of(body, i);
    for (const std::uint8_t j : neighbours)
      for (const std::uint8_t k : neighbours)
        if (j != k) add_triple(body, neighbours, static_cast<std::uint8_t>(i), j, k, solid);
  }
  std::stable_sort(planar_.begin(), planar_.end(),
                   [](const PlanarFoursome& a, const PlanarFoursome& b) { return a.alpha < b.alpha; });
  lay_side_by_side(solid);
}

void TargetPatches::add_triple(const TargetBody& body, std::span<const std::uint8_t> neighbours,
                               std::uint8_t i, std::uint8_t j, std::uint8_t k, std::vector<Solid>& solid) {
  const Target &first = body.targets[i], &second = body.targets[j], &third = body.targets[k];
  const Eigen::Vector3d e1 = second.position - first.position, e2 = third.position - first.position;
  const Eigen::Vector3d cross = e1.cross(e2);
  const double area = cross.norm();
  if (!(area > kFlattestTriple * e1.norm() * e2.norm())) return;
  const Eigen::Vector3d n = cross / area;
  // What a vector is in e1, e2 and n.
  const auto in_triple = [&](const Eigen::Vector3d& d) {
    return Eigen::Vector3d(d.cross(e2).dot(n) / area, e1.cross(d).dot(n) / area, d.dot(n));
  };
  Solid entry;
  entry.triple = {{i, j, k}, front_of(body, i, j, k, n)};
  entry.g11 = static_cast<float>(e1.squaredNorm());
  entry.g12 = static_cast<float>(e1.dot(e2));
  entry.g22 = static_cast<float>(e2.squaredNorm());
  entry.area = static_cast<float>(area);
  entry.size = std::max({entry.g11, entry.g22, static_cast<float>((e1 - e2).squaredNorm())});
  entry.facing = {in_triple(first.normal).cast<float>(), in_triple(second.normal).cast<float>(),
                  in_triple(third.normal).cast<float>()};
  for (auto* row : {&entry.alpha, &entry.beta, &entry.gamma})
    row->fill(std::numeric_limits<float>::quiet_NaN());
  entry.fourth.fill(0);
  const auto is_near = [&](std::uint8_t target) {
    return std::find(neighbours.begin(), neighbours.end(), target) - neighbours.begin() <
           static_cast<std::ptrdiff_t>(kSolidNeighbours);
  };
  std::size_t count = 0;
  for (const std::uint8_t l : neighbours) {
    if (l == j || l == k) continue;
    const Eigen::Vector3d at = in_triple(body.targets[l].position - first.position);
    const double alpha = at.x(), beta = at.y(), gamma = at.z();
    const bool in_reach = std::abs(alpha) < kFarthestFourth && std::abs(beta) < kFarthestFourth &&
                          std::abs(1 - alpha - beta) < kFarthestFourth;
    const bool on_face = entry.triple.front != 0 && parallel(body.targets[l].normal, first.normal) &&
                         std::abs(gamma) < kThinnest * std::sqrt(area);
    if ((flat_ || on_face) && in_reach)
      planar_.push_back(
          {static_cast<float>(alpha), static_cast<float>(beta), entry.triple.front, {i, j, k, l}});
    if (count == kFourths || !is_near(l)) continue;
    entry.alpha[count] = static_cast<float>(alpha);
    entry.beta[count] = static_cast<float>(beta);
    entry.gamma[count] = static_cast<float>(gamma);
    entry.fourth[count++] = l;
  }
  const bool together =
      !never_together(first, second) && !never_together(first, third) && !never_together(second, third);
  // All of a card's lie in the plane.
  if (!flat_ && is_near(j) && is_near(k) && together) solid.push_back(entry);
}

void TargetPatches::lay_side_by_side(std::vector<Solid>& solid) {
  // Neighbours in an image are rather near each other in space as well: the smallest are tried first.
  std::stable_sort(solid.begin(), solid.end(),
                   [](const Solid& a, const Solid& b) { return a.size < b.size; });
  Row none;
  none.fill(std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < solid.size(); ++i) {
    const Solid& entry = solid[i];
    const std::size_t lane = i % kFour;
    if (lane == 0) {
      blocks_.push_back({});
      blocks_.back().alpha.fill(none);
    }
    Block& block = blocks_.back();
    block.g11[lane] = entry.g11;
    block.g12[lane] = entry.g12;
    block.g22[lane] = entry.g22;
    block.per_gram[lane] = 1 / (entry.area * entry.area);
    block.per_area[lane] = 1 / entry.area;
    block.triple[lane] = entry.triple;
    for (std::size_t f = 0; f < kFourths; ++f) {
      block.alpha[f][lane] = entry.alpha[f];
      block.beta[f][lane] = entry.beta[f];
      block.gamma[f][lane] = entry.gamma[f];
      block.fourth[f][lane] = entry.fourth[f];
    }
    for (std::size_t t = 0; t < 3; ++t)
      for (std::size_t axis = 0; axis < 3; ++axis)
        block.facing[t][axis][lane] = entry.facing[t][static_cast<Eigen::Index>(axis)];
  }
}

std::size_t TargetPatches::matching_planar(const DotPatch& patch, std::span<PatchLabels> out) const noexcept {
  double alpha_reach, beta_reach;
  perspective_reach(patch, tilt_factor_, alpha_reach, beta_reach);
  const auto alpha = static_cast<float>(patch.alpha), beta = static_cast<float>(patch.beta);
  const auto alpha_tolerance = static_cast<float>(alpha_reach + patch.alpha_noise + kSlack);
  const auto beta_tolerance = static_cast<float>(beta_reach + patch.beta_noise + kSlack);
  auto entry =
      std::lower_bound(planar_.begin(), planar_.end(), alpha - alpha_tolerance,
                       [](const PlanarFoursome& foursome, float value) { return foursome.alpha < value; });
  std::size_t count = 0;
  for (; entry != planar_.end() && entry->alpha <= alpha + alpha_tolerance && count < out.size(); ++entry) {
    if (!(std::abs(entry->beta - beta) <= beta_tolerance) || seen_from_behind(patch, entry->front)) continue;
    out[count++] = entry->targets;
  }
  return count;
}

// The first of the three is at depth 1; u, v are the edges as parallel projection would show them, brought to
// perspective round by round.
std::size_t TargetPatches::matching_solid(const DotPatch& patch, std::size_t& block,
                                          std::span<PatchLabels> out) const noexcept {
  const Eigen::Vector2f first = patch.at[0].cast<float>(), fourth = patch.at[3].cast<float>();
  const auto size = static_cast<float>(std::max(patch.u.norm(), patch.v.norm()));
  const float reach = static_cast<float>(patch.noise) + kAlignmentSlack * size;
  std::size_t count = 0;
  for (; block < blocks_.size() && count + kMostOfBlock <= out.size(); ++block) {
    const Block& triples = blocks_[block];
    for (const float sign : {1.0F, -1.0F}) {
      const Alignment found = aligned(patch, triples, sign);
      if (!any(found.possible)) continue;
      for (std::size_t f = 0; f < kFourths; ++f) {
        const Four alpha = load_four(triples.alpha[f].data()), beta = load_four(triples.beta[f].data()),
                   gamma = load_four(triples.gamma[f].data());
        const Four depth = 1 + alpha * found.z1 + beta * found.z2 + gamma * found.nz;
        const Four x = first.x() + alpha * found.ux + beta * found.vx + gamma * found.nx - depth * fourth.x();
        const Four y = first.y() + alpha * found.uy + beta * found.vy + gamma * found.ny - depth * fourth.y();
        const FourMask within = (x * x + y * y <= reach * reach * depth * depth) & found.possible;
        if (!any(within)) continue;
        for (std::size_t lane = 0; lane < kFour; ++lane) {
          const Triple& three = triples.triple[lane];
          if (within[lane] == 0 || seen_from_behind(patch, three.front)) continue;
          out[count++] = {three.targets[0], three.targets[1], three.targets[2], triples.fourth[f][lane]};
        }
      }
    }
  }
  return count;
}

}  // namespace omma
