#include "components/imaging/ray_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kDarkRim =
    2;  // [px] at the end of a lens's circle: an interpolation there would mix in the dark

/// A point of the cube around the rig: face 0 … 5 is +x, −x, +y, −y, +z, −z; s and t in −1 … 1 on it.
struct CubePoint {
  int face;
  double s;
  double t;
};

CubePoint cube_point(const Eigen::Vector3d& d) {
  int axis = 0;
  if (std::abs(d.y()) > std::abs(d[axis])) axis = 1;
  if (std::abs(d.z()) > std::abs(d[axis])) axis = 2;
  const double scale = 1 / std::abs(d[axis]);
  return {2 * axis + (d[axis] < 0 ? 1 : 0), d[(axis + 1) % 3] * scale, d[(axis + 2) % 3] * scale};
}

Eigen::Vector3d direction_of(const CubePoint& point) {
  const int axis = point.face / 2;
  Eigen::Vector3d d;
  d[axis] = point.face % 2 == 0 ? 1 : -1;
  d[(axis + 1) % 3] = point.s;
  d[(axis + 2) % 3] = point.t;
  return d.normalized();
}

double smooth_step(double x) {
  const double clamped = std::clamp(x, 0.0, 1.0);
  return clamped * clamped * (3 - 2 * clamped);
}

}  // namespace

RayTable::RayTable(const Rig& rig, const RayTableSettings& settings)
    : cells_(settings.cells_per_side), feather_(settings.feather) {
  if (rig.cameras.empty()) throw std::invalid_argument("ray table: the rig has no cameras");
  if (cells_ < 2) throw std::invalid_argument("ray table: a cube face needs at least two cells a side");
  if (!(feather_ > 0)) throw std::invalid_argument("ray table: the feather must be positive");
  for (const RigCamera& camera : rig.cameras) {
    cameras_.push_back({camera.lens, camera.rig_from_camera.rotation.conjugate().toRotationMatrix()});
  }
  nodes_.resize(6 * static_cast<std::size_t>(cells_ + 1) * (cells_ + 1) * cameras_.size());
  cell_kinds_.resize(6 * static_cast<std::size_t>(cells_) * cells_ * cameras_.size());
  for (int camera = 0; camera < cameras(); ++camera) {
    for (int face = 0; face < 6; ++face) fill(camera, face);
  }
}

void RayTable::fill(int camera, int face) {
  // One ring of nodes more than the face has: a cell that no corner of is seen may still hold the tip of an
  // image, and then one of its neighbours has a corner that is seen.
  const int side = cells_ + 3;
  std::vector<SeenPixel> seen(static_cast<std::size_t>(side) * side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const CubePoint point{face, 2.0 * (column - 1) / cells_ - 1, 2.0 * (row - 1) / cells_ - 1};
      seen[static_cast<std::size_t>(row) * side + column] = look_exactly(direction_of(point), camera);
    }
  }
  const auto at = [&](int row, int column) -> const SeenPixel& {
    return seen[static_cast<std::size_t>(row + 1) * side + column + 1];
  };
  for (int row = 0; row <= cells_; ++row) {
    for (int column = 0; column <= cells_; ++column) {
      const SeenPixel& pixel = at(row, column);
      nodes_[node_index(camera, face, row, column)] = {
          static_cast<float>(pixel.u), static_cast<float>(pixel.v), static_cast<float>(pixel.weight)};
    }
  }
  for (int row = 0; row < cells_; ++row) {
    for (int column = 0; column < cells_; ++column) {
      int corners = 0;
      int around = 0;
      for (int i = -1; i <= 2; ++i) {
        for (int j = -1; j <= 2; ++j) {
          if (!(at(row + i, column + j).weight > 0)) continue;
          ++around;
          if ((i == 0 || i == 1) && (j == 0 || j == 1)) ++corners;
        }
      }
      cell_kinds_[cell_index(camera, face, row, column)] =
          corners == 4 ? Cell::kInside : (around > 0 ? Cell::kRim : Cell::kOutside);
    }
  }
}

SeenPixel RayTable::look_exactly(const Eigen::Vector3d& direction, int camera) const noexcept {
  const TableCamera& entry = cameras_[camera];
  const Eigen::Vector3d ray = entry.camera_from_rig * direction;
  Eigen::Vector2d pixel;
  if (!entry.lens.project(ray, pixel)) return {};
  // Distance from the rim of the image, as an angle: the border of the sensor or the end of the lens.
  const double border_px = std::min(std::min(pixel.x(), entry.lens.width() - 1 - pixel.x()),
                                    std::min(pixel.y(), entry.lens.height() - 1 - pixel.y()));
  const double off_axis = std::atan2(root_sum_square(ray.x(), ray.y()), ray.z());
  const double to_lens_end = entry.lens.max_angle() - off_axis - kDarkRim * entry.lens.pixel_angle();
  const double margin = std::min((border_px + 0.5) * entry.lens.pixel_angle(), to_lens_end);
  if (margin < 0) return {};
  return {pixel.x(), pixel.y(), std::max(kLeastWeight, smooth_step(margin / feather_))};
}

void RayTable::look(const Eigen::Vector3d& direction,
                    std::array<SeenPixel, limits::kCameras>& seen) const noexcept {
  const CubePoint point = cube_point(direction);
  const double x = (point.s + 1) * 0.5 * cells_;
  const double y = (point.t + 1) * 0.5 * cells_;
  const int column = std::clamp(static_cast<int>(x), 0, cells_ - 1);
  const int row = std::clamp(static_cast<int>(y), 0, cells_ - 1);
  const auto a = static_cast<float>(x - column);
  const auto b = static_cast<float>(y - row);
  const float w00 = (1 - a) * (1 - b);
  const float w01 = a * (1 - b);
  const float w10 = (1 - a) * b;
  const float w11 = a * b;
  const std::size_t next_row = (static_cast<std::size_t>(cells_) + 1) * cameras_.size();
  for (int camera = 0; camera < cameras(); ++camera) {
    const Cell kind = cell_kinds_[cell_index(camera, point.face, row, column)];
    if (kind == Cell::kOutside) {
      seen[camera] = {};
      continue;
    }
    if (kind == Cell::kRim) {
      seen[camera] = look_exactly(direction, camera);
      continue;
    }
    const Node* n = &nodes_[node_index(camera, point.face, row, column)];
    const Node& n00 = n[0];
    const Node& n01 = n[cameras_.size()];
    const Node& n10 = n[next_row];
    const Node& n11 = n[next_row + cameras_.size()];
    seen[camera] = {w00 * n00.u + w01 * n01.u + w10 * n10.u + w11 * n11.u,
                    w00 * n00.v + w01 * n01.v + w10 * n10.v + w11 * n11.v,
                    w00 * n00.weight + w01 * n01.weight + w10 * n10.weight + w11 * n11.weight};
  }
}

}  // namespace omma
