#include "components/tracker/seen_dots.hpp"

namespace omma {

void SeenDots::build(const DotLists& lists, const Rig& rig, double floor_px) noexcept {
  lists_ = &lists;
  rays_.clear();
  for (std::size_t c = 0; c < lists.cameras.size(); ++c) {
    const RigCamera& camera = rig.cameras[c];
    const DotList& list = lists.cameras[c];
    grids_[c].build(list, camera.lens.width(), camera.lens.height());
    claimed_[c].fill(0);
    for (std::size_t d = 0; d < list.dots.size(); ++d) {
      RigDot dot;
      const bool seen = rig_dot(list.dots[d], static_cast<std::uint16_t>(d), camera,
                                static_cast<std::uint8_t>(c), floor_px, dot);
      ray_of_dot_[c][d] = seen ? static_cast<std::int32_t>(rays_.size()) : -1;
      if (seen) rays_.push_back(dot);
    }
  }
}

std::size_t SeenDots::unclaimed(std::span<RigDot> out) const noexcept {
  std::size_t count = 0;
  for (const RigDot& dot : rays_) {
    if (count == out.size()) break;
    if (claimed_[dot.camera][dot.index] == 0) out[count++] = dot;
  }
  return count;
}

}  // namespace omma
