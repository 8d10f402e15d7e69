#include "components/tracker/patch_evidence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "components/tracker/four_lanes.hpp"

namespace omma {
namespace {

/// A tilt the patch does not fix bends what it foretells far from itself: error over squared distance
/// [1/rad].
constexpr float kBend = 0.1F;
constexpr float kFarOut = 2;        ///< squared affine distance from the patch beyond which that counts
constexpr double kSeen = 0.6;       ///< part of the targets turned to the camera that are seen
constexpr float kGrazing2 = 0.01F;  ///< as in faces(), squared
constexpr float kLeastDepth = 1e-6F;
constexpr float kVague = 0.6F;  ///< chance of a hit from which on it says nothing

/// A dot in a cell, seen from this and those around.
void mark(std::span<std::uint32_t> cells, int side, int x, int y, std::uint32_t dot) {
  for (int row = std::max(0, y - 1); row <= std::min(side - 1, y + 1); ++row)
    for (int column = std::max(0, x - 1); column <= std::min(side - 1, x + 1); ++column)
      cells[static_cast<std::size_t>(row * side + column)] |= dot;
}

}  // namespace

PatchEvidence::PatchEvidence(const TargetBody& body, double gate)
    : targets_(body.targets.size()), gate_(gate) {
  for (std::size_t t = 0; t < targets_; ++t) {
    const Target& target = body.targets[t];
    const Eigen::Vector3f p = target.position.cast<float>(), n = target.normal.cast<float>();
    x_[t] = p.x(), y_[t] = p.y(), z_[t] = p.z();
    nx_[t] = n.x(), ny_[t] = n.y(), nz_[t] = n.z();
    height_[t] = n.dot(p);
    sided_[t] = target.normal.isZero(0) ? 0 : 1;
    has_faces_ = has_faces_ || sided_[t] != 0;
  }
}

void PatchEvidence::look_at(std::span<const RigDot> dots, const DotFoursome& foursome,
                            std::span<const std::uint16_t> near) noexcept {
  middle_ = foursome.middle;
  plane_ = tangent_basis(middle_);
  origin_ = dots[foursome.dots[0]].origin;
  sigma_ = dots[foursome.dots[0]].sigma;
  Eigen::Matrix2d edges;
  edges << foursome.patch.u, foursome.patch.v;
  const double determinant = edges(0, 0) * edges(1, 1) - edges(0, 1) * edges(1, 0);
  affine_from_plane_ << edges(1, 1), -edges(0, 1), -edges(1, 0), edges(0, 0);
  affine_from_plane_ /= determinant;
  const Eigen::Vector3d& first = dots[foursome.dots[0]].ray;
  first_ = plane_.transpose() * first / first.dot(middle_);
  near_.clear();
  own_ = 0;
  for (const std::uint16_t dot : near) {
    const double depth = dots[dot].ray.dot(middle_);
    if (!(depth > 0.1)) continue;
    const Eigen::Vector2d at = plane_.transpose() * dots[dot].ray / depth;
    near_x_[near_.size()] = static_cast<float>(at.x());
    near_y_[near_.size()] = static_cast<float>(at.y());
    if (std::find(foursome.dots.begin(), foursome.dots.end(), dot) != foursome.dots.end())
      own_ |= 1U << near_.size();
    near_.push_back(dot);
  }
  fill_cells();
}

void PatchEvidence::fill_cells() noexcept {
  near_cell_.fill(0);
  near_coarse_.fill(0);
  if (near_.empty()) return;
  const auto [left, right] = std::minmax_element(near_x_.begin(), near_x_.begin() + near_.size());
  const auto [low, high] = std::minmax_element(near_y_.begin(), near_y_.begin() + near_.size());
  const double width = double{*right} - double{*left}, height = double{*high} - double{*low};
  // One empty cell around, so that every place within a cell of a dot is on the grid.
  cell_side_ = std::max(std::max(width, height) / (kCells - 2.5), 1e-9);
  cell_corner_ = Eigen::Vector2d(double{*left} - cell_side_, double{*low} - cell_side_);
  density_ = static_cast<double>(near_.size()) / ((width + cell_side_) * (height + cell_side_));
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const Eigen::Vector2d cell =
        (Eigen::Vector2d(double{near_x_[k]}, double{near_y_[k]}) - cell_corner_) / cell_side_;
    const int x = static_cast<int>(cell.x()), y = static_cast<int>(cell.y());
    mark(near_cell_, kCells, x, y, 1U << k);
    mark(near_coarse_, kCells / kCoarse, x / kCoarse, y / kCoarse, 1U << k);
  }
}

