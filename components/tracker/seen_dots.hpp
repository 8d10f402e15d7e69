// The dots of one frame set as the tracker works on them: in the image (for gates) and as rays in the rig
// (for identification and for the solver), with a mark on those already claimed.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "components/estimation/sight.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig_dot.hpp"
#include "components/tracker/dot_grid.hpp"

namespace omma {

/// Work space of the tracker; static storage.
class SeenDots {
 public:
  static constexpr std::size_t kDots = limits::kDotsPerCamera * limits::kCameras;

  /// @param floor_px  standard deviation added to each dot for what its own covariance does not know [px]
  void build(const DotLists& lists, const Rig& rig, double floor_px) noexcept;

  const DotList& list(std::size_t camera) const { return lists_->cameras[camera]; }
  const DotGrid& grid(std::size_t camera) const { return grids_[camera]; }
  std::size_t cameras() const { return lists_->cameras.size(); }

  /// Every dot the lenses have a ray for, camera by camera, brightest first in each.
  std::span<const RigDot> rays() const { return rays_; }
  /// The ray of one dot; null where the lens has none.
  const RigDot* ray(std::size_t camera, std::size_t dot) const {
    const std::int32_t at = ray_of_dot_[camera][dot];
    return at < 0 ? nullptr : &rays_[static_cast<std::size_t>(at)];
  }
  /// The solver's form of a dot paired with `point`.
  static Sight sight(const RigDot& dot, const Eigen::Vector3d& point) {
    return {dot.origin, dot.ray, dot.whitener, point};
  }

  std::span<std::uint8_t> claimed(std::size_t camera) {
    return {claimed_[camera].data(), list(camera).dots.size()};
  }
  /// The rays of dots nobody has claimed, into `out`; returns how many.
  std::size_t unclaimed(std::span<RigDot> out) const noexcept;

 private:
  const DotLists* lists_ = nullptr;
  std::array<DotGrid, limits::kCameras> grids_{};
  StaticVector<RigDot, kDots> rays_;
  std::array<std::array<std::int32_t, limits::kDotsPerCamera>, limits::kCameras> ray_of_dot_{};
  std::array<std::array<std::uint8_t, limits::kDotsPerCamera>, limits::kCameras> claimed_{};
};

}  // namespace omma
