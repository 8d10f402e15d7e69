// Patches of an image: foursomes of neighbouring dots of one camera, the densest and nearest first, none
// twice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "components/geometry/rig_dot.hpp"
#include "components/tracker/target_patches.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

/// Four dots: three that span the patch (the largest triangle) and the fourth.
struct DotFoursome {
  std::array<std::uint16_t, 4> dots;  ///< indices in the span of RigDot
  std::size_t seed = 0;               ///< whose neighbours the others are; for DotPatches::around
  DotPatch patch;
  Eigen::Vector3d middle;  ///< unit, rig frame: where the patch's plane touches the sphere
  double spread = 0;       ///< noise of the fourth dot as the three foretell it, over one dot's noise
};

/// Work space; its size is fixed, nothing is allocated in use.
class DotPatches {
 public:
  static constexpr std::size_t kDotsPerCamera = 256;
  static constexpr std::size_t kDots = kDotsPerCamera * limits::kCameras;
  static constexpr std::size_t kNeighbours = 24;

  /// Looks at the dots of a new frame set. @return false where no camera has four dots
  bool start(std::span<const RigDot> dots, double gate) noexcept;

  /// Begins with the first foursome again.
  void rewind() noexcept;

  /// The next foursome; false when there is none left.
  /// @param seed_first  the seed is one of the three that span the patch: the others are its neighbours, as
  ///                    they are of the first of a triple of targets
  bool next(DotFoursome& foursome, bool seed_first) noexcept;

  /// A seed and the dots of its camera nearest to it, nearest first, itself at the front.
  std::span<const std::uint16_t> around(std::size_t seed) noexcept;

 private:
  struct Seed {
    std::uint16_t dot = 0;
    std::uint16_t first = 0, last = 0;   ///< dots of its camera
    std::uint16_t neighbours_known = 0;  ///< 0: not looked for yet
    float crowding = 0;                  ///< chord to the third nearest neighbour, squared
    std::array<std::uint16_t, kNeighbours + 1> neighbours{};
  };
  static constexpr std::size_t kVisitedSlots = 4096;

  void add_camera(std::size_t first, std::size_t last) noexcept;
  bool visited(std::array<std::uint16_t, 4> dots) noexcept;
  /// Orders the four dots, and finds their patch; false where they are too close to a line.
  bool form(DotFoursome& foursome, bool seed_first) const noexcept;

  std::span<const RigDot> dots_;
  double gate_ = 4;
  StaticVector<Seed, kDots> seeds_;
  StaticVector<std::uint16_t, kDots> order_;  ///< seeds, the most crowded first
  std::array<std::uint64_t, kVisitedSlots> visited_{};
  std::size_t diagonal_ = 0, block_ = 0, in_block_ = 0;
};

}  // namespace omma