std::uint32_t PatchEvidence::near_dots(float x, float y, float reach) const noexcept {
  const int row = static_cast<int>(y), column = static_cast<int>(x);
  if (reach <= 1) return near_cell_[static_cast<std::size_t>(row * kCells + column)];
  if (reach <= kCoarse)
    return near_coarse_[static_cast<std::size_t>(row / kCoarse * (kCells / kCoarse) + column / kCoarse)];
  return ~0U >> (32 - near_.size());
}

const PatchEvidence::Found& PatchEvidence::explained(const Pose& rig_from_body) noexcept {
  Found& found = found_;
  found.hits.clear();
  found.odds = 1;
  if (near_.empty()) return found;
  const Eigen::Matrix3d rotation = rig_from_body.rotation.toRotationMatrix();
  const Eigen::Vector3d offset = rig_from_body.translation - origin_;
  const Eigen::Vector3f viewpoint = (rotation.transpose() * -offset).cast<float>();
  const Eigen::Matrix<float, 2, 3> across = (plane_.transpose() * rotation).cast<float>();
  const Eigen::Vector3f along = (rotation.transpose() * middle_).cast<float>();
  const Eigen::Vector2f across0 = (plane_.transpose() * offset).cast<float>();
  const auto along0 = static_cast<float>(middle_.dot(offset));
  const Eigen::Matrix2f affine = affine_from_plane_.cast<float>();
  const Eigen::Vector2f first = first_.cast<float>();
  const auto noise = static_cast<float>(gate_ * sigma_);
  const auto per_cell = static_cast<float>(1 / cell_side_);
  const Eigen::Vector2f corner = cell_corner_.cast<float>();
  const auto hit_area = static_cast<float>(density_ * std::numbers::pi);

  std::uint32_t taken = 0;
  for (std::size_t begin = 0; begin < targets_; begin += kFour) {
    const Four x = load_four(&x_[begin]), y = load_four(&y_[begin]), z = load_four(&z_[begin]);
    const Four depth = along.x() * x + along.y() * y + along.z() * z + along0;
    const Four at_x = (across(0, 0) * x + across(0, 1) * y + across(0, 2) * z + across0.x()) / depth;
    const Four at_y = (across(1, 0) * x + across(1, 1) * y + across(1, 2) * z + across0.y()) / depth;
    const Four dx = at_x - first.x(), dy = at_y - first.y();
    const Four alpha = affine(0, 0) * dx + affine(0, 1) * dy, beta = affine(1, 0) * dx + affine(1, 1) * dy;
    const Four rest = 1 - alpha - beta, distance = alpha * alpha + beta * beta;
    const Four spread = root(1 + distance + rest * rest);
    const Four bend = distance > kFarOut ? kBend * (at_x * at_x + at_y * at_y) : Four{};
    const Four reach = noise * spread + bend, chance = hit_area * reach * reach;
    const Four cell_x = (at_x - corner.x()) * per_cell, cell_y = (at_y - corner.y()) * per_cell;
    FourMask seen = (depth > kLeastDepth) & (cell_x >= 0) & (cell_x < float{kCells}) & (cell_y >= 0) &
                    (cell_y < float{kCells}) & (chance < kVague);
    if (has_faces_) {
      const Four vx = viewpoint.x() - x, vy = viewpoint.y() - y, vz = viewpoint.z() - z;
      const Four front = load_four(&nx_[begin]) * viewpoint.x() + load_four(&ny_[begin]) * viewpoint.y() +
                         load_four(&nz_[begin]) * viewpoint.z() - load_four(&height_[begin]);
      const FourMask turned = (front > 0) & (front * front > kGrazing2 * (vx * vx + vy * vy + vz * vz));
      seen &= turned | (load_four(&sided_[begin]) == 0);
    }
    const std::size_t lanes = std::min(kFour, targets_ - begin);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (seen[lane] == 0) continue;  // hidden, foretold too vaguely, or past the near dots
      const std::uint32_t within = near_dots(cell_x[lane], cell_y[lane], reach[lane] * per_cell);
      float nearest = reach[lane] * reach[lane];
      std::size_t hit = near_.size();
      for (std::uint32_t bits = within & ~taken; bits != 0; bits &= bits - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(bits));
        const float ex = near_x_[k] - at_x[lane], ey = near_y_[k] - at_y[lane];
        const float distance2 = ex * ex + ey * ey;
        if (distance2 < nearest) {
          nearest = distance2;
          hit = k;
        }
      }
      if (hit == near_.size()) {
        found.odds *= 1 - kSeen;
        continue;
      }
      taken |= 1U << hit;
      if ((own_ >> hit & 1) == 0) found.odds *= kSeen / double{chance[lane]} + 1 - kSeen;
      found.hits.push_back({near_[hit], static_cast<std::uint16_t>(begin + lane)});
    }
  }
  return found;
}

}  // namespace omma
